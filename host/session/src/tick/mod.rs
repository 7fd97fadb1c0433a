//! A scene over time: tick after tick, each started from the answer of the one before.
//!
//! ```text
//!   schedule or log ─► moments (t, inputs) ─► data at t ─► Session ─► TickRecord ─► ticks.csv, ticks.svg
//! ```
//! Mesh, numbering and A are set up once; between ticks only loads, gaps, boundary values and transfer coefficients change,
//! which is what happens on a device. The session of [`play`] is the kernel's own tick wherever D or R holds every part, and
//! otherwise a warm solve; where the numbers of the first moment are far from 1 it plays in other units, and all answers are
//! in the scene's. A moment whose loads contact cannot hold has a row without an answer, and the next goes on from the last one. That of [`replay`] is the controller that `bake` writes, with the bits that firmware gets: model,
//! solver, scalar, setting, first state and what stays from tick to tick are the module's, and a tick that it refuses leaves
//! its state and the answer before, as on a device.

mod begun;
pub mod columns;
#[cfg(test)]
mod falling;
pub mod half;
mod intervals;
pub mod log;
mod moments;
mod play;
mod record;
pub mod refusals;
mod replay;
mod saved;
pub mod schedule;
#[cfg(test)]
mod states;
#[cfg(test)]
mod steps;
#[cfg(test)]
mod tests;
pub mod window_error;

pub use record::{TickInterval, TickRecord};
pub use replay::{replay, replay_on};
pub use saved::{Moment, Saved};

use signorini_device::tick::Limits;
use signorini_kernel::solver::Settings;
use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_scene::scene::Scene;
use signorini_scene::setting::Precision;
use signorini_solve::{MOST_SWEEPS, Options, ScalarKind, Solution};

use moments::Done;

/// When a tick happens, and what the inputs are then.
#[derive(Debug, Clone, PartialEq)]
pub struct ScheduledTick {
    /// t
    pub time: f64,
    /// Positions in `scene.inputs` with their values; inputs that are not listed keep theirs.
    pub inputs: Vec<(usize, f64)>,
}

impl ScheduledTick {
    /// Brings a problem to this moment.
    fn set(&self, problem: &mut Problem) -> Result<()> {
        problem.set(&self.inputs, self.time).map_err(|error| error.at_time(self.time))
    }
}

/// Limits of a tick, and its scalar.
#[derive(Debug, Clone, Copy)]
pub struct Budget {
    /// Scalar type.
    pub scalar: ScalarKind,
    /// Most sweeps of one tick.
    pub sweeps: u32,
    /// The certified error that is small enough; 0: as far as sweeps buy anything.
    pub error: f64,
    /// The residual that ends a tick instead, as it ends a solve.
    pub tolerance: Option<f64>,
    /// Whether intervals of the outputs are worked out, each tick anew.
    pub intervals: bool,
    /// Whether the start of steps in time has a record of its own, before that of the first step.
    pub shows_start: bool,
}

impl Budget {
    /// The budget of a scene: in the scalar of its setting, as far as sweeps buy anything, with intervals.
    pub fn of(scene: &Scene) -> Self {
        let single = scene.setting.and_then(|setting| setting.scalar) == Some(Precision::F32);
        Self {
            scalar: if single { ScalarKind::F32 } else { ScalarKind::F64 },
            sweeps: MOST_SWEEPS,
            error: 0.0,
            tolerance: None,
            intervals: true,
            shows_start: true,
        }
    }

    /// Whether the number of sweeps is open.
    fn is_open(&self) -> bool {
        self.sweeps == MOST_SWEEPS
    }

    fn settings<R: Scalar>(&self) -> Settings<R> {
        let Self { scalar, tolerance, sweeps, .. } = *self;
        Options { scalar, tolerance, max_sweeps: Some(sweeps), ..Options::default() }.settings()
    }

    fn limits<R: Scalar>(&self) -> Limits<R> {
        Limits { error: R::narrow(self.error), sweeps: self.sweeps, ..Limits::default() }
    }
}

/// What follows a tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Onward {
    /// The next moment.
    GoOn,
    /// Nothing: the play ends early.
    Stop,
}

/// Who looks at each tick and does not say goes on.
impl From<()> for Onward {
    fn from((): ()) -> Self {
        Self::GoOn
    }
}

/// Where a play begins.
#[derive(Debug, Clone, Copy)]
pub enum Begin<'a> {
    /// Cold, or from the solution of the problem on a coarser mesh.
    Anew(Option<&'a Problem>),
    /// Where another play of the problem ended.
    From(&'a Saved),
}

/// What a play leaves.
pub struct Played {
    /// A record each tick, before them that of a start that is shown.
    pub ticks: Vec<TickRecord>,
    /// Its state after the last tick; nothing where no tick had an answer, or the last one's numbers are not finite.
    pub saved: Option<Saved>,
}

/// Plays `problem` at every moment; calls `done` after each, whose error ends the play. The first tick starts from the solution
/// on `coarse`, the problem on a coarser mesh, where there is one; without, on a large mesh with an open budget, from
/// the solution that `auto` finds.
///
/// # Errors
/// Data that are not admissible at some time, with that time; numbers that the scalar type cannot
/// hold; a probe outside the mesh.
pub fn play<D: Into<Onward>>(
    problem: &Problem,
    coarse: Option<&Problem>,
    moments: &[ScheduledTick],
    budget: &Budget,
    done: impl FnMut(&TickRecord, Option<&Solution>) -> Result<D>,
) -> Result<Vec<TickRecord>> {
    Ok(play_on(problem, Begin::Anew(coarse), moments, budget, done)?.ticks)
}

/// As [`play`], from where `begin` says; `done` may stop it. Inputs of a play that goes on are those of `problem`.
///
/// # Errors
/// As for [`play`]; a state that is not one of `problem`, its scalar and how its ticks end.
pub fn play_on<D: Into<Onward>>(
    problem: &Problem,
    begin: Begin,
    moments: &[ScheduledTick],
    budget: &Budget,
    mut done: impl FnMut(&TickRecord, Option<&Solution>) -> Result<D>,
) -> Result<Played> {
    let done: Done = &mut |tick, solution| done(tick, solution).map(Into::into);
    play::of(budget.scalar)(problem, begin, moments, budget, done)
}
