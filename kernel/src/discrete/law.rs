//! The law of contact, edge by edge: what it allows u, a step and a flux to be.
//!
//! With the means of u and ψ over an edge, and the integrals of its flux and of q,
//! ```text
//!   u ≥ ψ,    τ ≥ q,    τ = q where u > ψ.
//! ```
//! All that solvers and bounds ask of the law is a method here, so that they know neither ψ nor q: another law of
//! contact is another body of these. Numbers that are not finite never satisfy it.

use crate::error::{Array, Error, all_finite, same_length};
use crate::index::{read, write};
use crate::mesh::boundary::FluxRange;
use crate::mesh::edges::EdgeCounts;
use crate::real::Real;

/// The law on all contact edges, in their order (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Law<'a, R> {
    lower: &'a [R],
}

impl<'a, R: Real> Law<'a, R> {
    /// u ≥ ψ with the means of ψ in `lower`, one a contact edge.
    pub const fn above(lower: &'a [R]) -> Self {
        Self { lower }
    }

    /// The means of ψ.
    pub fn lower(&self) -> &'a [R] {
        self.lower
    }

    /// `Ok` where there is a law for each contact edge.
    ///
    /// # Errors
    /// Another number of edges than `counts` has contact edges.
    pub fn check_length(&self, counts: EdgeCounts) -> Result<(), Error> {
        same_length(Array::LowerBounds, self.lower.len(), counts.contact)
    }

    /// `Ok` where all numbers of the law are finite.
    ///
    /// # Errors
    /// A ψ that is not finite.
    pub fn check_finite(&self) -> Result<(), Error> {
        all_finite(Array::LowerBounds, self.lower)
    }

    /// The law on contact edge `contact`, counted from the first one.
    #[inline(always)]
    pub fn on(&self, contact: usize) -> EdgeLaw<R> {
        EdgeLaw { lower: read(self.lower, contact) }
    }

    /// The law on each contact edge in turn.
    #[inline(always)]
    pub fn edges(&self) -> impl Iterator<Item = EdgeLaw<R>> + Clone + use<'a, R> {
        self.lower.iter().map(|&lower| EdgeLaw { lower })
    }

    /// Lifts u onto the gap wherever it is below (or not a number); `u` holds the means on the contact edges.
    pub fn lift<'u>(&self, u: impl Iterator<Item = &'u mut R>)
    where
        R: 'u,
    {
        for (u, law) in u.zip(self.edges()) {
            if !law.admits(*u) {
                *u = law.gap();
            }
        }
    }

    /// Lifts u + low onto the gap wherever u is below (or not a number), and returns by how much at most. `u` and `low`
    /// hold the means on the contact edges; `low` is empty where nobody asks for it.
    pub(crate) fn land(&self, u: &mut [R], low: &mut [R]) -> R {
        let mut most = R::ZERO;
        for (at, (u, law)) in u.iter_mut().zip(self.edges()).enumerate() {
            if !law.admits(*u) {
                most = most.or_larger(-law.opening(*u));
                *u = law.gap();
                write(low, at, R::ZERO);
            }
        }
        most
    }

    /// The law on corrections of `u`, the means on the contact edges: u + v is at least ψ where v is at least ψ − u.
    /// `lower` becomes that.
    pub fn of_correction<'b>(self, u: &[R], lower: &'b mut [R]) -> Law<'b, R> {
        for ((lower, law), &u) in lower.iter_mut().zip(self.edges()).zip(u) {
            *lower = law.gap() - u;
        }
        Law { lower }
    }
}

/// The law on one contact edge.
#[derive(Debug, Clone, Copy)]
pub struct EdgeLaw<R> {
    lower: R,
}

impl<R: Real> EdgeLaw<R> {
    /// u ≥ ψ with the mean `lower` of ψ.
    pub const fn above(lower: R) -> Self {
        Self { lower }
    }

    /// The mean of ψ, where u touches.
    #[inline(always)]
    pub fn gap(self) -> R {
        self.lower
    }

    /// u − ψ
    #[inline(always)]
    pub fn opening(self, u: R) -> R {
        u - self.lower
    }

    /// The u that has the opening `v`.
    #[inline(always)]
    pub fn opened(self, v: R) -> R {
        self.lower + v
    }

    /// Whether u may be so: u ≥ ψ, and a number.
    #[inline(always)]
    pub fn admits(self, u: R) -> bool {
        u >= self.lower
    }

    /// Whether the edge is active: u = ψ.
    #[inline(always)]
    pub fn touches(self, u: R) -> bool {
        u == self.lower
    }

    /// The u that a relaxation ends at, from the one at which the row of K alone would be satisfied. NaN becomes ψ.
    #[inline(always)]
    pub fn project(self, wanted: R) -> R {
        if wanted > self.lower { wanted } else { self.lower }
    }

    /// The opening where it is what keeps u from being changed by `step`: min(u − ψ, −r_i/K_ii) is the first then.
    #[inline(always)]
    pub fn blocks(self, u: R, step: R) -> Option<R> {
        let opening = self.opening(u);
        if opening < -step { Some(opening) } else { None }
    }

    /// How many times `direction` may be added to an admissible u until it touches; `None` where it never does.
    #[inline(always)]
    pub fn room(self, u: R, direction: R) -> Option<R> {
        if direction < R::ZERO { Some(self.opening(u) / -direction) } else { None }
    }

    /// ∫_E τ·n within the law, nearest to a `flux` that need not be: `range` is what contact allows the flux to be.
    #[inline(always)]
    pub fn flux(self, u: R, flux: R, range: FluxRange<R>) -> R {
        if u > self.lower { range.least() } else { range.nearest(flux) }
    }
}
