//! A tick that a factor solves: no sweeps, whatever the condition of the matrix.
//!
//! ```text
//!   solve ─┬─ found ─────► certificate, or flux (15) ─► Report, 0 sweeps
//!          └─ not found ─► sweeps, as in any tick
//! ```
//! It is found but for problems that the scalar cannot tell from singular ones, and for factors of another matrix,
//! whose corrections do not shrink; where a start next to the answer hides that, every row of K is asked. The solve is not cut short: it is begun
//! where the deadline allows a sweep, so that [`Deadline::sweep`] has to cover the exchanges and
//! substitutions of a solve too.

use super::range::worth;
use super::running::judge;
use super::{Deadline, Ended, Limits, Report, Running};
use crate::certificate::Verdict;
use crate::error::Error;
use crate::index::Index;
use crate::math::Math;
use crate::psor;
use crate::real::Real;
use crate::sparse::{Balance, Exact, SLACK};

impl<R: Real, I: Index, const WIDTH: usize> Running<'_, '_, R, I, WIDTH> {
    /// Solves with `exact`, whose factor is that of this tick's matrix, and certifies the answer; where there is
    /// none, and where the deadline allows for no solve, as [`Running::advance_with`].
    ///
    /// # Errors
    /// A factor of another mesh.
    pub fn advance_factored<M: Math<R>, F: FnMut() -> u32>(
        &mut self,
        exact: &mut Exact<R, I>,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Report<R>, Error> {
        if !deadline.allows_a_sweep() || !self.solve(exact)? {
            return self.advance_with::<M, F>(limits, deadline);
        }
        let verdict = self.certified()?;
        let is_accurate = judge(&verdict, &limits) == Some(Ended::Accurate);
        self.report(if is_accurate { Ended::Accurate } else { Ended::Exact }, verdict)
    }

    /// The same without a bound; where there is no answer as [`Running::advance_uncertified`].
    ///
    /// # Errors
    /// As for [`Running::advance_factored`].
    pub fn advance_factored_uncertified<M: Math<R>, F: FnMut() -> u32>(
        &mut self,
        exact: &mut Exact<R, I>,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Report<R>, Error> {
        if !deadline.allows_a_sweep() || !self.solve(exact)? {
            return self.advance_uncertified::<M, F>(limits, deadline);
        }
        self.recover()?;
        self.report(Ended::Exact, Verdict::NotAsked)
    }

    /// Whether u is the solution now; if not it is what sweeps may start from. τ is scratch.
    fn solve(&mut self, exact: &mut Exact<R, I>) -> Result<bool, Error> {
        let (ground, memory) = (&self.tick.ground, &mut self.tick.memory);
        let (counts, data) = (ground.edges.counts(), &self.data);
        let balance = Balance {
            edges: &ground.edges,
            stiffness: ground.stiffness,
            boundary: data.given.boundary,
            load: memory.load,
        };
        let places = memory.tau.get_mut(..counts.unknowns()).unwrap_or(&mut []);
        exact.forget_beyond(worth(self.size));
        let solved = exact.solve(&balance, data.lower, places, memory.u, &mut [])?;
        self.verdict = None;
        // Next to the last answer corrections tell nothing: by the factor of another matrix they are small as well.
        let is_found = solved.as_ref().is_some_and(|solved| {
            let is_rounding = || psor::is_rounding(&memory.rows, data.lower, memory.u, SLACK);
            solved.has_digits() && (solved.contracts() || is_rounding())
        });
        if !is_found {
            memory.carry_over(counts, data, self.size);
        }
        Ok(is_found)
    }
}
