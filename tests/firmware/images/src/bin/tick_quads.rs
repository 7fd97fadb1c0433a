//! Quads and contact: the slab.
#![no_std]
#![no_main]

use signorini_firmware::tick_image;
use signorini_kernel::rows::QUADS;

tick_image!(slab_f32, f32, QUADS, true);
