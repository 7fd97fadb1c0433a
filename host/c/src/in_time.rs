//! What a controller that steps in time has beside its ticks: a state that outlives the program, and the bound of the evolution.

use crate::calls::owned;
use crate::named;
use crate::scene::{self, Scalar};
use crate::state::State;
use signorini_device::codes::{Refusal, refusal};

/// # Safety
/// Each pointer is null or valid; `saved` may have any bytes.
#[unsafe(export_name = named!("save"))]
pub unsafe extern "C" fn save(state: *const State, saved: *mut scene::State) -> i32 {
    // SAFETY: the caller's.
    match unsafe { (state.as_ref(), saved.as_mut()) } {
        (Some(state), Some(_)) if !state.is_own() => Refusal::ForeignState.code(),
        (Some(state), Some(saved)) => {
            *saved = state.controller().state();
            Refusal::Ok.code()
        }
        _ => Refusal::NullPointer.code(),
    }
}

/// # Safety
/// Each pointer is null or valid; `saved` may have any bytes.
#[unsafe(export_name = named!("restore"))]
pub unsafe extern "C" fn restore(state: *mut State, saved: *const scene::State) -> i32 {
    // SAFETY: the caller's.
    let (state, saved) = match unsafe { (owned(state), saved.as_ref()) } {
        (Ok(state), Some(saved)) => (state, saved),
        (Err(why), Some(_)) => return why.code(),
        (_, None) => return Refusal::NullPointer.code(),
    };
    let (controller, seal) = state.open();
    match controller.restore(saved) {
        Ok(()) => state.seal().code(),
        Err(error) => {
            state.close(seal);
            refusal(&error).0.code()
        }
    }
}

/// # Safety
/// Each pointer is null or valid.
#[unsafe(export_name = named!("window"))]
pub unsafe extern "C" fn window(
    state: *const State,
    energy: *mut Scalar,
    seconds: *mut Scalar,
) -> i32 {
    // SAFETY: the caller's.
    let Some(state) = (unsafe { state.as_ref() }) else { return Refusal::NullPointer.code() };
    if !state.is_own() {
        return Refusal::ForeignState.code();
    }
    let known = state.controller().window();
    let [of_energy, of_seconds] = known.map_or([Scalar::INFINITY; 2], |of| [of.energy, of.seconds]);
    for (to, value) in [(energy, of_energy), (seconds, of_seconds)] {
        // SAFETY: the caller's.
        if let Some(to) = unsafe { to.as_mut() } {
            *to = value;
        }
    }
    Refusal::Ok.code()
}

/// The size that the header states, as those in `calls`.
#[unsafe(export_name = named!("size_of_saved"))]
pub static SIZE_OF_SAVED: [u8; size_of::<scene::State>()] = [0; size_of::<scene::State>()];

// C sees an array of `uint64_t`.
const _: () =
    assert!(align_of::<scene::State>() == 8 && size_of::<scene::State>().is_multiple_of(8));
