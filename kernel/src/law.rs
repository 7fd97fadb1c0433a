//! The law of contact, edge by edge: what it allows u, a step and a flux to be.
//!
//! With the means of u and ψ over an edge, and the integrals of its flux τ and of the ends lo ≤ hi of its range,
//! ```text
//!   u > ψ:  τ = lo        u = ψ:  lo ≤ τ ≤ hi        u < ψ:  τ = hi
//! ```
//! Where an end is infinite there is no such side: hi = ∞ is unilateral contact, u ≥ ψ. The load b contains the base of
//! the range ([`crate::flux_range`]), so that where u is on the other side, the span is what b lacks.
//!
//! All that solvers and bounds ask of the law is a method here, so that they know neither ψ nor q: another law of
//! contact is another body of these. Numbers that are not finite never satisfy it.

use crate::error::{Array, Error, all_finite, same_length};
use crate::flux_range::{FluxRange, Span, Spans};
use crate::index::{read, write};
use crate::mesh::edges::EdgeCounts;
use crate::{Real, features};

/// The law on all contact edges, in their order (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Law<'a, R> {
    lower: &'a [R],
    spans: Spans<'a, R>,
}

impl<'a, R: Real> Law<'a, R> {
    /// u ≥ ψ with the means of ψ in `lower`, one a contact edge.
    pub const fn above(lower: &'a [R]) -> Self {
        Self { lower, spans: Spans::UNLIMITED }
    }

    /// The law with these ranges of fluxes.
    #[must_use]
    pub const fn with_spans(self, spans: Spans<'a, R>) -> Self {
        Self { spans, ..self }
    }

    /// The ranges of fluxes, from their bases on.
    pub fn spans(&self) -> Spans<'a, R> {
        self.spans
    }

    /// Whether any edge may have another law than u ≥ ψ.
    #[inline(always)]
    pub fn is_limited(&self) -> bool {
        self.spans.are_limited()
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
        self.spans.check_length(counts.contact)?;
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
        EdgeLaw { lower: read(self.lower, contact), span: self.spans.on(contact) }
    }

    /// The law on each contact edge in turn.
    #[inline(always)]
    pub fn edges(&self) -> impl Iterator<Item = EdgeLaw<R>> + Clone + use<'a, R> {
        let spans = self.spans;
        let edges = self.lower.iter().enumerate();
        edges.map(move |(at, &lower)| EdgeLaw { lower, span: spans.on(at) })
    }

    /// Sets every u + low that the law forbids, or that is NaN, to ψ; returns the largest move. `u`
    /// and `low` hold the means on the contact edges; `low` is empty where nobody asks for it.
    pub fn snap_to_gap(&self, u: &mut [R], low: &mut [R]) -> R {
        let mut most = R::ZERO;
        for (at, (u, law)) in u.iter_mut().zip(self.edges()).enumerate() {
            if !law.admits(*u) {
                most = most.or_larger(law.depth(*u));
                *u = law.gap();
                write(low, at, R::ZERO);
            }
        }
        most
    }

    /// Puts u onto the gap of `whole` where a correction `low` by this law touches: u + (ψ − u) may round to either side. Both hold
    /// the means on the contact edges.
    pub(crate) fn close(&self, u: &mut [R], low: &mut [R], whole: Law<R>) {
        let pairs = u.iter_mut().zip(low).zip(self.edges()).zip(whole.edges());
        for (((u, low), correction), law) in pairs {
            if correction.touches(*low) {
                (*u, *low) = (law.gap(), R::ZERO);
            }
        }
    }

    /// The law on corrections of `u`, the means on the contact edges: u + v is at least ψ where v is at least ψ − u.
    /// `lower` becomes that.
    pub fn of_correction<'b>(self, u: &[R], lower: &'b mut [R]) -> Law<'b, R>
    where
        'a: 'b,
    {
        for ((lower, law), &u) in lower.iter_mut().zip(self.edges()).zip(u) {
            *lower = law.gap() - u;
        }
        Law { lower, spans: self.spans }
    }
}

/// How far a relaxation takes u, and what stops it.
#[derive(Debug, Clone, Copy)]
pub enum Move<R> {
    /// So far that the row is satisfied, with the flux at an end of its range.
    Row(R),
    /// Onto the gap, from this opening.
    Gap(R),
}

/// The law on one contact edge.
#[derive(Debug, Clone, Copy)]
pub struct EdgeLaw<R> {
    lower: R,
    span: Span<R>,
}

impl<R: Real> EdgeLaw<R> {
    /// u ≥ ψ with the mean `lower` of ψ.
    pub const fn above(lower: R) -> Self {
        Self { lower, span: Span::UNLIMITED }
    }

