//! What cells store in a step of time, and what it leaves of its equation, summed over the cells.

use super::change::Change;
use super::parts::CellTerms;
use signorini_kernel::Real;

/// What one cell stores.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StoredCell<R> {
    /// k|T|
    pub content: R,
    /// The largest area element of the reference coordinates over their mean: 1 on triangles and parallelograms.
    pub spread: R,
    /// By how much the area element rises along x̂ and ŷ over the cell, over its mean: 0 on triangles and parallelograms.
    pub tilt: [R; 2],
    /// Mean of the area element times mean of its inverse, less 1: 0 on triangles and parallelograms.
    pub skew: R,
    /// k/(k + π²α/h²): the part of ‖R′‖²/k that remains of it in the oscillation.
    pub shed: R,
    /// kh²/(π²α)
    pub loose: R,
    /// The part of what it lacks of balance that it keeps where cells hand on the rest.
    pub keep: R,
}

/// What is left of R = f − k(s − s_old) + ∇·τ over the cells.
#[derive(Debug, Clone, Copy)]
pub struct Residual<R> {
    /// Σ‖R̄‖²/k
    pub mean: R,
    /// Σ‖R′‖²/k, without what f varies by.
    pub rest: R,
    /// Σ‖R′‖²/(k + π²α/h²), without what f varies by.
    pub shed: R,
    /// Σ‖R′‖²/(π²α/h²), without what f varies by.
    pub loose: R,
    /// Σ(terms of R̄|T|)²/(k|T|), infinite where a cell stores nothing.
    pub(super) terms: R,
    /// Σ k|T| s²
    pub(super) size: R,
}

/// What a cell is to give up by its sides, and what it does.
pub(super) struct Balance<R> {
    /// ∫f
    pub source: R,
    /// ∫f − k∫(s − s_old): with this for its load R̄ is 0.
    pub wanted: R,
    /// The load that τ balances.
    pub load: R,
}

impl<R: Real> Residual<R> {
    /// Of no cells.
    pub(super) fn nothing() -> Self {
        let zero = R::ZERO;
        Self { mean: zero, rest: zero, shed: zero, loose: zero, terms: zero, size: zero }
    }

    /// Adds a cell with these fluxes out of it, and gives its ‖R̄‖²/k.
    pub(super) fn add(
        &mut self,
        of: StoredCell<R>,
        (balance, change): (&Balance<R>, &Change<R>),
        out: &[R],
        share: &mut CellTerms<R>,
    ) -> R {
        let StoredCell { content, spread, skew, shed, loose, .. } = of;
        let of_change = content * change.size;
        share.terms += balance.source * balance.source + of_change * of_change;
        if content == R::ZERO {
            self.terms = R::INFINITY;
            return R::ZERO;
        }
        let lacking = balance.wanted - balance.load;
        // ∇·τ goes with the inverse of the area element, and what s changes does not.
        let of_mean = lacking * lacking / content * (R::ONE + skew);
        let apart = (spread * change.variance).rounded_sqrt();
        let apart = apart + change.mean.magnitude() * skew.rounded_sqrt();
        let rest = content * apart * apart;
        // Both are orthogonal but for what the area element makes of R̄.
        let of_mean = of_mean + R::TWO * (lacking * lacking / content * skew * rest).rounded_sqrt();
        let terms = balance.source.magnitude() + of_change;
        let terms = out.iter().fold(terms, |sum, flux| sum + flux.magnitude());
        self.mean += of_mean;
        self.rest += rest;
        self.shed += shed * rest;
        self.loose += loose * rest;
        self.terms += terms * terms / content;
        self.size += of_change * change.size;
        of_mean
    }
}
