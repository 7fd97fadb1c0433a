//! One play: how its session begins, anew or where another one ended, and what happens at each moment.

use std::sync::Arc;

use signorini_certify::evolution::Evolution;
use signorini_intervals::Lasting;
use signorini_kernel::Error as KernelError;
use signorini_kernel::mesh::components::PartCounts;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Approach, Loads, Parts, Problem};
use signorini_scene::error::{Error, InputError, Result};
use signorini_scene::scene::units::Units;
use signorini_solve::{ScalarKind, Solution, Start, choose_units, in_scene, step_of};

use super::intervals::Intervals;
use super::saved::{Moment, Saved};
use super::window_error::WindowError;
use super::{Begin, Budget, Onward, Played, ScheduledTick, TickRecord};
use crate::{Session, coarse, kernel_tick, solves};

/// Who looks at each tick, and says what follows.
pub(super) type Done<'d> = &'d mut dyn FnMut(&TickRecord, Option<&Solution>) -> Result<Onward>;

/// A problem at the moment that its session is made for, in the scene's units, and what comes before its first tick.
struct Begun {
    problem: Problem,
    /// The kinds of its parts; `None` where no moment has a solution.
    parts: Option<PartCounts>,
    evolution: Option<Evolution>,
    /// Its error, where that is known.
    error: Option<WindowError>,
    ticks: Vec<TickRecord>,
}

/// Plays `given` in the scalar of `budget`; both are compiled here, and not wherever ticks are played.
pub(super) fn in_scalar(
    given: &Problem,
    begin: Begin,
    moments: &[ScheduledTick],
    budget: &Budget,
    done: Done,
) -> Result<Played> {
    match budget.scalar {
        ScalarKind::F64 => play::<f64>(given, begin, moments, budget, done),
        ScalarKind::F32 => play::<f32>(given, begin, moments, budget, done),
    }
}

fn play<R: Scalar>(
    given: &Problem,
    begin: Begin,
    moments: &[ScheduledTick],
    budget: &Budget,
    done: Done,
) -> Result<Played> {
    let begun = match begin {
        Begin::Anew(_) => anew(given, moments, budget, done)?,
        Begin::From(saved) => again(given, saved).map_err(|error| saved.blamed(error))?,
    };
    let Begun { problem, parts, mut evolution, error, mut ticks } = begun;
    let Some(parts) = parts else {
        return Ok(Played { ticks: unsolvable(given, moments, done)?, saved: None });
    };
    let moment = Moment::of(&problem);
    let units = choose_units(&Problem {
        loads: Loads { step: None, ..problem.loads.clone() },
        ..problem.clone()
    })?;
    let coarse = match begin {
        Begin::Anew(Some(coarse)) => Some(at_moment(coarse, &problem, &units)?),
        _ => None,
    };
    let mut problem = in_other(problem, &units)?;
    let own = problem.clone();
    let is_cold = !matches!(begin, Begin::From(Saved { session: Some(_), .. }));
    let start = |u: &mut [R]| match is_cold {
        true => coarse::start(&own, coarse.as_ref(), budget.is_open(), u),
        false => Ok(()),
    };
    let of_kernel = budget.tolerance.is_none() && Approach::Tick.lack_with(&own, parts).is_none();
    let least = own.at_least_transfer()?;
    let in_units = Budget { error: budget.error / units.energy(), ..*budget };
    let mut session = match of_kernel {
        true => kernel_tick::session(&own, &least, in_units.limits(), start)?,
        false => solves::warm::<R>(&own, budget.settings(), start)?,
    };
    let mut moments = moments.to_vec();
    match begin {
        Begin::Anew(_) => evolution = evolution.map(|of| of.in_unit(units.energy())),
        Begin::From(saved) => {
            let restored = restore(saved, &units, &mut problem, &mut *session);
            restored.map_err(|error| saved.blamed(error))?;
            evolution = saved.evolution;
            // What the command line says of inputs acts from here on.
            let inputs = given.scene.inputs.iter().map(|input| input.default).enumerate();
            if let Some(first) = moments.first_mut() {
                first.inputs.splice(0..0, inputs);
            }
        }
    }
    let intervals = match budget.intervals {
        true => Intervals::Anew(Lasting::default()),
        false => Intervals::Unasked,
    };
    let mut play = Play { units, evolution, error, ..Play::new(&mut *session, intervals) };
    ticks.extend(play.through(&mut problem, &moments, done)?);
    let mut saved = Saved::new(given, budget.scalar, [moment, Moment::of(&problem)]);
    saved.units = units;
    saved.state = problem.loads.step.take().map(|step| step.begin);
    saved.evolution = play.evolution.filter(Evolution::is_finite);
    let sums = play.error.as_ref().map(WindowError::sums);
    saved.error = sums.filter(|sums| sums.iter().all(|sum| sum.is_finite()));
    saved.session = session.saved();
    Ok(Played { ticks, saved: Some(saved).filter(Saved::is_finite) })
}

/// A play from the start.
fn anew(given: &Problem, moments: &[ScheduledTick], budget: &Budget, done: Done) -> Result<Begun> {
    let (mut problem, mut evolution, mut error, mut ticks) =
        (given.clone(), None, None, Vec::new());
    let first = moments.first().map_or(0.0, |moment| moment.time);
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
    let parts = begun(&mut problem, moments)?;
    Ok(Begun { problem, parts, evolution, error, ticks })
}

