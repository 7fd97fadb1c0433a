//! The functions of the header. Each pointer is null or points to what its type says; the header says which may be null.
#![allow(improper_ctypes_definitions)] // A scene without inputs or outputs has structs without fields: nothing is read of them.

use core::ffi::{CStr, c_char, c_void};

use crate::named;
use crate::report::Report;
use crate::scene::{Answer, Inputs, LIMITS, Outputs, Scalar};
use crate::state::{Seal, State};
use signorini_kernel::Error;
use signorini_kernel::device::codes::{Bounded, EndedCode, Refusal, refusal};
use signorini_kernel::device::limits::{Deadline, Limits};

/// `NAME_limits`.
#[repr(C)]
pub struct TickLimits {
    error: Scalar,
    share: Scalar,
    sweeps: u32,
}

/// `NAME_deadline`.
#[repr(C)]
pub struct TickDeadline {
    remaining: Option<unsafe extern "C" fn(*mut c_void) -> u32>,
    context: *mut c_void,
    sweep: u32,
    certificate: u32,
}

/// # Safety
/// `state` is null or has room for a state.
#[unsafe(export_name = named!("init"))]
pub unsafe extern "C" fn init(state: *mut State) -> i32 {
    match state.is_null() {
        true => Refusal::NullPointer as i32,
        // SAFETY: the caller's.
        false => unsafe { State::begin(state) as i32 },
    }
}

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
        Err(why) => return why as i32,
    };
    let (controller, seal) = state.open();
    let answer = controller.tick(inputs);
    // SAFETY: the caller's.
    unsafe { told(state, seal, answer, outputs, report) }
}

/// # Safety
/// As for [`tick`].
#[unsafe(export_name = named!("tick_within"))]
pub unsafe extern "C" fn tick_within(
    state: *mut State,
    inputs: *const Inputs,
    limits: *const TickLimits,
    deadline: *const TickDeadline,
    outputs: *mut Outputs,
    report: *mut Report,
) -> i32 {
    // SAFETY: the caller's.
    let (state, inputs) = match unsafe { admitted(state, inputs) } {
        Ok(both) => both,
        Err(why) => return why as i32,
    };
    // SAFETY: the caller's.
    let (limits, deadline) = unsafe { (limits.as_ref(), deadline.as_ref()) };
    let limits =
        limits.map_or(LIMITS, |of| Limits { error: of.error, share: of.share, sweeps: of.sweeps });
    let clock = deadline.and_then(|deadline| Some((deadline.remaining?, deadline.context)));
    let mut deadline = Deadline {
        // SAFETY: a function of this type, called with the context that came with it.
        remaining: || clock.map_or(u32::MAX, |(remaining, context)| unsafe { remaining(context) }),
        sweep: deadline.map_or(0, |deadline| deadline.sweep),
        certificate: deadline.map_or(0, |deadline| deadline.certificate),
    };
    let (controller, seal) = state.open();
    let answer = controller.tick_within(inputs, limits, &mut deadline);
    // SAFETY: the caller's.
    unsafe { told(state, seal, answer, outputs, report) }
}

/// State and inputs of a call, where they may reach the controller.
///
/// # Safety
/// Each pointer is null or valid.
#[inline]
unsafe fn admitted<'s>(
    state: *mut State,
    inputs: *const Inputs,
) -> Result<(&'s mut State, Inputs), Refusal> {
    // SAFETY: the caller's.
    let (Some(state), Some(&inputs)) = (unsafe { (state.as_mut(), inputs.as_ref()) }) else {
        return Err(Refusal::NullPointer);
    };
    if !state.is_own() {
        return Err(Refusal::ForeignState);
    }
    match infinite(&inputs) {
        Some(input) => {
            state.blame(input);
            Err(Refusal::InputNotFinite)
        }
        None => Ok((state, inputs)),
    }
}

/// The first input without a range that is no finite number: what has a range is held against it by the controller.
#[inline]
fn infinite(inputs: &Inputs) -> Option<usize> {
    let is_free = |[lo, hi]: [Scalar; 2]| !(lo.is_finite() && hi.is_finite());
    let mut values = inputs.to_array().into_iter().zip(Inputs::RANGES);
    values.position(|(value, range)| is_free(range) && !value.is_finite())
}

/// Puts an answer where the caller wants it; of a refused call only the culprit. The seal stays as it was where an input was refused.
///
/// # Safety
/// Each pointer is null or valid.
unsafe fn told(
    state: &mut State,
    seal: Seal,
    answer: Result<Answer, Error>,
    outputs: *mut Outputs,
    report: *mut Report,
) -> i32 {
    match answer {
        Ok(answer) => {
            // SAFETY: the caller's.
            unsafe {
                if let Some(outputs) = outputs.as_mut() {
                    *outputs = answer.outputs;
                }
                if let Some(report) = report.as_mut() {
                    *report = Report::new(&answer);
                }
            }
            Refusal::Ok as i32
        }
        Err(error) => {
            let (why, culprit) = refusal(&error);
            state.blame(culprit);
            if matches!(why, Refusal::InputOutOfRange | Refusal::InputNotFinite) {
                state.close(seal);
            }
            why as i32
        }
    }
}

/// # Safety
/// `state` is null or valid.
#[unsafe(export_name = named!("reset"))]
pub unsafe extern "C" fn reset(state: *mut State) -> i32 {
    // SAFETY: the caller's.
    match unsafe { owned(state) } {
        Ok(state) => state.reset() as i32,
        Err(why) => why as i32,
    }
}

/// # Safety
/// `state` is null or valid.
#[unsafe(export_name = named!("seal_state"))]
pub unsafe extern "C" fn seal_state(state: *mut State) -> i32 {
    // SAFETY: the caller's.
    match unsafe { owned(state) } {
        Ok(state) => state.seal() as i32,
        Err(why) => why as i32,
    }
}

/// A state of this controller.
///
/// # Safety
/// `state` is null or valid.
unsafe fn owned<'s>(state: *mut State) -> Result<&'s mut State, Refusal> {
    // SAFETY: the caller's.
    let state = unsafe { state.as_mut() }.ok_or(Refusal::NullPointer)?;
    if state.is_own() { Ok(state) } else { Err(Refusal::ForeignState) }
}

/// # Safety
/// `state` is null or can be read, whatever its bytes are.
#[unsafe(export_name = named!("check_state"))]
pub unsafe extern "C" fn check_state(state: *const State) -> i32 {
    match state.is_null() {
        true => Refusal::NullPointer as i32,
        // SAFETY: the caller's.
        false => unsafe { State::check(state) as i32 },
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
    Refusal::of_code(error).map_or(UNKNOWN, Refusal::word).as_ptr()
}

#[unsafe(export_name = named!("status_name"))]
pub extern "C" fn status_name(status: i32) -> *const c_char {
    EndedCode::of_code(status).map_or(UNKNOWN, EndedCode::word).as_ptr()
}

#[unsafe(export_name = named!("bounded_name"))]
pub extern "C" fn bounded_name(bounded: i32) -> *const c_char {
    Bounded::of_code(bounded).map_or(UNKNOWN, Bounded::word).as_ptr()
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
