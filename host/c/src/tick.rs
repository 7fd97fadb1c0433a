//! `tick`, as C calls it.
#![allow(improper_ctypes_definitions)] // A scene without inputs or outputs has structs without fields: nothing is read of them.

use crate::answer::{admitted, told};
use crate::named;
use crate::report::Report;
use crate::scene::{Answer, Controller, Inputs, Outputs};
use crate::state::State;
use signorini_device::Error;

/// # Safety
/// Each pointer is null or valid, and of a state nobody else writes to.
#[unsafe(export_name = named!("tick"))]
pub unsafe extern "C" fn tick(
    state: *mut State,
    inputs: *const Inputs,
    outputs: *mut Outputs,
    report: *mut Report,
) -> i32 {
    // SAFETY: the caller's.
    let (state, inputs) = match unsafe { admitted(state, inputs) } {
        Ok(both) => both,
        Err(why) => return why.code(),
    };
    let (controller, seal) = state.open();
    let answer = answered(controller, *inputs);
    // SAFETY: the caller's.
    unsafe { told(state, seal, &answer, outputs, report) }
}

/// A call of its own: then the compiler makes of the controller what it makes of it in Rust.
#[inline(never)]
pub fn answered(controller: &mut Controller, inputs: Inputs) -> Result<Answer, Error> {
    #[cfg(feature = "broken-panic")]
    assert!(inputs.to_array().iter().all(|&value| value < 1e3), "out of bounds");
    controller.tick(inputs)
}
