//! Code that both ticks have before and after the controller's own.

use crate::report::Report;
use crate::scene::{Answer, Inputs, Outputs, Scalar};
use crate::state::{Seal, State};
use signorini_device::Error;
use signorini_device::codes::{Refusal, refusal};

/// State and inputs of a call, where they may reach the controller: inputs by reference, since a copy beside a refusal in one `Result`
/// is made byte by byte.
///
/// # Safety
/// Each pointer is null or valid.
#[inline]
pub unsafe fn admitted<'s>(
    state: *mut State,
    inputs: *const Inputs,
) -> Result<(&'s mut State, &'s Inputs), Refusal> {
    // SAFETY: the caller's.
    let (Some(state), Some(inputs)) = (unsafe { (state.as_mut(), inputs.as_ref()) }) else {
        return Err(Refusal::NullPointer);
    };
    if !state.is_own() {
        return Err(Refusal::ForeignState);
    }
    match infinite(inputs) {
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
pub unsafe fn told(
    state: &mut State,
    seal: Seal,
    answer: &Result<Answer, Error>,
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
                    *report = Report::new(answer);
                }
            }
            Refusal::Ok.code()
        }
        Err(error) => {
            let (why, culprit) = refusal(error);
            state.blame(culprit);
            let kept = [Refusal::InputOutOfRange, Refusal::InputNotFinite, Refusal::Excluded];
            if kept.contains(&why) {
                state.close(seal);
            }
            why.code()
        }
    }
}
