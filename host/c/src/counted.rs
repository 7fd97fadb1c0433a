//! What a caller in Rust has in place of `tick`, on the very same code of the controller: `cargo xtask c` counts both.
#![allow(improper_ctypes_definitions)] // A scene without inputs has a struct without fields: nothing is read of it.

use core::hint::black_box;

use crate::named;
use crate::scene::{Answer, Controller, Inputs};
use crate::state::State;
use crate::tick::answered;

/// A caller in Rust makes one call, and the answer is there.
///
/// # Safety
/// As for `tick`.
#[unsafe(export_name = named!("ticked"))]
pub unsafe extern "C" fn ticked(state: *mut State, inputs: *const Inputs) {
    // SAFETY: the caller's.
    if let Some((controller, inputs)) = unsafe { counted(state, inputs) } {
        black_box(&answered(controller, inputs));
    }
}

/// That call, and the intervals of its outputs.
///
/// # Safety
/// As for `tick`.
#[unsafe(export_name = named!("answered"))]
pub unsafe extern "C" fn ticked_with_intervals(state: *mut State, inputs: *const Inputs) {
    // SAFETY: the caller's.
    if let Some((controller, inputs)) = unsafe { counted(state, inputs) } {
        let answer = answered(controller, inputs);
        black_box(&answer.as_ref().map(Answer::plus_minus));
        black_box(&answer);
    }
}

unsafe fn counted<'s>(
    state: *mut State,
    inputs: *const Inputs,
) -> Option<(&'s mut Controller, Inputs)> {
    // SAFETY: the caller's.
    unsafe { Some((state.as_mut()?.open().0, *inputs.as_ref()?)) }
}
