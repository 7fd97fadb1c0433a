//! One matrix for many problems: all loads and laws of contact.

use super::auto::by_factor;
use super::multigrid::by_multigrid;
use super::{Ldlt, Options, Result, Solution, Task, unfit};
use signorini_problem::{Assembled, Parts, Problem};

/// Beyond so many unknowns a factor takes longer, and more memory, than some solutions without.
pub const MOST_FACTORED: usize = 200_000;

/// Whatever solves all problems on a matrix.
#[derive(Debug)]
pub enum SharedSolver {
    /// The kernel's factor.
    Factor(Ldlt<f64>),
    /// Multigrid, for each problem anew.
    Multigrid,
}

impl SharedSolver {
    /// The solver for the matrix of `problem`; `None` where it is singular, or its factor would take too much memory.
    ///
    /// # Errors
    /// Numbers that f64 cannot hold.
    pub fn of(problem: &Problem) -> Result<Option<Self>> {
        if problem.topology.counts.unknowns() > MOST_FACTORED {
            return Ok(Some(Self::Multigrid));
        }
        let unfit = unfit::<f64>(&problem.scene);
        let assembled = Assembled::<f64>::new(problem).map_err(&unfit)?;
        let system = assembled.system().map_err(&unfit)?;
        Ok(Ldlt::new(&system).map_err(&unfit)?.map(Self::Factor))
    }

    /// Solves a problem with this matrix, in the units that it has; nothing where it has no solution. Where that takes iterations they
    /// begin at `start`, one mean per edge, or anew where that is empty.
    ///
    /// # Errors
    /// Numbers that f64 cannot hold.
    pub fn solve(&self, problem: &Problem, start: &[f64]) -> Result<Option<Solution>> {
        let (parts, options) = (&Parts::examine(problem)?, &Options::default());
        let task = Task { problem, parts, options, start, is_posed: false };
        match self {
            Self::Factor(factor) => by_factor(&Task { start: &[], ..task }, Some(factor)),
            Self::Multigrid => by_multigrid::<f64>(&task).map(Some),
        }
    }
}
