//! The sums over the mesh that a certificate is drawn from.

use super::{Certificate, Stability, Verdict};
use signorini_kernel::{Real, features};

/// One cell's share of everything.
#[derive(Debug, Clone, Copy)]
pub(super) struct CellTerms<R> {
    /// ‖A^½∇s − A^{−½}τ‖²
    pub gap: R,
    /// ‖A^{−½}(τ − σ_h)‖²
    pub algebraic: R,
    /// ‖A^½∇(s − u_h)‖²
    pub nonconforming: R,
    /// The quadratic form of `gap` with all terms of A∇s − τ added up instead of cancelling.
    pub uncertainty: R,
    /// The uncertainty of `nonconforming`.
    pub uncertainty_of_u: R,
    /// (∫f)² + Στ², the terms of the balance.
    pub terms: R,
    /// ‖A^{−½}(A − p)∇s‖² at most, where A is taken for p.
    pub open: R,
}

/// A sum whose rounding error does not grow with its length (Kahan): the sum so far, and what its last digit could not hold.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Sum<R> {
    sum: R,
    lost: R,
}

impl<R: Real> Sum<R> {
    #[inline(always)]
    pub fn add(&mut self, term: R) {
        let next = term - self.lost;
        let sum = self.sum + next;
        self.lost = (sum - self.sum) - next;
        self.sum = sum;
    }

    pub fn value(&self) -> R {
        self.sum
    }
}

/// ‖A^½∇s − A^{−½}τ‖² + ∫_R (τ·n + h(s − u_ext))²/h as it adds up. Extensions of curved data are left out.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Distance<R> {
    pub gap: Sum<R>,
    /// The same of what A has above what it is taken for.
    pub open: R,
}

impl<R: Real> Distance<R> {
    #[inline(always)]
    pub fn add(&mut self, [gap, open]: [R; 2]) {
        self.gap.add(gap);
        if features::VARYING || features::PIECES {
            self.open += open;
        }
    }

    /// The square, with what A has above what it is taken for.
    pub fn square(&self, missed: R) -> R {
        let root = |square: R| square.or_larger(R::ZERO).rounded_sqrt();
        let square = self.gap.value();
        if !(features::VARYING || features::PIECES) {
            return square;
        }
        let seen = (R::ONE + missed) * (root(square) + root(self.open));
        seen * seen
    }
}

/// Sums over the mesh.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Parts<R> {
    pub gap: Sum<R>,
    pub algebraic: R,
    pub nonconforming: R,
    /// ‖A^½∇v‖² of what s has above the chords of its boundary data, on distorted quads.
    pub lifted: R,
    pub uncertainty: R,
    pub uncertainty_of_u: R,
    /// The square of what storing the data has done.
    pub perturbation: R,
    /// Rounding in `gap` itself.
    pub direct: R,
    /// Rounding in `nonconforming`.
    pub direct_of_u: R,
    pub terms: R,
    /// The square of what A has above what it is taken for.
    pub open: R,
}

impl<R: Real> CellTerms<R> {
    /// The share of a [`Distance`].
    pub fn distance(&self) -> [R; 2] {
        [self.gap, self.open]
    }
}

impl<R: Real> Parts<R> {
    /// What the cells have added to it so far.
    pub fn distance(&self) -> Distance<R> {
        Distance { gap: self.gap, open: self.open }
    }

    #[inline(always)]
    pub fn add(&mut self, share: CellTerms<R>) {
        self.add_of_flux(&share);
        self.algebraic += share.algebraic;
        self.nonconforming += share.nonconforming;
        self.uncertainty_of_u += share.uncertainty_of_u;
    }

    /// Adds what depends on τ; the rest is that of another τ for the same u and s ([`Parts::take_rest`]).
    #[inline(always)]
    pub fn add_of_flux(&mut self, share: &CellTerms<R>) {
        self.gap.add(share.gap);
        self.uncertainty += share.uncertainty;
        self.terms += share.terms;
        if features::VARYING {
            self.open += share.open;
        }
    }

