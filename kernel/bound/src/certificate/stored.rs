//! What cells store in a step of time, and what it leaves of its equation, summed over the cells.

use super::change::Change;
use super::parts::CellTerms;
use signorini_kernel::Real;
use signorini_kernel::storage::Storage;

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

/// A step in time (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Step<'a, R> {
    /// dt
    pub length: R,
    /// What cells store by their sides, and the means that the step begins from.
    pub storage: Storage<'a, R>,
    /// One per cell, triangles first.
    pub cells: &'a [StoredCell<R>],
    /// s_old at the vertices.
    pub vertices: &'a [R],
    /// The bubbles of s_old, one per edge; may be empty where there are no quads.
    pub bubbles: &'a [R],
    /// The means of (s_old − ψ)⁺ and (ψ − s_old)⁺ along each contact edge, with ψ as it was then.
    pub openings: &'a [[R; 2]],
}

/// What s changes by leaves of R = f − k(s − s_old) + ∇·τ inside the cells, whatever τ, without what f varies by.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Inside<R> {
    /// Σ‖R′‖²/k
    pub rest: R,
    /// Σ‖R′‖²/(k + π²α/h²)
    pub shed: R,
    /// Σ‖R′‖²/(π²α/h²)
    pub loose: R,
    /// Σ k|T| s²
    pub size: R,
}

/// The means of R that τ leaves.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Means<R> {
    /// Σ‖R̄‖²/k
    pub mean: R,
    /// Σ(terms of R̄|T|)²/(k|T|), infinite where a cell stores nothing.
    pub terms: R,
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

impl<R: Real> Inside<R> {
    /// Adds a cell, and gives its ‖R′‖²/k.
    #[inline(always)]
    pub(super) fn add(&mut self, of: &StoredCell<R>, change: &Change<R>) -> R {
        let mut variance = of.spread * change.variance;
        if of.skew > R::ZERO {
            // ∇·τ goes with the inverse of the area element, and what s changes does not.
            let apart = variance.rounded_sqrt() + change.mean.magnitude() * of.skew.rounded_sqrt();
            variance = apart * apart;
        }
        let rest = of.content * variance;
        self.rest += rest;
        self.shed += of.shed * rest;
        self.loose += of.loose * rest;
        self.size += of.content * change.size * change.size;
        rest
    }
}

impl<R: Real> Means<R> {
    /// Adds a cell with these fluxes out of it, and gives its ‖R̄‖²/k.
    #[inline(always)]
    pub(super) fn add(
        &mut self,
        (of, change, rest): (&StoredCell<R>, &Change<R>, R),
        balance: &Balance<R>,
        out: &[R],
        share: &mut CellTerms<R>,
    ) -> R {
        let of_change = of.content * change.size;
        share.terms += balance.source * balance.source + of_change * of_change;
        if of.content == R::ZERO {
            self.terms = R::INFINITY;
            return R::ZERO;
        }
        let lacking = balance.wanted - balance.load;
        let mut of_mean = lacking * lacking / of.content;
        if of.skew > R::ZERO {
            // Both are orthogonal but for what the area element makes of R̄.
            let product = (of_mean * of.skew * rest).rounded_sqrt();
            of_mean = of_mean * (R::ONE + of.skew) + R::TWO * product;
        }
        let terms = balance.source.magnitude() + of_change;
        let terms = out.iter().fold(terms, |sum, flux| sum + flux.magnitude());
        self.mean += of_mean;
        self.terms += terms * terms / of.content;
        of_mean
    }
}