/// A play whose session was made before, for the same moment; its state in time is in the session's units for now.
fn again(given: &Problem, saved: &Saved) -> Result<Begun> {
    saved.check_mesh(given)?;
    let mut problem = match &saved.state {
        Some(state) => given.stepping(step_of(&given.scene)?, state.clone())?,
        None => given.clone(),
    };
    let Moment { time, .. } = saved.begun;
    problem.set(&saved.begun.values().collect::<Vec<_>>(), time)?;
    let parts = Some(Parts::whatever_inputs(&problem)?.counts);
    let error = error_until(given, saved);
    Ok(Begun { problem, parts, evolution: None, error, ticks: Vec::new() })
}

/// The error of the evolution until a state, where that is known.
fn error_until(given: &Problem, saved: &Saved) -> Option<WindowError> {
    let (state, units) = (saved.state.as_ref()?, &saved.units);
    let vertices = state.vertices.iter().map(|&u| units.value(u)).collect();
    let bubbles = state.bubbles.iter().map(|&bubble| bubble * units.u).collect();
    let at_last = Problem { time: saved.last.time, ..given.clone() };
    let seconds = saved.evolution.as_ref()?.seconds();
    WindowError::resume(&at_last, seconds, saved.error?, [vertices, bubbles])
}

/// Lays the numbers of a state into `problem` and its session, both in `units`.
fn restore(
    saved: &Saved,
    units: &Units,
    problem: &mut Problem,
    session: &mut dyn Session,
) -> Result<()> {
    if saved.units != *units {
        let message = format!("units: {:?}, expected {units:?}", saved.units);
        return Err(InputError::new(message).into());
    }
    saved.state.iter().for_each(|state| problem.advance(state.clone()));
    saved.session.as_ref().map_or(Ok(()), |saved| session.restore(saved))
}

/// The problem on a coarser mesh, at the time of `problem` and with its inputs, in `units`.
fn at_moment(coarse: &Problem, problem: &Problem, units: &Units) -> Result<Problem> {
    let mut coarse = coarse.clone();
    coarse.scene = problem.scene.clone();
    coarse.set_time(problem.time)?;
    in_other(coarse, units)
}

fn in_other(problem: Problem, units: &Units) -> Result<Problem> {
    if *units == Units::default() { Ok(problem) } else { problem.in_units(units) }
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
fn unsolvable(problem: &Problem, moments: &[ScheduledTick], done: Done) -> Result<Vec<TickRecord>> {
    let mut problem = problem.clone();
    each(moments, done, |moment| {
        let posed = moment.set(&mut problem);
        match posed.and_then(|()| Parts::whatever_inputs(&problem)) {
            Err(error) => Ok((TickRecord::refused(&problem, &error), None)),
            Ok(_) => Err(Error::Check("a moment without a solution has one".to_owned())),
        }
    })
}

/// Records of moments, until `done` stops it.
fn each(
    moments: &[ScheduledTick],
    done: Done,
    mut tick: impl FnMut(&ScheduledTick) -> Result<(TickRecord, Option<Solution>)>,
) -> Result<Vec<TickRecord>> {
    let mut ticks = Vec::new();
    for moment in moments {
        let (record, solution) = tick(moment)?;
        let onward = done(&record, solution.as_ref())?;
        ticks.push(record);
        if onward == Onward::Stop {
            break;
        }
    }
    Ok(ticks)
}

/// Whether contact cannot hold the loads, or holds them at no one place, or data exclude each other where boundaries meet.
fn is_unsolvable(error: &Error) -> bool {
    use KernelError::{Excluded, NoSolution, NotUnique};
    matches!(error.cause(), Some(NoSolution { .. } | NotUnique { .. } | Excluded { .. }))
}

/// A session and what reads it.
pub(super) struct Play<'s> {
    session: &'s mut dyn Session,
    intervals: Intervals<'s>,
    /// Units of the session; records are in the scene's.
    units: Units,
    /// The bound of the evolution, of steps in time that have one.
    evolution: Option<Evolution>,
    /// Its error, where that is known.
    error: Option<WindowError>,
}

impl<'s> Play<'s> {
    /// Of a session in the scene's units, without a bound of an evolution.
    pub fn new(session: &'s mut dyn Session, intervals: Intervals<'s>) -> Self {
        Self { session, intervals, units: Units::default(), evolution: None, error: None }
    }

    /// Goes through the moments; `problem` stays at the last.
    pub fn through(
        &mut self,
        problem: &mut Problem,
        moments: &[ScheduledTick],
        done: Done,
    ) -> Result<Vec<TickRecord>> {
        each(moments, done, |moment| match moment.set(problem) {
            // A controller has its own scalar and looks itself.
            Err(error) if !is_unsolvable(&error) => Err(error),
            Err(error) if !matches!(self.intervals, Intervals::Weighed(_)) => {
                Ok((TickRecord::refused(problem, &error), None))
            }
            _ => {
                let (mut tick, solution) = self.tick(problem)?;
                if let (Some(error), Some(solution)) = (&mut self.error, &solution) {
                    tick.window_error = Some(error.advance(moment, solution)?);
                }
                Ok((tick, solution))
            }
        })
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
