//! The kernel where neither the standard library nor an allocator exists.
//!
//! One contact problem, solved for both scalars and both indices without an input from outside:
//! every stage of the kernel is compiled to machine code in this archive, and what the archive asks
//! its linker for is what the kernel needs. `cargo xtask no-std` builds it and looks.
//!
//! * std: the panic handler below is the second one as soon as any dependency links std, and rustc
//!   refuses (`duplicate lang item panic_impl`).
//! * alloc: an archive must bring the allocator that its dependencies ask for, and rustc refuses
//!   where there is none; where a dependency brings its own, its symbols are in the archive.
//!
//! The features `broken-…` do each of these on purpose, in the place of a dependency.
#![no_std]

#[cfg(any(feature = "broken-alloc", feature = "broken-allocator"))]
extern crate alloc;
#[cfg(feature = "broken-std")]
extern crate std;

#[cfg(feature = "broken-allocator")]
mod allocator;
mod bar;

// Linked with its crates and dependencies, though nothing here calls it.
use signorini_device as _;
use signorini_kernel::{Index, Real};

/// The contact force of [`bar`] in `f32`, numbered by `u16`; NaN where the kernel refuses.
#[unsafe(no_mangle)]
pub extern "C" fn force_f32_u16(load: f32) -> f32 {
    force::<f32, u16>(load)
}

/// The bar in `f64`, numbered by `u32`.
#[unsafe(no_mangle)]
pub extern "C" fn force_f64_u32(load: f64) -> f64 {
    force::<f64, u32>(load)
}

fn force<R: Real, I: Index>(load: R) -> R {
    bar::force::<R, I>(load).unwrap_or(R::ZERO / R::ZERO)
}

#[panic_handler]
fn halt(_: &core::panic::PanicInfo) -> ! {
    loop {}
}
