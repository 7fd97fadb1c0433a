//! Where the outputs of a tick lie for the exact solution, worked out anew from its answer.

use super::TickInterval;
use super::player::PlayedTick;
use signorini_intervals::{Answered, Lasting, of_next};
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_solve::ScalarKind;

/// What stays from tick to tick.
pub(super) struct Intervals {
    scalar: ScalarKind,
    lasting: Lasting,
}

impl Intervals {
    pub fn new(scalar: ScalarKind) -> Self {
        Self { scalar, lasting: Lasting::default() }
    }

    /// Those of the declared outputs, in their order.
    pub fn of(&mut self, problem: &Problem, answer: &PlayedTick) -> Result<Vec<TickInterval>> {
        self.lasting.renew(problem)?;
        let PlayedTick { certified, bound, .. } = answer;
        let bound = bound.filter(|bound| bound.total.is_finite());
        let answered = Answered { certified, bound, scalar: self.scalar };
        let mut all = of_next(problem, &answered, &self.lasting);
        let names = problem.scene.outputs.iter().map(|output| &output.name.value);
        let found = names.filter_map(|name| all.remove(name));
        Ok(found.map(|found| found.map(|of| of.ends())).collect())
    }
}
