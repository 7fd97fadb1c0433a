//! A baked scene and what is done with it: ticks with known inputs, told bit for bit.
#![no_std]

pub mod figures;
pub mod loads;
pub mod play;
#[cfg(feature = "worst")]
pub mod worst;

include!(concat!(env!("OUT_DIR"), "/module.rs"));

/// A tick by a call of its own, so that the stack is the controller's. In the crate of the module, as in a firmware, the compiler
/// makes constants of its data.
///
/// # Errors
/// Those of the controller.
#[inline(never)]
pub fn tick(
    controller: &mut scene::Controller,
    inputs: scene::Inputs,
) -> Result<scene::Answer, signorini_device::Error> {
    controller.tick(inputs)
}
