//! Triangles and contact: the levee.
#![no_std]
#![no_main]

use signorini_firmware::tick_image;
use signorini_kernel::rows::TRIANGLES;

tick_image!(levee_f32, f32, TRIANGLES, true);
