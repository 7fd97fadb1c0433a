//! The ways to solve the condensed problem, behind one face.
//!
//! [`Sweeps`] need no memory of their own and cost the same every time; [`Pivots`] hold a tableau of
//! n (n + 1) / 2 numbers and end with the exact solution, after as many exchanges as edges change
//! sides. Where these are too many for one tick, sweeps make the best of what there is, and the next
//! tick goes on exchanging: the answer is feasible and has its bound in any case. Without contact there is
//! nothing to solve, and [`Linear`] brings no code for it.

use super::Iterate;
use super::blocks::Blocks;
use super::pivoting::{self, Found, settle};
use super::sor;
use super::tableau::{Start, Tableau};
use crate::error::{Array, Error, same_length};
use crate::real::Real;

/// What ended a solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// The solution, but for rounding.
    Exact,
    /// Complementarity holds to the tolerance.
    Converged,
    /// The work allowed is used up: x is feasible, and its bound says how good it is.
    OutOfWork,
}

/// What a solve did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progress {
    /// What ended it.
    pub ended: Ended,
    /// Exchanges.
    pub pivots: u32,
    /// Sweeps.
    pub sweeps: u32,
}

/// Solves x ≥ 0, Sx − b ≥ 0, xᵀ(Sx − b) = 0.
pub trait Method<R: Real> {
    /// From `iterate.x`, as far as the method is allowed to go.
    ///
    /// # Errors
    /// Arrays of the wrong length.
    fn solve(
        &mut self,
        matrix: &Blocks<R>,
        load: &[R],
        iterate: Iterate<R>,
    ) -> Result<Progress, Error>;
}

/// No edge is in contact: all outputs are linear in the inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Linear;

impl<R: Real> Method<R> for Linear {
    fn solve(&mut self, matrix: &Blocks<R>, _: &[R], _: Iterate<R>) -> Result<Progress, Error> {
        same_length(Array::Contact, matrix.order(), 0)?;
        Ok(Progress { ended: Ended::Exact, pivots: 0, sweeps: 0 })
    }
}

/// Projected SOR.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sweeps<R> {
    /// ω, inside (0, 2).
    pub omega: R,
    /// The Σ|min(x_i, ω r_i)| that is small enough, relative to ‖x‖ or ‖b‖, the larger.
    pub tolerance: R,
    /// Most sweeps of a solve.
    pub most: u32,
}

impl<R: Real> Method<R> for Sweeps<R> {
    fn solve(
        &mut self,
        matrix: &Blocks<R>,
        load: &[R],
        iterate: Iterate<R>,
    ) -> Result<Progress, Error> {
        if !(self.omega > R::ZERO && self.omega < R::TWO) {
            return Err(Error::Relaxation);
        }
        let mut progress = Progress { ended: Ended::OutOfWork, pivots: 0, sweeps: 0 };
        while progress.sweeps < self.most {
            let defect = sor::sweep(matrix, load, self.omega, iterate.x)?;
            progress.sweeps += 1;
            let size = pivoting::square(iterate.x).or_larger(pivoting::square(load)).rounded_sqrt();
            if defect <= self.tolerance * size {
                progress.ended = Ended::Converged;
                break;
            }
        }
        settle(matrix, load, iterate.x, iterate.residual, iterate.open)?;
        Ok(progress)
    }
}

/// Principal pivoting, and sweeps where it does not get to the end.
#[derive(Debug)]
pub struct Pivots<'a, R> {
    /// The tableau, kept from tick to tick.
    pub tableau: Tableau<'a, R>,
    /// Where it began.
    pub start: Start<'a, R>,
    /// Most exchanges of a solve.
    pub most: u32,
    /// What follows where they do not suffice.
    pub sweeps: Sweeps<R>,
}

impl<R: Real> Method<R> for Pivots<'_, R> {
    fn solve(
        &mut self,
        matrix: &Blocks<R>,
        load: &[R],
        iterate: Iterate<R>,
    ) -> Result<Progress, Error> {
        let mut iterate = iterate;
        let lent = iterate.lend();
        let (found, pivots) =
            pivoting::find(matrix, load, &mut self.tableau, &self.start, self.most, lent)?;
        if found == Found::Exact {
            return Ok(Progress { ended: Ended::Exact, pivots, sweeps: 0 });
        }
        let rest = self.sweeps.solve(matrix, load, iterate)?;
        Ok(Progress { pivots, ..rest })
    }
}
