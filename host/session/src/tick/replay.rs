//! A replay: moments played by the controller that `bake` writes, with the bits that firmware gets.

use std::borrow::Cow;

use signorini_bake::setting;
use signorini_problem::Problem;
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;
use signorini_solve::{ScalarKind, Solution, Start, at_start, step_of};

use super::intervals::Intervals;
use super::moments::{Done, Play, is_unsolvable};
use super::play::error_until;
use super::saved::{Moment, Saved};
use super::window_error::WindowError;
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

/// The scalar of the controller of `scene`: the one that is asked for, else that of the setting, else f32.
///
/// # Errors
/// A setting that no controller can have.
pub fn scalar_of_controller(scene: &Scene, asked: Option<ScalarKind>) -> Result<ScalarKind> {
    setting::scalar(scene, asked)
}

/// A replay before its first tick.
struct Begun {
    problem: Problem,
    error: Option<WindowError>,
    stated: Option<[f64; 2]>,
    ticks: Vec<TickRecord>,
}

fn replay_to(
    (given, from): (&Problem, Option<&Saved>),
    moments: &[ScheduledTick],
    (asked, shows_start): (Option<ScalarKind>, bool),
    done: Done,
) -> Result<(String, Played)> {
    let scalar = scalar_of_controller(&given.scene, asked)?;
    let first = moments.first().map_or(0.0, |moment| moment.time);
    let baked = as_baked(given)?;
    with_module(&baked, asked, |session, module| {
        let begun = match from {
            None => anew(given, (&*session, first), shows_start, done)?,
            Some(saved) => again(given, saved, session).map_err(|error| saved.blamed(error))?,
        };
        let Begun { mut problem, error, stated, mut ticks } = begun;
        let mut play =
            Play { error, stated, ..Play::new(&mut *session, Intervals::Weighed(module)) };
        ticks.extend(play.through(&mut problem, moments, done)?);
        let Play { error, stated, .. } = play;
        let saved = session.saved().map(|session| {
            let last = Moment::of(&problem);
            let mut saved = Saved::new(given, scalar, [last.clone(), last]);
            saved.state = problem.loads.step.take().map(|step| step.begin);
            saved.error = WindowError::finite_sums(error.as_ref());
            (saved.stated, saved.session) = (stated, Some(session));
            saved
        });
        Ok((module.name.clone(), Played { ticks, saved: saved.filter(Saved::is_finite) }))
    })
}

/// The problem that is baked: of steps in time with the inputs' own defaults, since a state is one of these, whatever ticks say of inputs.
fn as_baked(given: &Problem) -> Result<Cow<'_, Problem>> {
    if !given.scene.stores() {
        return Ok(Cow::Borrowed(given));
    }
    Ok(Cow::Owned(at_start(given, given.time)?))
}

fn anew(
    given: &Problem,
    (session, first): (&dyn Session, f64),
    shows_start: bool,
    done: Done,
) -> Result<Begun> {
    let mut begun = Begun { problem: given.clone(), error: None, stated: None, ticks: Vec::new() };
    let Some(mut start) = Start::of(given, first)? else { return Ok(begun) };
    if let Some(s) = session.s_at_start(&start.problem) {
        let certified = &mut start.solution.certified;
        (certified.vertices, certified.bubbles) = (s.vertices, s.bubbles);
    }
    begun.problem = start.stepping(given)?;
    let time = given.scene.time.as_ref();
    begun.stated = time.filter(|of| of.initial.is_some()).map(|of| [0.0, of.step]);
    if let Some(of) = &start.evolution {
        begun.error = WindowError::begin(&start, of.seconds())?;
    }
    if shows_start {
        begun.ticks.push(TickRecord::of_start(&start)?);
        done(&begun.ticks[0], Some(&start.solution))?;
    }
    Ok(begun)
}

/// Goes on from a state: what the command line says of inputs acts from here on.
fn again(given: &Problem, saved: &Saved, session: &mut dyn Session) -> Result<Begun> {
    saved.check_mesh(given)?;
    let missing = |part: &str| InputError::new(format!("{part}: missing"));
    let state = saved.state.clone().ok_or_else(|| missing("state"))?;
    session.restore(saved.session.as_ref().ok_or_else(|| missing("session"))?)?;
    let mut problem = given.stepping(step_of(&given.scene)?, state)?;
    match problem.set_time(saved.last.time) {
        // A tick that was refused has left no mark.
        Err(error) if !is_unsolvable(&error) => return Err(error),
        _ => {}
    }
    let seconds = session.window().map(|[_, seconds]| seconds);
    let error = error_until(given, saved, seconds);
    Ok(Begun { problem, error, stated: saved.stated, ticks: Vec::new() })
}
