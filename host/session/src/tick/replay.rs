//! A replay: moments played by the controller that `bake` writes, with the bits that firmware gets.

use std::borrow::Cow;

use signorini_bake::setting;
use signorini_problem::Problem;
use signorini_scene::error::{InputError, Result};
use signorini_solve::{ScalarKind, Solution, at_start};

use super::begun::Begun;
use super::intervals::Intervals;
use super::moments::{Done, Play, is_unsolvable};
use super::saved::{Moment, Saved};
use super::{Onward, Played, ScheduledTick, TickRecord};
use crate::{Session, with_module};

/// Plays `moments` through the controller of `problem`, calling `done` after each, without a solution where the controller
/// refuses the inputs; also the controller's name in a few words. `asked` is a scalar instead of that of the scene's
/// setting, and whether the start of steps in time has a record of its own.
///
/// # Errors
/// Those of `bake`; inputs for which the scene's data are not admissible, with their time.
pub fn replay<D: Into<Onward>>(
    problem: &Problem,
    moments: &[ScheduledTick],
    asked: (Option<ScalarKind>, bool),
    done: impl FnMut(&TickRecord, Option<&Solution>) -> Result<D>,
) -> Result<(String, Vec<TickRecord>)> {
    let (name, played) = replay_on(problem, None, moments, asked, done)?;
    Ok((name, played.ticks))
}

/// [`replay`] from a state of another replay where `from` is one; `done` may stop it.
///
/// # Errors
/// As for [`replay`]; a state that is not one of `problem` and its controller.
pub fn replay_on<D: Into<Onward>>(
    problem: &Problem,
    from: Option<&Saved>,
    moments: &[ScheduledTick],
    asked: (Option<ScalarKind>, bool),
    mut done: impl FnMut(&TickRecord, Option<&Solution>) -> Result<D>,
) -> Result<(String, Played)> {
    let done: Done = &mut |tick, solution| done(tick, solution).map(Into::into);
    replay_to((problem, from), moments, asked, done)
}

fn replay_to(
    (given, from): (&Problem, Option<&Saved>),
    moments: &[ScheduledTick],
    (asked, shows_start): (Option<ScalarKind>, bool),
    done: Done,
) -> Result<(String, Played)> {
    let scalar = setting::scalar(&given.scene, asked)?;
    let baked = as_baked(given)?;
    with_module(&baked, asked, |session, module| {
        let (begun, stated) = match from {
            None => anew(given, moments, &*session, (shows_start, done))?,
            Some(saved) => again(given, saved, session).map_err(|error| saved.blamed(error))?,
        };
        let Begun { mut problem, error, mut ticks, .. } = begun;
        let mut play =
            Play { error, stated, ..Play::new(&mut *session, Intervals::Weighed(module)) };
        ticks.extend(play.through(&mut problem, moments, done)?);
        let last = Moment::of(&problem);
        let saved = Saved::after(play, (given, scalar), last, &mut problem);
        let is_one = |saved: &Saved| saved.session.is_some() && saved.is_finite();
        Ok((module.name.clone(), Played { ticks, saved: Some(saved).filter(is_one) }))
    })
}

/// The problem that is baked: of steps in time with the inputs' own defaults, since a state is one of these, whatever ticks say of inputs.
fn as_baked(given: &Problem) -> Result<Cow<'_, Problem>> {
    if !given.scene.stores() {
        return Ok(Cow::Borrowed(given));
    }
    Ok(Cow::Owned(at_start(given, given.time)?))
}

/// A replay before its first tick, and see [`Play::stated`].
type Replaying = (Begun, Option<[f64; 2]>);

fn anew(
    given: &Problem,
    moments: &[ScheduledTick],
    session: &dyn Session,
    told: (bool, Done),
) -> Result<Replaying> {
    let begun = Begun::anew(given, moments, told, |start| session.s_at_start(start))?;
    let time = given.scene.time.as_ref().filter(|_| begun.problem.loads.step.is_some());
    let stated = time.filter(|of| of.initial.is_some()).map(|of| [0.0, of.step]);
    Ok((begun, stated))
}

/// Goes on from a state: what the command line says of inputs acts from here on.
fn again(given: &Problem, saved: &Saved, session: &mut dyn Session) -> Result<Replaying> {
    saved.check_mesh(given)?;
    let missing = |part: &str| InputError::new(format!("{part}: missing"));
    saved.state.as_ref().ok_or_else(|| missing("state"))?;
    session.restore(saved.session.as_ref().ok_or_else(|| missing("session"))?)?;
    let mut begun = Begun::again(given, saved)?;
    match begun.problem.set_time(saved.last.time) {
        // A tick that was refused has left no mark.
        Err(error) if !is_unsolvable(&error) => return Err(error),
        _ => {}
    }
    let seconds = session.window().map(|[_, seconds]| seconds);
    Ok((begun.with_error(given, saved, seconds), saved.stated))
}
