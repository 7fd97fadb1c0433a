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

pub mod columns;
mod intervals;
pub mod log;
mod record;
pub mod schedule;
#[cfg(test)]
mod steps;
#[cfg(test)]
mod tests;
pub mod window_error;

pub use record::{TickInterval, TickRecord};

use std::sync::Arc;

use signorini_certify::evolution::Evolution;
use signorini_device::tick::Limits;
use signorini_intervals::Lasting;
use signorini_kernel::Error as KernelError;
use signorini_kernel::mesh::components::PartCounts;
use signorini_kernel::solver::Settings;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Approach, Loads, Parts, Problem};
use signorini_scene::error::{Error, Result};
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;
use signorini_scene::setting::Precision;
use signorini_solve::{Options, ScalarKind, Solution, Start, choose_units, in_scene};

use crate::{Session, coarse, kernel_tick, solves, with_module};
use intervals::Intervals;
use window_error::WindowError;

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
            sweeps: Options::default().max_sweeps,
            error: 0.0,
            intervals: true,
            shows_start: true,
        }
    }

    /// Whether the number of sweeps is open.
    fn is_open(&self) -> bool {
        self.sweeps == Options::default().max_sweeps
    }

    fn settings<R: Scalar>(&self) -> Settings<R> {
        let options =
            Options { scalar: self.scalar, max_sweeps: self.sweeps, ..Options::default() };
        options.settings()
    }

    fn limits<R: Scalar>(&self) -> Limits<R> {
        Limits { error: R::narrow(self.error), sweeps: self.sweeps, ..Limits::default() }
    }
}

/// Plays `problem` at every moment; calls `done` after each, whose error ends the play. The first tick starts from the solution
/// on `coarse`, the problem on a coarser mesh, where there is one; without, on a large mesh with an open budget, from
/// the solution of a factor.
///
/// # Errors
/// Data that are not admissible at some time, with that time; numbers that the scalar type cannot
/// hold; a probe outside the mesh.
pub fn play(
    problem: &Problem,
    coarse: Option<&Problem>,
    moments: &[ScheduledTick],
    budget: &Budget,
    done: impl FnMut(&TickRecord, Option<&Solution>) -> Result<()>,
) -> Result<Vec<TickRecord>> {
    match budget.scalar {
        ScalarKind::F64 => play_in::<f64>(problem, coarse, moments, budget, done),
        ScalarKind::F32 => play_in::<f32>(problem, coarse, moments, budget, done),
    }
}

fn play_in<R: Scalar>(
    problem: &Problem,
    coarse: Option<&Problem>,
    moments: &[ScheduledTick],
    budget: &Budget,
    mut done: impl FnMut(&TickRecord, Option<&Solution>) -> Result<()>,
) -> Result<Vec<TickRecord>> {
    let given = problem;
    let mut problem = problem.clone();
    let mut ticks = Vec::new();
    let first = moments.first().map_or(0.0, |moment| moment.time);
    let (mut evolution, mut error) = (None, None);
    if let Some(start) = Start::of(given, first)? {
        problem = start.stepping(given)?;
        evolution = start.evolution;
        if let Some(of) = &evolution {
            error = WindowError::begin(&start, of.seconds())?;
        }
        if budget.shows_start {
            ticks.push(TickRecord::of_start(&start)?);
            done(&ticks[0], Some(&start.solution))?;
        }
    }
    let Some(parts) = begun(&mut problem, moments)? else {
        return unsolvable(given, moments, done);
    };
    let mut coarse = coarse.cloned();
    if let Some(coarse) = &mut coarse {
        coarse.scene = problem.scene.clone();
        coarse.set_time(problem.time)?;
    }
    let units = choose_units(&Problem {
        loads: Loads { step: None, ..problem.loads.clone() },
        ..problem.clone()
    })?;
    if units != Units::default() {
        problem = problem.in_units(&units)?;
        coarse = coarse.map(|coarse| coarse.in_units(&units)).transpose()?;
    }
    let (problem, coarse) = (&problem, coarse.as_ref());
    let budget = Budget { error: budget.error / units.energy(), ..*budget };
    let least;
    let mut session = match Approach::Tick.lack_with(problem, parts) {
        Some(_) => solves::warm::<R>(problem, budget.settings())?,
        None => {
            least = problem.at_least_transfer()?;
            let start = |u: &mut [R]| coarse::start(problem, coarse, budget.is_open(), u);
            kernel_tick::session(problem, &least, budget.limits(), start)?
        }
    };
    let intervals = match budget.intervals {
        true => Intervals::Anew(Lasting::default()),
        false => Intervals::Unasked,
    };
    let evolution = evolution.map(|of| of.in_unit(units.energy()));
    let play = Play { session: &mut *session, intervals, units, evolution, error };
    ticks.extend(play.through(problem, moments, done)?);
    Ok(ticks)
}

