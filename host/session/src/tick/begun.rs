//! A play before its first tick: at the start of its steps, or where another play has ended.

use signorini_certify::CertifiedFields;
use signorini_certify::evolution::Evolution;
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_solve::{Start, step_of};

use super::moments::Done;
use super::saved::Saved;
use super::window_error::WindowError;
use super::{ScheduledTick, TickRecord};

/// A problem before its first tick, in the scene's units.
pub(super) struct Begun {
    pub problem: Problem,
    /// The bound of the evolution at the start, of steps in time that have one.
    pub evolution: Option<Evolution>,
    /// Its error, where that is known.
    pub error: Option<WindowError>,
    /// The record of a start that is shown.
    pub ticks: Vec<TickRecord>,
}

impl Begun {
    /// From the start of steps in time, or as given where ticks are none. `s_at_start` may know another s there than that of the scene's
    /// start.
    pub fn anew(
        given: &Problem,
        moments: &[ScheduledTick],
        (shows_start, done): (bool, Done),
        s_at_start: impl FnOnce(&Problem) -> Option<CertifiedFields>,
    ) -> Result<Self> {
        let first = moments.first().map_or(0.0, |moment| moment.time);
        let mut begun = Self::of(given.clone());
        let Some(mut start) = Start::of(given, first)? else { return Ok(begun) };
        if let Some(s) = s_at_start(&start.problem) {
            let certified = &mut start.solution.certified;
            (certified.vertices, certified.bubbles) = (s.vertices, s.bubbles);
        }
        begun.problem = start.stepping(given)?;
        begun.evolution = start.evolution;
        if let Some(of) = &begun.evolution {
            begun.error = WindowError::begin(&start, of.seconds())?;
        }
        if shows_start {
            begun.ticks.push(TickRecord::of_start(&start)?);
            done(&begun.ticks[0], Some(&start.solution))?;
        }
        Ok(begun)
    }

    /// From a state of another play on this mesh, whose error of the evolution is not taken over yet.
    pub fn again(given: &Problem, saved: &Saved) -> Result<Self> {
        Ok(Self::of(match &saved.state {
            Some(state) => given.stepping(step_of(&given.scene)?, state.clone())?,
            None => given.clone(),
        }))
    }

    fn of(problem: Problem) -> Self {
        Self { problem, evolution: None, error: None, ticks: Vec::new() }
    }

    /// With the error of the evolution until a state, where that is known; its weights fade within so many seconds.
    pub fn with_error(self, given: &Problem, saved: &Saved, seconds: Option<f64>) -> Self {
        let resumed = || {
            let (state, units) = (saved.state.as_ref()?, &saved.units);
            let vertices = state.vertices.iter().map(|&u| units.value(u)).collect();
            let bubbles = state.bubbles.iter().map(|&bubble| bubble * units.u).collect();
            let at_last = Problem { time: saved.last.time, ..given.clone() };
            WindowError::resume(&at_last, seconds?, saved.error?, [vertices, bubbles])
        };
        Self { error: resumed(), ..self }
    }
}
