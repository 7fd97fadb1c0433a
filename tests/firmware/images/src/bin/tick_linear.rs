//! Triangles and nothing in contact.
#![no_std]
#![no_main]

use signorini_firmware::tick_image;
use signorini_kernel::rows::TRIANGLES;

tick_image!(linear_f32, f32, TRIANGLES, false);