    /// The law with this range of fluxes.
    #[must_use]
    pub const fn with_span(self, span: Span<R>) -> Self {
        Self { span, ..self }
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

    /// Whether u may be so: a number, on a side that there is.
    #[inline(always)]
    pub fn admits(self, u: R) -> bool {
        if self.span.is_above() {
            return u >= self.lower;
        }
        u <= self.lower || u > self.lower && !self.span.is_below()
    }

    /// The value nearest to that of s at an end of the edge, where ψ is `psi`, with which s is on a side that there is.
    #[inline(always)]
    pub fn nearest_at(self, value: R, psi: R) -> R {
        if self.span.is_above() {
            return value.or_larger(psi);
        }
        if self.span.is_below() { value.or_smaller(psi) } else { value }
    }

    /// By how much a value of s at an end of the edge is on a side that there is not; 0 or less where there is.
    #[inline(always)]
    pub fn depth_at(self, value: R, psi: R) -> R {
        if self.span.is_above() {
            return psi - value;
        }
        if self.span.is_below() { value - psi } else { R::ZERO }
    }

    /// Both ends of the range of fluxes are finite.
    #[inline(always)]
    pub fn has_both_sides(self) -> bool {
        !(self.span.is_above() || self.span.is_below())
    }

    /// How far a unit of u moves with the flux from one end of its range to the other; `stiffness` is K_ii.
    #[inline(always)]
    pub fn reach(self, stiffness: R) -> R {
        self.span.length().magnitude() / stiffness
    }

    /// How far a u that may not be so is beyond the gap.
    #[inline(always)]
    fn depth(self, u: R) -> R {
        if self.span.is_below() { u - self.lower } else { -self.opening(u) }
    }

    /// Whether the edge is active: u = ψ.
    #[inline(always)]
    pub fn touches(self, u: R) -> bool {
        u == self.lower
    }

    /// Whether the flux is at its limit: u < ψ, and hi is finite.
    #[inline(always)]
    pub fn is_saturated(self, u: R) -> bool {
        features::LIMITED && u < self.lower && !self.span.is_above()
    }

    /// What to add to the load at this u: the span where the flux is at the end that the load does not contain, else 0.
    #[inline(always)]
    pub fn missing(self, u: R) -> R {
        let length = self.span.length();
        if !features::LIMITED || !length.finite() {
            return R::ZERO;
        }
        let is_other = if length < R::ZERO { u > self.lower } else { u < self.lower };
        if is_other { length } else { R::ZERO }
    }

    /// The new u of a contact edge. `wanted` solves its row with the load as stored; adding the least or the most flux moves it
    /// by `softness` times that. The result is whichever stays on its side of ψ, else ψ; NaN becomes ψ.
    #[inline(always)]
    pub fn project(self, wanted: R, softness: R) -> R {
        if self.span.is_above() {
            return if wanted > self.lower { wanted } else { self.lower };
        }
        let [least, most] = self.span.ends().map(|end| wanted + softness * end);
        match (least > self.lower, most < self.lower) {
            (true, _) => least,
            (_, true) => most,
            _ => self.lower,
        }
    }

    /// How far a relaxation moves a u of this `opening`, where the row with its load alone asks for `step`: min(u − ψ, −step) in
    /// size where u ≥ ψ is the law. All three in one unit of length, `softness` being that of a unit of load.
    #[inline(always)]
    pub fn movement(self, opening: R, step: R, softness: R) -> Move<R> {
        if self.span.is_above() {
            return if opening < -step { Move::Gap(opening) } else { Move::Row(step) };
        }
        let [least, most] = self.span.ends().map(|end| step + softness * end);
        match (opening < -least, opening > -most) {
            (false, _) => Move::Row(least),
            (_, false) => Move::Row(most),
            _ => Move::Gap(opening),
        }
    }

    /// How many times `direction` may be added to an admissible u until it touches; `None` where it never does.
    #[inline(always)]
    pub fn room(self, u: R, direction: R) -> Option<R> {
        let is_below = features::LIMITED && u < self.lower;
        let comes_near = if is_below { direction > R::ZERO } else { direction < R::ZERO };
        if comes_near { Some(self.opening(u) / -direction) } else { None }
    }

    /// Whether a step along `direction` has brought u to the gap but for `rounding`.
    #[inline(always)]
    pub fn lands(self, u: R, direction: R, rounding: R) -> bool {
        if self.span.is_above() {
            return direction < R::ZERO && self.opening(u) <= rounding;
        }
        direction != R::ZERO && self.opening(u).magnitude() <= rounding
    }

    /// ∫_E τ·n within the law, nearest to a `flux` that need not be: `range` is what contact allows the flux to be.
    #[inline(always)]
    pub fn flux(self, u: R, flux: R, range: FluxRange<R>) -> R {
        if self.span.is_above() {
            return if u > self.lower { range.base() } else { range.nearest(flux) };
        }
        let [least, most] = range.ends();
        match (u < self.lower, u > self.lower && !self.span.is_below()) {
            (true, _) => most,
            (_, true) => least,
            _ => range.nearest(flux),
        }
    }
}
