//! One factor for many problems on the same matrix.

use super::{Ldlt, Options, Solution, auto, unfit};
use signorini_problem::{Assembled, Parts, Problem};
use signorini_scene::error::Result;

/// The factor of a matrix, for all loads and laws of contact.
#[derive(Debug)]
pub struct SharedFactor(Ldlt<f64>);

impl SharedFactor {
    /// Factor of `problem`; `None` where it is singular, or would take too much memory.
    ///
    /// # Errors
    /// Numbers that f64 cannot hold.
    pub fn of(problem: &Problem) -> Result<Option<Self>> {
        let unfit = unfit::<f64>(&problem.scene);
        let assembled = Assembled::<f64>::new(problem).map_err(&unfit)?;
        let system = assembled.system().map_err(&unfit)?;
        Ok(Ldlt::new(&system).map_err(&unfit)?.map(Self))
    }

    /// Solves a problem with this matrix, in the units that it has; nothing where it has no solution.
    ///
    /// # Errors
    /// Numbers that f64 cannot hold.
    pub fn solve(&self, problem: &Problem) -> Result<Option<Solution>> {
        let parts = Parts::examine(problem)?;
        auto::by_known_factor(problem, &parts, &Options::default(), &[], Some(&self.0))
    }
}
