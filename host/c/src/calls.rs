//! The functions of the header but the ticks. Each pointer is null or points to what its type says; the header says which may be null.
#![allow(improper_ctypes_definitions)] // A scene without inputs or outputs has structs without fields: nothing is read of them.

use core::ffi::{CStr, c_char};

use crate::named;
use crate::report::Report;
use crate::scene::{Inputs, Outputs, Scalar};
use crate::state::State;
use signorini_device::codes::Refusal;
use signorini_device::kernel::Verdict;
use signorini_device::kernel::codes::word;
use signorini_device::kernel::report::Ended;

/// # Safety
/// `state` is null or has room for a state.
#[unsafe(export_name = named!("init"))]
pub unsafe extern "C" fn init(state: *mut State) -> i32 {
    match state.is_null() {
        true => Refusal::NullPointer.code(),
        // SAFETY: the caller's.
        false => unsafe { State::begin(state).code() },
    }
}

/// # Safety
/// `state` is null or valid.
#[unsafe(export_name = named!("reset"))]
pub unsafe extern "C" fn reset(state: *mut State) -> i32 {
    // SAFETY: the caller's.
    match unsafe { owned(state) } {
        Ok(state) => state.reset().code(),
        Err(why) => why.code(),
    }
}

/// # Safety
/// `state` is null or valid.
#[unsafe(export_name = named!("seal_state"))]
pub unsafe extern "C" fn seal_state(state: *mut State) -> i32 {
    // SAFETY: the caller's.
    match unsafe { owned(state) } {
        Ok(state) => state.seal().code(),
        Err(why) => why.code(),
    }
}

/// A state of this controller.
///
/// # Safety
/// `state` is null or valid.
pub unsafe fn owned<'s>(state: *mut State) -> Result<&'s mut State, Refusal> {
    // SAFETY: the caller's.
    let state = unsafe { state.as_mut() }.ok_or(Refusal::NullPointer)?;
    if state.is_own() { Ok(state) } else { Err(Refusal::ForeignState) }
}

/// # Safety
/// Each pointer is null or valid.
#[unsafe(export_name = named!("between"))]
pub unsafe extern "C" fn between(
    state: *const State,
    outputs: *const Outputs,
    report: *const Report,
    least: *mut Outputs,
    most: *mut Outputs,
) -> i32 {
    // SAFETY: the caller's.
    let given = unsafe { (state.as_ref(), outputs.as_ref(), report.as_ref()) };
    let (Some(state), Some(outputs), Some(report)) = given else {
        return Refusal::NullPointer.code();
    };
    if !state.is_own() {
        return Refusal::ForeignState.code();
    }
    let ends = state.controller().between(&report.answer(*outputs));
    for (to, end) in [least, most].into_iter().zip(ends) {
        // SAFETY: the caller's.
        if let Some(to) = unsafe { to.as_mut() } {
            *to = end;
        }
    }
    Refusal::Ok.code()
}

/// # Safety
/// `state` is null or can be read, whatever its bytes are.
#[unsafe(export_name = named!("check_state"))]
pub unsafe extern "C" fn check_state(state: *const State) -> i32 {
    match state.is_null() {
        true => Refusal::NullPointer.code(),
        // SAFETY: the caller's.
        false => unsafe { State::check(state).code() },
    }
}

/// # Safety
/// `state` is null or valid.
#[unsafe(export_name = named!("culprit"))]
pub unsafe extern "C" fn culprit(state: *const State) -> u32 {
    // SAFETY: the caller's.
    unsafe { state.as_ref() }.map_or(0, State::culprit)
}

/// # Safety
/// `inputs` is null or valid.
#[unsafe(export_name = named!("clamp"))]
pub unsafe extern "C" fn clamp(inputs: *mut Inputs) {
    // SAFETY: the caller's.
    if let Some(inputs) = unsafe { inputs.as_mut() } {
        *inputs = inputs.clamped();
    }
}

#[unsafe(export_name = named!("error_name"))]
pub extern "C" fn error_name(error: i32) -> *const c_char {
    word(Refusal::CODES, error).unwrap_or(UNKNOWN).as_ptr()
}

#[unsafe(export_name = named!("status_name"))]
pub extern "C" fn status_name(status: i32) -> *const c_char {
    word(Ended::CODES, status).unwrap_or(UNKNOWN).as_ptr()
}

#[unsafe(export_name = named!("bounded_name"))]
pub extern "C" fn bounded_name(bounded: i32) -> *const c_char {
    word(Verdict::<Scalar>::CODES, bounded).unwrap_or(UNKNOWN).as_ptr()
}

const UNKNOWN: &CStr = c"UNKNOWN";

/// The ends of the inputs' ranges.
const fn ends(which: usize) -> [Scalar; crate::scene::INPUTS] {
    let mut ends = [0.0; crate::scene::INPUTS];
    let mut at = 0;
    while at < ends.len() {
        ends[at] = Inputs::RANGES[at][which];
        at += 1;
    }
    ends
}

#[unsafe(export_name = named!("default_inputs"))]
pub static DEFAULT_INPUTS: Inputs = Inputs::DEFAULT;
#[unsafe(export_name = named!("least_inputs"))]
pub static LEAST_INPUTS: [Scalar; crate::scene::INPUTS] = ends(0);
#[unsafe(export_name = named!("most_inputs"))]
pub static MOST_INPUTS: [Scalar; crate::scene::INPUTS] = ends(1);

/// Sizes that the header states: those of these statics, which nothing refers to.
#[unsafe(export_name = named!("size_of_state"))]
pub static SIZE_OF_STATE: [u8; size_of::<State>()] = [0; size_of::<State>()];
#[unsafe(export_name = named!("size_of_report"))]
pub static SIZE_OF_REPORT: [u8; size_of::<Report>()] = [0; size_of::<Report>()];
