//! How far an output may be from its value for the exact solution, in its own unit.
//!
//! An output is linear in u or σ, and what the error bound leaves of it is
//! ```text
//!   |J(exact) − J(answer)| ≤ w_total · total + w_algebraic · algebraic + w_of_u · of_u,
//! ```
//! whose weights the host finds once: norms of functions that tell this output from all others. They hold for all inputs and on
//! whatever sides the contact edges are. Where a bound is as large as its algebraic part nothing is said of σ_h. What the sum of an
//! output rounds is not in it.

use signorini_kernel::Real;
use signorini_kernel::report::Report;
use signorini_kernel::verdict::Certificate;

/// The weights of one output: units of it over those of the bound; infinite where there is no interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutputWeights<R> {
    /// Of the total: how far s and τ are from the solution.
    pub total: R,
    /// Of the square of the total.
    pub square: R,
    /// Of the algebraic part: how far σ_h is from τ.
    pub algebraic: R,
    /// Of the bound for u_h.
    pub of_u: R,
}

impl<R: Real> OutputWeights<R> {
    /// Of an output without an interval.
    pub const NONE: Self =
        Self { total: R::INFINITY, square: R::ZERO, algebraic: R::INFINITY, of_u: R::INFINITY };

    /// How far the output may be off; ∞ without a bound.
    ///
    /// ```
    /// use signorini_kernel::verdict::{Certificate, Verdict};
    /// use signorini_device::intervals::OutputWeights;
    /// use signorini_kernel::report::{Ended, Report};
    ///
    /// let weights = OutputWeights { total: 2.0, square: 0.0, algebraic: 1.0, of_u: 0.0 };
    /// let certificate = Certificate { total: 0.1, algebraic: 0.02, ..Certificate::default() };
    /// let verdict = Verdict::Certified(certificate);
    /// let (ended, figures) = (Ended::Exact, ());
    /// let report = Report { ended, exchanges: 0, sweeps: 0, active: 3, verdict, figures };
    /// assert_eq!(weights.plus_minus(&report), 0.22);
    /// assert_eq!(OutputWeights::NONE.plus_minus(&report), f64::INFINITY);
    /// ```
    #[inline(always)]
    pub fn plus_minus(&self, report: &Report<R>) -> R {
        report.certificate().map_or(R::INFINITY, |bound| self.within(bound))
    }

    /// How far the output may be off within this bound.
    #[inline(always)]
    pub fn within(&self, bound: &Certificate<R>) -> R {
        let is_told = self.algebraic == R::ZERO || bound.algebraic < bound.total;
        if !is_told || self.total == R::INFINITY {
            return R::INFINITY;
        }
        let total = (self.total + self.square * bound.total) * bound.total;
        total + self.algebraic * bound.algebraic + self.of_u * bound.of_u
    }
}

/// How far each output may be off.
#[inline(always)]
pub fn plus_minus<R: Real, const N: usize>(
    weights: &[OutputWeights<R>; N],
    report: &Report<R>,
) -> [R; N] {
    core::array::from_fn(|at| weights.get(at).map_or(R::INFINITY, |of| of.plus_minus(report)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_kernel::report::Ended;
    use signorini_kernel::verdict::Verdict;

    fn report(verdict: Verdict<f32>) -> Report<f32> {
        Report { ended: Ended::Settled, exchanges: 0, sweeps: 7, active: 0, verdict, figures: () }
    }

    #[test]
    fn nothing_is_guaranteed_without_a_bound() {
        let weights = OutputWeights { total: 1.0, square: 0.0, algebraic: 0.0, of_u: 0.0 };
        let all = plus_minus(&[weights, OutputWeights::NONE], &report(Verdict::Unavailable));
        assert_eq!(all, [f32::INFINITY; 2]);
    }

    #[test]
    fn an_algebraic_part_that_is_cut_off_tells_nothing() {
        let certificate =
            Certificate { total: 2.0, algebraic: 2.0, of_u: 3.0, ..Certificate::default() };
        let report = report(Verdict::Certified(certificate));
        let weights = OutputWeights { total: 1.0, square: 0.0, algebraic: 0.5, of_u: 0.0 };
        assert_eq!(weights.plus_minus(&report), f32::INFINITY);
        let of_fluxes_on_contact = OutputWeights { algebraic: 0.0, ..weights };
        assert_eq!(of_fluxes_on_contact.plus_minus(&report), 2.0);
        let of_u = OutputWeights { total: 0.0, square: 0.25, algebraic: 0.0, of_u: 2.0 };
        assert_eq!(of_u.plus_minus(&report), 7.0);
    }
}
