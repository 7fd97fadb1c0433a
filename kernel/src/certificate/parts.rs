//! The sums over the mesh that a certificate is drawn from.

use super::sum::Sum;
use super::{Certificate, Verdict};
use crate::real::Real;

/// One cell's share of everything.
#[derive(Debug, Clone, Copy)]
pub(super) struct Share<R> {
    /// ‖A^½∇s − A^{−½}τ‖²
    pub gap: R,
    /// ‖A^{−½}(τ − σ_h)‖²
    pub algebraic: R,
    /// The quadratic form of `gap` with all terms of A∇s − τ added up instead of cancelling.
    pub doubt: R,
    /// (∫f)² + Στ², the terms of the balance.
    pub terms: R,
}

/// Sums over the mesh.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Parts<R> {
    pub gap: Sum<R>,
    pub algebraic: R,
    pub doubt: R,
    /// The square of what storing the data has done.
    pub ripple: R,
    /// What rounding can have done to `gap` itself.
    pub direct: R,
    pub terms: R,
}

impl<R: Real> Parts<R> {
    #[inline(always)]
    pub fn add(&mut self, share: Share<R>) {
        self.gap.add(share.gap);
        self.algebraic += share.algebraic;
        self.doubt += share.doubt;
        self.terms += share.terms;
    }

    /// `cells`: how many there are.
    pub fn conclude(&self, cells: usize, reach: R, oscillation: R) -> Verdict<R> {
        let root = |square: R| square.or_larger(R::ZERO).rounded_sqrt();
        let gap = root(self.gap.value());
        let times = |count: u32| R::from_count(count) * R::EPSILON;
        // A difference of 4 terms, each rounded 4 times: half an ε of each, and (Σ|x|)² ≤ 4 Σx².
        let doubt = times(4) * root(self.doubt);
        // A sum of 4 terms at most, and of all cells (Σ|ρ|)² ≤ cells · Σρ².
        let unbalanced = times(2) * root(R::from_count(cells as u32) * self.terms);
        let lifted = root(gap * gap + self.direct).or_larger(gap) - gap;
        // Squares below the smallest normal number are lost, some in every cell.
        let lost = (R::ONE + reach) * root(R::from_count(16 * cells as u32) * R::TINY);
        let rounding =
            doubt + reach * unbalanced + root(self.ripple) + lifted + lost + times(16) * gap;
        let both = root(gap * gap + oscillation * oscillation);
        let certificate = Certificate {
            gap,
            algebraic: root(self.algebraic),
            oscillation,
            rounding,
            // √(gap²) underflows before gap does.
            total: oscillation + both.or_larger(gap) + rounding,
        };
        let known = certificate.total.finite() && certificate.algebraic.finite();
        if known { Verdict::Certified(certificate) } else { Verdict::NotFinite }
    }
}
