//! A baked controller behind functions for C.
//!
//! ```text
//!   scene (the module of `signorini bake`) ─► state ─► calls
//!                                              ├─► in_time: what outlives the program
//!                                              └─► answer ─► tick, within ◄── report
//! ```
//! A library has two objects, `tick` in one and `tick_within` in the other, each with a controller of its own: where two functions
//! call the same code the compiler no longer makes it part of either, which costs thousands of instructions a tick. A linker leaves
//! out what is not called.
//!
//! The header that belongs to it is written from the same lists: inputs and outputs as the module has them, numbers and words
//! as the kernel's `device::codes` has them. Memory is the caller's; nothing here is static but constants.
#![no_std]

mod answer;
mod calls;
#[cfg(feature = "counted")]
mod counted;
#[cfg(feature = "in-time")]
mod in_time;
mod report;
mod state;
#[cfg(not(feature = "within"))]
mod tick;
#[cfg(feature = "within")]
mod within;

include!(concat!(env!("OUT_DIR"), "/module.rs"));

/// The name of a function or constant: the scene's, an underscore, and its own.
macro_rules! named {
    ($own:literal) => {
        concat!(env!("SIGNORINI_C_NAME"), "_", $own)
    };
}
use named;

unsafe extern "C" {
    /// Defined nowhere: a library with a path to it is refused when it is made.
    fn a_panic_path_is_reachable() -> !;
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    // SAFETY: it is never called.
    unsafe { a_panic_path_is_reachable() }
}
