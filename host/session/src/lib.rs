//! A scene answered tick after tick, whatever answers.
//!
//! ```text
//!                      ┌─ condensed, full   the controller that `bake` writes, on this machine
//!   Problem ─► Session ┼─ kernel_tick       the kernel's tick, on data that are integrated anew for each moment
//!                      └─ solves            one solve per tick, where the kernel's tick cannot go, and in f32+f64
//!                              │
//!                              └─► Solution, of a tick as of a solve
//! ```
//! A scene's setting chooses the session ([`with_session`]), or `bake` does ([`with_module`]). [`request`] solves a scene once,
//! [`tick`] plays it over time.

pub mod coarse;
mod condensed;
mod full;
mod kernel_tick;
mod module;
pub mod on_mesh;
pub mod request;
mod saved;
mod setting;
mod solves;
pub mod tick;

pub use module::{Module, with_module};
pub use saved::SavedSession;
pub use setting::{completed, solve, with_session};

use signorini_certify::CertifiedFields;
use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::{InputError, Result};
use signorini_solve::{ScalarKind, Solution};

/// Who is lent a session.
type Then<'t> = &'t mut dyn FnMut(&mut dyn Session) -> Result<()>;

/// A scene that is answered tick after tick. The state that it carries is where the next tick starts.
pub trait Session {
    /// Takes over the data of `at`: the session's problem with other inputs, or at another time. Data of a controller are
    /// baked, and follow its inputs alone: it has nothing to take over.
    ///
    /// # Errors
    /// Data without an answer, or beyond the session's scalar.
    fn pose(&mut self, _at: &Problem) -> Result<()> {
        Ok(())
    }

    /// Answers for the data posed last and, of a controller, for these inputs in the order of the scene. Returns the
    /// sweeps. A study times this.
    ///
    /// # Errors
    /// Inputs without an answer: the answer and the state before stay.
    fn tick(&mut self, inputs: &[f64]) -> Result<u32>;

    /// Goes back to the state before the first tick.
    fn restart(&mut self);

    /// The state that it carries to the next tick; nothing before the first answer, or of a session that is not saved.
    fn saved(&self) -> Option<SavedSession> {
        self.state().map(|bytes| SavedSession::of_controller(&bytes))
    }

    /// Goes on where a session of the same problem was saved; an error changes nothing.
    ///
    /// # Errors
    /// The state of another kind of session or mesh, numbers that it cannot have left.
    fn restore(&mut self, saved: &SavedSession) -> Result<()> {
        self.set_state(&saved.bytes()?)
    }

    /// The answer of the last tick, whose inputs and data were those of `at`; empty before the first.
    ///
    /// # Errors
    /// Numbers that do not fit.
    fn answer(&self, at: &Problem) -> Result<Solution>;

    /// The least and the largest value that each output may have for the exact solution, where the last tick's own numbers tell.
    fn between(&self) -> Vec<Option<[f64; 2]>> {
        Vec::new()
    }

    /// The bound of the evolution that a controller carries, and how far back its mean reaches.
    fn window(&self) -> Option<[f64; 2]> {
        None
    }

    /// s at the start of a controller that steps in time, where it is another one than that of the scene's start `at`.
    fn s_at_start(&self, _at: &Problem) -> Option<CertifiedFields> {
        None
    }

    /// The bytes of a controller's state, as firmware has them; nothing where ticks are no steps in time.
    fn state(&self) -> Option<Vec<u8>> {
        None
    }

    /// Goes on from such bytes; an error changes nothing.
    ///
    /// # Errors
    /// Those of another scene or scalar, damaged ones, and any where ticks are no steps in time.
    fn set_state(&mut self, _: &[u8]) -> Result<()> {
        Err(InputError::new("state: this controller does not step in time, and has none").into())
    }

    /// Poses `at` and answers for its inputs.
    ///
    /// # Errors
    /// As for [`Session::pose`] and [`Session::tick`].
    fn play(&mut self, at: &Problem) -> Result<u32> {
        self.pose(at)?;
        let inputs: Vec<f64> = at.scene.inputs.iter().map(|input| input.default).collect();
        self.tick(&inputs)
    }
}

/// The error of a state that a controller does not take.
fn refused_state(error: signorini_kernel::Error) -> InputError {
    InputError::new(format!("state: {error}")).because(error)
}

/// The scalar type of a session in `R`.
fn scalar_kind<R: Scalar>() -> ScalarKind {
    if size_of::<R>() == size_of::<f32>() { ScalarKind::F32 } else { ScalarKind::F64 }
}
