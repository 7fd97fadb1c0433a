//! Where the outputs of a tick lie for the exact solution.

use super::record::TickInterval;
use crate::{Module, Session};
use signorini_intervals::{Answered, Coverage, Lasting, of_next, over_time};
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_solve::Solution;

/// The source of intervals.
pub(super) enum Intervals<'m> {
    /// None are asked for.
    Unasked,
    /// Each tick's answer anew, with what stays from tick to tick.
    Anew(Lasting),
    /// The weights of a module.
    Weighed(&'m Module),
}

impl Intervals<'_> {
    /// Intervals of the declared outputs, in their order; of an answer without a bound, why there is none.
    pub fn of(
        &mut self,
        problem: &Problem,
        (session, solution): (&dyn Session, &Solution),
    ) -> Result<Vec<TickInterval>> {
        let bound = solution.bound.filter(|bound| bound.total.is_finite());
        if let (Self::Anew(_) | Self::Weighed(_), None, Some(why)) =
            (&self, bound, &solution.no_bound)
        {
            return Ok(vec![Err(why.to_string()); problem.scene.outputs.len()]);
        }
        match self {
            Self::Unasked => Ok(Vec::new()),
            Self::Anew(lasting) => {
                if Coverage::Factored.takes(problem) {
                    lasting.renew(problem)?;
                }
                let Solution { certified, scalar, .. } = solution;
                let answered = Answered { certified, bound, scalar: *scalar };
                let mut all = of_next(problem, &answered, lasting);
                let names = problem.scene.outputs.iter().map(|output| &output.name.value);
                let found = names.filter_map(|name| all.remove(name));
                Ok(found.map(|found| found.map(|of| of.ends())).collect())
            }
            Self::Weighed(module) => {
                let declared = problem.scene.outputs.len().min(solution.outputs.len());
                let outputs = &solution.outputs[..declared];
                Ok(module.between(session, outputs, bound.as_ref()))
            }
        }
    }

    /// Intervals of the evolution that ‖c^½(u − s)‖ ≤ `distance` gives, in the order of the outputs.
    pub fn over_time(
        &self,
        problem: &Problem,
        (solution, distance): (&Solution, f64),
    ) -> Result<Vec<Option<[f64; 2]>>> {
        match self {
            Self::Unasked => Ok(Vec::new()),
            Self::Anew(_) | Self::Weighed(_) => over_time(problem, &solution.into(), distance),
        }
    }
}
