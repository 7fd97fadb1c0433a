//! The ways to solve the condensed problem, behind one face.
//!
//! [`Sweeps`] need no memory of their own and cost the same every time; [`Pivots`] hold a tableau of
//! n (n + 1) / 2 numbers and end with the exact solution, after as many exchanges as edges change
//! sides. Where these are too many for one tick, sweeps make the best of what there is, and the next
//! tick goes on exchanging: the answer is feasible and has its bound in any case. Without contact there is
//! nothing to solve, and [`Linear`] brings no code for it.

use crate::dense::Iterate;
use crate::dense::blocks::Blocks;
use crate::dense::pivoting::{self, Found, settle};
use crate::dense::ranges::Given;
use crate::dense::rule::{Largest, Phases, Rule as _};
use crate::dense::sizes;
use crate::dense::sor;
use crate::dense::tableau::{InitialTableau, Tableau};
use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, all_finite, same_length};
use signorini_kernel::limits::Deadline;
use signorini_kernel::report::{Ended, Report};
use signorini_kernel::verdict::Verdict;

/// Summary of a solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SolveSummary {
    /// Reason for its end.
    pub ended: Ended,
    /// Exchanges.
    pub pivots: u32,
    /// Sweeps.
    pub sweeps: u32,
}

impl SolveSummary {
    /// Report of a tick on it.
    pub(super) fn report<R: Real>(self, x: &[R], verdict: Verdict<R>) -> Report<R> {
        let active = x.iter().filter(|x| **x == R::ZERO).count() as u32;
        let Self { ended, pivots, sweeps } = self;
        Report { ended, exchanges: pivots, sweeps, active, verdict, figures: () }
    }
}

/// Solves x ≥ 0, Sx − b ≥ 0, xᵀ(Sx − b) = 0, or the same with ranges ([`crate::dense::ranges`]).
pub trait Method<R: Real> {
    /// From `iterate.x`, as far as the method is allowed to go and until the deadline: x is feasible whenever that is.
    ///
    /// # Errors
    /// Loads whose answer may overflow, arrays of the wrong length: x and the method are what they were then.
    fn solve<F: FnMut() -> u32>(
        &mut self,
        matrix: &Blocks<R>,
        given: Given<R>,
        iterate: Iterate<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<SolveSummary, Error>;
}

/// No edge is in contact: all outputs are linear in the inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Linear;

impl<R: Real> Method<R> for Linear {
    fn solve<F: FnMut() -> u32>(
        &mut self,
        matrix: &Blocks<R>,
        _: Given<R>,
        _: Iterate<R>,
        _: &mut Deadline<F>,
    ) -> Result<SolveSummary, Error> {
        same_length(Array::Contact, matrix.order(), 0)?;
        Ok(SolveSummary { ended: Ended::Exact, pivots: 0, sweeps: 0 })
    }
}

/// Projected SOR.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sweeps<R> {
    /// ω, inside (0, 2).
    pub omega: R,
    /// The Σ|min(x_i, ω r_i)| that is small enough, relative to ‖x‖ or ‖b‖, the larger. Where it is less, it is
    /// at most 2⁻¹⁰ ‖b‖ besides: next to a huge x nothing else would tell that x is none.
    pub tolerance: R,
    /// Most sweeps of a solve.
    pub most: u32,
}

