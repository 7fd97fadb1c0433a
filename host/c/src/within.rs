//! `tick_within`, as C calls it.
#![allow(improper_ctypes_definitions)] // A scene without inputs or outputs has structs without fields: nothing is read of them.

use core::ffi::c_void;

use crate::answer::{admitted, told};
use crate::named;
use crate::report::Report;
use crate::scene::{Inputs, LIMITS, Outputs, Scalar};
use crate::state::State;
use signorini_device::kernel::limits::{Deadline, Limits};

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
/// As for `tick`.
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
        Err(why) => return why.code(),
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
    let answer = controller.tick_within(*inputs, limits, &mut deadline);
    // SAFETY: the caller's.
    unsafe { told(state, seal, &answer, outputs, report) }
}
