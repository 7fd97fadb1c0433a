//! Quads and contact in double precision: the slab.
#![no_std]
#![no_main]

use signorini_firmware::tick_image;
use signorini_kernel::rows::QUADS;

tick_image!(slab_f64, f64, QUADS, true);