impl<R: Real> Method<R> for Sweeps<R> {
    fn solve<F: FnMut() -> u32>(
        &mut self,
        matrix: &Blocks<R>,
        given: Given<R>,
        iterate: Iterate<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<SolveSummary, Error> {
        if !(self.omega > R::ZERO && self.omega < R::TWO) {
            return Err(Error::Relaxation);
        }
        let own = sizes::of_load(given.load)?;
        same_length(Array::Scratch, iterate.scratch.len(), iterate.x.len())?;
        copy(iterate.x, iterate.scratch);
        if sizes::is_absurd(sizes::norm(iterate.x), own) {
            // What a load of another size, or one without a solution, has left: sweeps would never come back.
            iterate.x.fill(R::ZERO);
        }
        let progress = self.sweep_on(matrix, given, own, iterate.x, deadline)?;
        settle(matrix, given, iterate.x, iterate.residual, iterate.open)?;
        if let Err(error) = all_finite(Array::Unknowns, iterate.x) {
            copy(iterate.scratch, iterate.x);
            return Err(error);
        }
        Ok(progress)
    }
}

impl<R: Real> Sweeps<R> {
    /// Sweeps until x is good enough, or their number or the time is used up; `own` is ‖b‖.
    fn sweep_on<F: FnMut() -> u32>(
        &self,
        matrix: &Blocks<R>,
        given: Given<R>,
        own: R,
        x: &mut [R],
        deadline: &mut Deadline<F>,
    ) -> Result<SolveSummary, Error> {
        let sane = self.tolerance.or_larger(R::ONE / R::from_count(1024)) * own;
        let mut progress = SolveSummary { ended: Ended::OutOfSweeps, pivots: 0, sweeps: 0 };
        while progress.sweeps < self.most {
            if !deadline.allows_a_sweep() {
                progress.ended = Ended::OutOfTime;
                break;
            }
            let defect = sor::sweep(matrix, given, self.omega, x)?;
            progress.sweeps += 1;
            let size = sizes::norm(x);
            let small = self.tolerance * size.or_larger(own);
            if defect <= small && defect <= sane && !sizes::is_absurd(size, own) {
                progress.ended = Ended::Settled;
                break;
            }
        }
        Ok(progress)
    }
}

fn copy<R: Real>(from: &[R], to: &mut [R]) {
    to.iter_mut().zip(from).for_each(|(to, &from)| *to = from);
}

/// Principal pivoting, and sweeps where it does not get to the end.
#[derive(Debug)]
pub struct Pivots<'a, R> {
    /// The tableau, kept from tick to tick.
    pub tableau: Tableau<'a, R>,
    /// Where it began.
    pub start: InitialTableau<'a, R>,
    /// Most exchanges of a solve.
    pub most: u32,
    /// Sweeps that follow where exchanges do not suffice.
    pub sweeps: Sweeps<R>,
}

impl<R: Real> Method<R> for Pivots<'_, R> {
    fn solve<F: FnMut() -> u32>(
        &mut self,
        matrix: &Blocks<R>,
        given: Given<R>,
        iterate: Iterate<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<SolveSummary, Error> {
        let mut iterate = iterate;
        let lent = iterate.reborrow();
        let most = self.most;
        let may_exchange = |pivots| pivots < most && deadline.allows_a_sweep();
        let rule = &mut Largest;
        let (found, pivots) = pivoting::find(
            matrix,
            given,
            &mut self.tableau,
            &self.start,
            rule,
            may_exchange,
            lent,
        )?;
        if found == Found::Exact {
            return Ok(SolveSummary { ended: Ended::Exact, pivots, sweeps: 0 });
        }
        match self.sweeps.solve(matrix, given, iterate.reborrow(), deadline) {
            Ok(rest) => Ok(SolveSummary { pivots, ..rest }),
            Err(error) => {
                // No matrix that is positive definite comes here; any other begins anew.
                self.tableau.reset(&self.start)?;
                iterate.x.fill(R::ZERO);
                Err(error)
            }
        }
    }
}

/// Principal pivoting in two phases, for a matrix none of whose entries off the diagonal is positive: an end after at most
/// n + n/2 exchanges is proved, so that nothing follows; with limits in three, and 3n + n/2. Where it starts anew, it does with S itself.
#[derive(Debug)]
pub struct TwoPhases<'a, R> {
    /// The tableau, kept from tick to tick.
    pub tableau: Tableau<'a, R>,
}

impl<R: Real> Method<R> for TwoPhases<'_, R> {
    fn solve<F: FnMut() -> u32>(
        &mut self,
        matrix: &Blocks<R>,
        given: Given<R>,
        iterate: Iterate<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<SolveSummary, Error> {
        let mut iterate = iterate;
        let has_limits = given.ranges.are_limited();
        let most = Phases::default().most(matrix.order(), has_limits) as u32;
        let mut is_in_time = true;
        let may_exchange = |pivots| {
            is_in_time = deadline.allows_a_sweep();
            pivots < most && is_in_time
        };
        let (lent, rule) = (iterate.reborrow(), &mut Phases::default());
        let start = &InitialTableau::untouched(matrix);
        let (found, pivots) =
            pivoting::find(matrix, given, &mut self.tableau, start, rule, may_exchange, lent)?;
        let ended = match found {
            Found::Exact => Ended::Exact,
            _ if !is_in_time => Ended::OutOfTime,
            // Rounding has eaten the tableau: x is zeros, and the next tick begins anew.
            _ => Ended::OutOfSweeps,
        };
        if found == Found::Worn {
            let Iterate { x, residual, open, .. } = iterate;
            settle(matrix, given, x, residual, open)?;
        }
        Ok(SolveSummary { ended, pivots, sweeps: 0 })
    }
}