    /// Takes the algebraic part, and what bounds numbers that do not depend on τ: it holds for either.
    pub fn take_rest(&mut self, of: &Self) {
        self.algebraic = of.algebraic;
        self.nonconforming = of.nonconforming;
        self.uncertainty_of_u = of.uncertainty_of_u;
    }

    /// `cells`: how many there are.
    #[inline(always)]
    pub fn conclude(&self, cells: usize, of_mesh: (Stability<R>, R), oscillation: R) -> Verdict<R> {
        let unbalanced = self.unbalanced(cells, of_mesh.0);
        self.conclude_with(cells, of_mesh, oscillation, unbalanced)
    }

    /// What rounding leaves of the balance of `cells` cells, brought to the roots of the forest.
    #[inline(always)]
    pub fn unbalanced(&self, cells: usize, stability: Stability<R>) -> R {
        let root = |square: R| square.or_larger(R::ZERO).rounded_sqrt();
        // A sum of 4 terms at most, and of all cells (Σ|ρ|)² ≤ cells · Σρ².
        let all = |squares: R| {
            R::from_count(2) * R::EPSILON * root(R::from_count(cells as u32) * squares)
        };
        let plainly = stability.largest * all(self.terms);
        plainly.or_smaller(stability.weighed * all(self.uncertainty))
    }

    /// The verdict where rounding of the cells' balance costs `unbalanced`.
    #[inline(always)]
    pub fn conclude_with(
        &self,
        cells: usize,
        (stability, missed): (Stability<R>, R),
        oscillation: R,
        unbalanced: R,
    ) -> Verdict<R> {
        let root = |square: R| square.or_larger(R::ZERO).rounded_sqrt();
        let gap = root(self.gap.value());
        let times = |count: u32| R::from_count(count) * R::EPSILON;
        // A difference of 4 terms, each rounded 4 times: half an ε of each, and (Σ|x|)² ≤ 4 Σx².
        let uncertainty = times(4) * root(self.uncertainty);
        let lifted = root(gap * gap + self.direct).or_larger(gap) - gap;
        // Squares below the smallest normal number are lost, some in every cell.
        let lost = (R::ONE + stability.largest) * root(R::from_count(16 * cells as u32) * R::TINY);
        let rounding =
            uncertainty + unbalanced + root(self.perturbation) + lifted + lost + times(16) * gap;
        let rounding = rounding + times(4) * oscillation;
        // What rules and points do not see of A.
        let seen = gap;
        let open = if features::VARYING || features::PIECES { gap + root(self.open) } else { gap };
        let gap = if features::VARYING { open + missed * open } else { open };
        let both = root(gap * gap + oscillation * oscillation);
        // √(gap²) underflows before gap does.
        let exact = oscillation + both.or_larger(gap);
        // What rounded element matrices hide, of all that is drawn from them.
        let rounding = rounding + stability.oblique * (exact + rounding);
        let total = exact + rounding;
        let algebraic = root(self.algebraic);
        let jump = root(self.nonconforming.or_larger(R::ZERO) + self.direct_of_u);
        // A plain sum over the cells loses half an ε of itself in each, its root half of that.
        let summed = times(16) + R::QUARTER * times(cells as u32);
        let uncertainty_of_u = times(4) * root(self.uncertainty_of_u) + summed * jump + lost;
        let apart = jump + root(self.lifted) + uncertainty_of_u;
        let apart = if features::VARYING { apart + missed * apart } else { apart };
        let of_u = total + (apart + stability.oblique * apart);
        let certificate = Certificate {
            duality_gap: seen,
            algebraic,
            oscillation,
            rounding,
            total,
            of_u,
            distance: R::ZERO,
        };
        let known = certificate.of_u.finite() && algebraic.finite();
        if known { Verdict::Certified(certificate) } else { Verdict::NotFinite }
    }
}
