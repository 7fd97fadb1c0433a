//! What happens at each moment of a play: an answer, its record, and who looks at them.

use std::sync::Arc;

use signorini_certify::evolution::Evolution;
use signorini_kernel::Error as KernelError;
use signorini_problem::Problem;
use signorini_scene::error::{Error, Result};
use signorini_scene::scene::units::Units;
use signorini_solve::{Solution, in_scene};

use super::intervals::Intervals;
use super::window_error::WindowError;
use super::{Onward, ScheduledTick, TickRecord};
use crate::Session;

/// Who looks at each tick, and says what follows.
pub(super) type Done<'d> = &'d mut dyn FnMut(&TickRecord, Option<&Solution>) -> Result<Onward>;

/// Records of moments, until `done` stops it.
pub(super) fn each(
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
pub(super) fn is_unsolvable(error: &Error) -> bool {
    use KernelError::{Excluded, NoSolution, NotUnique};
    matches!(error.cause(), Some(NoSolution { .. } | NotUnique { .. } | Excluded { .. }))
}

/// A session and what reads it.
pub(super) struct Play<'s> {
    pub session: &'s mut dyn Session,
    pub intervals: Intervals<'s>,
    /// Units of the session; records are in the scene's.
    pub units: Units,
    /// The bound of the evolution, of steps in time that have one.
    pub evolution: Option<Evolution>,
    /// Its error, where that is known.
    pub error: Option<WindowError>,
    /// How long a controller's answered steps have gone on from a stated u, and a step.
    pub stated: Option<[f64; 2]>,
}

impl<'s> Play<'s> {
    /// Of a session in the scene's units, without a bound of an evolution.
    pub fn new(session: &'s mut dyn Session, intervals: Intervals<'s>) -> Self {
        Self {
            session,
            intervals,
            units: Units::default(),
            evolution: None,
            error: None,
            stated: None,
        }
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
                tick.window_error = self.advance_error(moment, solution.as_ref())?;
                Ok((tick, solution))
            }
        })
    }

    /// The error over time after an answer, where it is known: from the first tick on that has no s, as one that is refused or not
    /// certified, nobody knows it.
    fn advance_error(
        &mut self,
        moment: &ScheduledTick,
        answer: Option<&Solution>,
    ) -> Result<Option<f64>> {
        let answer = answer.filter(|of| !of.certified.vertices.is_empty());
        let (Some(mut error), Some(answer)) = (self.error.take(), answer) else { return Ok(None) };
        let now = match error.advance(moment, answer) {
            Ok(now) => now,
            // What this machine refuses a controller may have answered.
            Err(why) if is_unsolvable(&why) => return Ok(None),
            Err(why) => return Err(why),
        };
        self.error = Some(error);
        Ok(Some(now))
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
        if let Some([since, step]) = &mut self.stated {
            *since += *step;
        }
        let evolved = match &mut self.evolution {
            Some(evolution) => {
                evolution.advance(&solution.certified.evolution);
                Some((evolution.window(), evolution.distance()))
            }
            None => self.session.window().map(|window| {
                (window, Evolution::distance_of(window, self.stated.map(|[since, _]| since)))
            }),
        };
        if let Some((_, distance)) = evolved {
            tick.over_time = self.intervals.over_time(problem, (&solution, distance))?;
        }
        let window = evolved.map(|(window, _)| window);
        let mut tick = tick.with_window(&problem.scene, window);
        let is_plain = self.units == Units::default();
        let posed = (!is_plain).then(|| Arc::new(problem.clone()));
        problem.advance(solution.state());
        let Some(posed) = posed else { return Ok((tick, Some(solution))) };
        tick.rescale(problem, &self.units);
        Ok((tick, Some(in_scene(&posed, &self.units, solution))))
    }
}
