//! One play: how its session begins, anew or where another one ended.

use signorini_certify::evolution::Evolution;
use signorini_intervals::Lasting;
use signorini_kernel::mesh::components::PartCounts;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Approach, Loads, Parts, Problem};
use signorini_scene::error::{Error, InputError, Result};
use signorini_scene::scene::units::Units;
use signorini_solve::{ScalarKind, choose_units};

use super::begun::Begun;
use super::intervals::Intervals;
use super::moments::{Done, Play, each, is_unsolvable};
use super::saved::{Moment, Saved};
use super::{Begin, Budget, Played, ScheduledTick, TickRecord};
use crate::{Session, coarse, kernel_tick, solves};

/// A play at the moment that its session is made for, and the kinds of its problem's parts; `None` where no moment has a solution.
type Posed = (Begun, Option<PartCounts>);

/// How a problem is played.
type Playing = fn(&Problem, Begin, &[ScheduledTick], &Budget, Done) -> Result<Played>;

/// The same in a scalar. Both are compiled here, and not wherever ticks are played.
#[inline(never)]
pub(super) fn of(scalar: ScalarKind) -> Playing {
    match scalar {
        ScalarKind::F64 => play::<f64>,
        ScalarKind::F32 => play::<f32>,
    }
}

fn play<R: Scalar>(
    given: &Problem,
    begin: Begin,
    moments: &[ScheduledTick],
    budget: &Budget,
    done: Done,
) -> Result<Played> {
    let (begun, parts) = match begin {
        Begin::Anew(_) => anew(given, moments, budget, done)?,
        Begin::From(saved) => again(given, saved).map_err(|error| saved.blamed(error))?,
    };
    let Begun { problem, mut evolution, error, mut ticks } = begun;
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
    let saved = Saved::after(play, (given, budget.scalar), moment, &mut problem);
    Ok(Played { ticks, saved: Some(saved).filter(Saved::is_finite) })
}

/// A play from the start.
fn anew(given: &Problem, moments: &[ScheduledTick], budget: &Budget, done: Done) -> Result<Posed> {
    let mut begun = Begun::anew(given, moments, (budget.shows_start, done), |_| None)?;
    let parts = at_first(&mut begun.problem, moments)?;
    Ok((begun, parts))
}

/// A play whose session was made before, for the same moment; its state in time is in the session's units for now.
fn again(given: &Problem, saved: &Saved) -> Result<Posed> {
    saved.check_mesh(given)?;
    let mut begun = Begun::again(given, saved)?;
    let Moment { time, .. } = saved.begun;
    begun.problem.set(&saved.begun.values().collect::<Vec<_>>(), time)?;
    let parts = Some(Parts::whatever_inputs(&begun.problem)?.counts);
    let seconds = saved.evolution.as_ref().map(Evolution::seconds);
    Ok((begun.with_error(given, saved, seconds), parts))
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
fn at_first(problem: &mut Problem, moments: &[ScheduledTick]) -> Result<Option<PartCounts>> {
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
