//! The method of a module, on this machine.

use signorini_contact::Condensed;
use signorini_contact::dense::Iterate;
use signorini_contact::dense::blocks::{Block, Blocks};
use signorini_contact::dense::ranges::Given;
use signorini_contact::method::{Linear, Method, Pivots, SolveSummary, Sweeps, TwoPhases};
use signorini_contact::storage::TableauStorage;
use signorini_device::condensed::Solver;
use signorini_kernel::Error;
use signorini_kernel::limits::Deadline;
use signorini_problem::scalar::Scalar;

use super::arrays;

/// The method that the module has, chosen at run time.
#[derive(Debug)]
pub(super) struct DeskSolver<R: Scalar> {
    pub(super) solver: arrays::Solver,
    pub(super) tableau: TableauStorage<Vec<Block<R>>, Vec<u8>, Vec<R>>,
    /// Whether this tick has another matrix than the one before.
    pub(super) has_begun_anew: bool,
}

impl<R: Scalar> DeskSolver<R> {
    fn has_tableau(&self) -> bool {
        matches!(self.solver, arrays::Solver::Exchanges(_) | arrays::Solver::TwoPhases)
    }
}

impl<R: Scalar> Solver<R> for DeskSolver<R> {
    type Method<'a> = DeskMethod<'a, R>;

    fn method<'a>(
        &'a mut self,
        model: &Condensed<'a, R>,
        pivots: u32,
        sweeps: Sweeps<R>,
    ) -> Result<DeskMethod<'a, R>, Error> {
        let tableau = &mut self.tableau;
        Ok(match self.solver {
            arrays::Solver::Linear => DeskMethod::Linear,
            arrays::Solver::Sweeps => DeskMethod::Sweeps(sweeps),
            arrays::Solver::TwoPhases => DeskMethod::TwoPhases(tableau.two_phases(model)?),
            arrays::Solver::Exchanges(_) => {
                DeskMethod::Pivots(tableau.method(model, pivots, sweeps)?)
            }
        })
    }

    fn reset(&mut self) {
        self.tableau.reset();
        self.has_begun_anew = true;
    }

    fn save(&self, put: impl FnMut(R)) {
        if self.has_tableau() {
            self.tableau.save(put);
        }
    }

    fn restore(&mut self, take: impl FnMut() -> R) {
        if self.has_tableau() {
            self.tableau.restore(take);
        }
    }
}

/// One of the methods.
pub(super) enum DeskMethod<'a, R> {
    Linear,
    Sweeps(Sweeps<R>),
    Pivots(Pivots<'a, R>),
    TwoPhases(TwoPhases<'a, R>),
}

impl<R: Scalar> Method<R> for DeskMethod<'_, R> {
    fn solve<F: FnMut() -> u32>(
        &mut self,
        matrix: &Blocks<R>,
        given: Given<R>,
        iterate: Iterate<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<SolveSummary, Error> {
        match self {
            Self::Linear => Linear.solve(matrix, given, iterate, deadline),
            Self::Sweeps(method) => method.solve(matrix, given, iterate, deadline),
            Self::Pivots(method) => method.solve(matrix, given, iterate, deadline),
            Self::TwoPhases(method) => method.solve(matrix, given, iterate, deadline),
        }
    }
}
