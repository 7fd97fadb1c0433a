//! Triangles, quads and contact: the tactile strip.
#![no_std]
#![no_main]

use signorini_firmware::tick_image;
use signorini_kernel::rows::QUADS;

tick_image!(strip_f32, f32, QUADS, true);