/// Plays `moments` through the controller of `problem`, calling `done` after each, without a solution where the controller
/// refuses the inputs; also the controller's name in a few words. `asked` is a scalar instead of that of the scene's
/// setting, and whether the start of steps in time has a record of its own.
///
/// # Errors
/// Those of `bake`; inputs for which the scene's data are not admissible, with their time.
pub fn replay(
    problem: &Problem,
    moments: &[ScheduledTick],
    (asked, shows_start): (Option<ScalarKind>, bool),
    mut done: impl FnMut(&TickRecord, Option<&Solution>) -> Result<()>,
) -> Result<(String, Vec<TickRecord>)> {
    let first = moments.first().map_or(0.0, |moment| moment.time);
    with_module(problem, asked, |session, module| {
        let (mut problem, mut ticks) = (problem.clone(), Vec::new());
        if let Some(start) = Start::of(&problem, first)? {
            problem = start.stepping(&problem)?;
            if shows_start {
                ticks.push(TickRecord::of_start(&start)?);
                done(&ticks[0], Some(&start.solution))?;
            }
        }
        let intervals = Intervals::Weighed(module);
        let play =
            Play { session, intervals, units: Units::default(), evolution: None, error: None };
        ticks.extend(play.through(&problem, moments, done)?);
        Ok((module.name.clone(), ticks))
    })
}

/// Brings `problem` to the first moment at which it has a solution, where its session begins; the kinds of its parts. `None` where
/// there is no such moment.
fn begun(problem: &mut Problem, moments: &[ScheduledTick]) -> Result<Option<PartCounts>> {
    if moments.is_empty() {
        return Ok(Some(Parts::whatever_inputs(problem)?.counts));
    }
    for moment in moments {
        match moment.set(problem).and_then(|()| Parts::whatever_inputs(problem)) {
            Err(error) if is_unsolvable(&error) => {}
            examined => {
                return Ok(Some(examined.map_err(|error| error.at_time(moment.time))?.counts));
            }
        }
    }
    Ok(None)
}

/// Moments none of which has a solution.
fn unsolvable(
    problem: &Problem,
    moments: &[ScheduledTick],
    mut done: impl FnMut(&TickRecord, Option<&Solution>) -> Result<()>,
) -> Result<Vec<TickRecord>> {
    let mut problem = problem.clone();
    let ticks = moments.iter().map(|moment| {
        let posed = moment.set(&mut problem);
        let tick = match posed.and_then(|()| Parts::whatever_inputs(&problem)) {
            Err(error) => TickRecord::refused(&problem, &error),
            Ok(_) => return Err(Error::Check("a moment without a solution has one".to_owned())),
        };
        done(&tick, None)?;
        Ok(tick)
    });
    ticks.collect()
}

/// Whether contact cannot hold the loads, or holds them at no one place, or data exclude each other where boundaries meet.
fn is_unsolvable(error: &Error) -> bool {
    use KernelError::{Excluded, NoSolution, NotUnique};
    matches!(error.cause(), Some(NoSolution { .. } | NotUnique { .. } | Excluded { .. }))
}

/// A session and what reads it.
struct Play<'s> {
    session: &'s mut dyn Session,
    intervals: Intervals<'s>,
    /// Units of the session; records are in the scene's.
    units: Units,
    /// The bound of the evolution, of steps in time that have one.
    evolution: Option<Evolution>,
    /// Its error, where that is known.
    error: Option<WindowError>,
}

impl Play<'_> {
    /// Goes through the moments.
    fn through(
        mut self,
        problem: &Problem,
        moments: &[ScheduledTick],
        mut done: impl FnMut(&TickRecord, Option<&Solution>) -> Result<()>,
    ) -> Result<Vec<TickRecord>> {
        let mut problem = problem.clone();
        let ticks = moments.iter().map(|moment| {
            let (mut tick, solution) = match moment.set(&mut problem) {
                // A controller has its own scalar and looks itself.
                Err(error) if !is_unsolvable(&error) => return Err(error),
                Err(error) if !matches!(self.intervals, Intervals::Weighed(_)) => {
                    (TickRecord::refused(&problem, &error), None)
                }
                _ => self.tick(&mut problem)?,
            };
            if let (Some(error), Some(solution)) = (&mut self.error, &solution) {
                tick.window_error = Some(error.advance(moment, solution)?);
            }
            done(&tick, solution.as_ref())?;
            Ok(tick)
        });
        ticks.collect()
    }

    /// Answers for `problem`; the next step of a problem in time begins from the answer.
    fn tick(&mut self, problem: &mut Problem) -> Result<(TickRecord, Option<Solution>)> {
        match self.session.play(problem) {
            Ok(_) => {}
            Err(error)
                if is_unsolvable(&error) || matches!(self.intervals, Intervals::Weighed(_)) =>
            {
                return Ok((TickRecord::refused(problem, &error), None));
            }
            Err(error) => return Err(error.at_time(problem.time)),
        }
        let answer = self.session.answer(problem);
        let solution = answer.map_err(|error| error.at_time(problem.time))?;
        let mut tick = TickRecord::of(problem, &solution)?;
        tick.intervals = self.intervals.of(problem, (&*self.session, &solution))?;
        if let Some(evolution) = &mut self.evolution {
            evolution.advance(&solution.certified.evolution);
            tick.over_time =
                self.intervals.over_time(problem, (&solution, evolution.distance()))?;
        }
        let window = self.evolution.as_ref().map(Evolution::window);
        let window = window.or_else(|| self.session.window());
        let mut tick = tick.with_window(&problem.scene, window);
        let is_plain = self.units == Units::default();
        let posed = (!is_plain).then(|| Arc::new(problem.clone()));
        problem.advance(solution.state());
        let Some(posed) = posed else { return Ok((tick, Some(solution))) };
        tick.rescale(problem, &self.units);
        Ok((tick, Some(in_scene(&posed, &self.units, solution))))
    }
}
