//! A tick that a factor solves: no sweeps, whatever the condition of the matrix.
//!
//! ```text
//!   solve ─┬─ found ─────► certificate, or flux (15) ─► Report, 0 sweeps
//!          └─ not found ─► sweeps, as without a factor
//! ```
//! It is found but for problems that the scalar cannot tell from singular ones, and for factors of another matrix,
//! whose corrections do not shrink; where a start next to the answer hides that, every row of K is asked. The solve is not cut short: it is begun
//! where the deadline allows a sweep, so that [`Deadline::sweep`] has to cover the exchanges and
//! substitutions of a solve too.

use super::method::{Method, Sweeping};
use super::range::largest_useful;
use super::{Deadline, Limits, Report, Running};
use crate::sparse::contact::SLACK;
use crate::sparse::{Balance, Exact};
use signorini_kernel::{Error, Index, Real, psor};

/// Solves with a factor, whose answer gets a bound where `sweeps` give one.
#[derive(Debug)]
pub struct Substitutions<'e, 'a, R, I, S> {
    /// The factor of the tick's matrix, and what the last tick left in its memory.
    pub exact: &'e mut Exact<'a, R, I>,
    /// What follows where there is no answer, or where the deadline allows for no solve.
    pub sweeps: S,
}

impl<R: Real, I: Index, S: Sweeping<R, I>> Method<R, I> for Substitutions<'_, '_, R, I, S> {
    const CERTIFIES: bool = S::CERTIFIES;

    fn restart(&mut self) -> Result<(), Error> {
        self.exact.restart()
    }

    // Inlined: see `Running::advance`.
    #[inline(always)]
    fn advance<F: FnMut() -> u32, const WIDTH: usize>(
        &mut self,
        running: &mut Running<'_, '_, '_, R, I, WIDTH>,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Report<R>, Error> {
        let report = match deadline.allows_a_sweep() && running.solve(self.exact)? {
            true => self.sweeps.conclude(running, limits)?,
            false => self.sweeps.advance(running, limits, deadline)?,
        };
        let exchanges = self.exact.solved().map_or(0, |solved| solved.pivots);
        Ok(Report { exchanges, ..report })
    }
}

impl<R: Real, I: Index, const WIDTH: usize> Running<'_, '_, '_, R, I, WIDTH> {
    /// Whether u is the solution now; if not it is what sweeps may start from. τ is scratch.
    fn solve(&mut self, exact: &mut Exact<R, I>) -> Result<bool, Error> {
        let (discretization, memory) = (&self.tick.discretization, &mut self.tick.memory);
        let (counts, data) = (discretization.edges.counts(), &self.data);
        let balance = Balance {
            edges: &discretization.edges,
            stiffness: discretization.stiffness,
            diagonal: data.diagonal(),
            load: memory.load,
        };
        let places = memory.tau.get_mut(..counts.unknowns()).unwrap_or(&mut []);
        exact.forget_beyond(largest_useful(self.size));
        let solved = exact.solve(&balance, data.law, places, memory.u, &mut [])?;
        self.verdict = None;
        // Next to the last answer corrections tell nothing: by the factor of another matrix they are small as well.
        let is_found = solved.as_ref().is_some_and(|solved| {
            let is_rounding = || psor::is_rounding(&memory.rows, data.law, memory.u, SLACK);
            solved.has_digits() && (solved.contracts() || is_rounding())
        });
        if !is_found {
            memory.carry_over(counts, data, self.size);
        }
        Ok(is_found)
    }
}
