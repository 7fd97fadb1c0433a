//! Range of the flux through a contact edge: from one end to another, either of which may be infinite.
//!
//! ```text
//!   ∫lo ≤ ∫_E A∇u·n ≤ ∫hi        base = ∫lo,  span = ∫(hi − lo), 0 at least or ∞      [base, base + span]
//!                                 base = ∫hi,  span = ∫(lo − hi), negative or −∞       [base + span, base]
//! ```
//! The base is the end that the load b contains: the smaller one, so that no digit of it is lost beside a huge one. A span of ∞
//! is unilateral contact, u ≥ ψ; −∞ is u ≤ ψ; 0 is a given flux. In a build without the feature `limited` all spans are ∞,
//! whatever is stored.

use crate::error::{Array, Error, known, same_length};
use crate::{Real, features};

/// From the base of a range to its other end.
#[derive(Debug, Clone, Copy)]
pub struct Span<R> {
    length: R,
}

impl<R: Real> Span<R> {
    /// ∞
    pub const UNLIMITED: Self = Self { length: R::INFINITY };

    /// A span of this length, of either sign or infinite.
    pub const fn new(length: R) -> Self {
        Self { length }
    }

    /// From the base to the other end, ∞ and −∞ among them.
    #[inline(always)]
    pub fn length(self) -> R {
        if features::LIMITED { self.length } else { R::INFINITY }
    }

    /// Both ends from the base on.
    #[inline(always)]
    pub fn ends(self) -> [R; 2] {
        let length = self.length();
        if length < R::ZERO { [length, R::ZERO] } else { [R::ZERO, length] }
    }

    /// Whether the flux goes up without an end: u ≥ ψ then.
    #[inline(always)]
    pub(crate) fn is_above(self) -> bool {
        !features::LIMITED || self.length() == R::INFINITY
    }

    /// Whether it goes down without an end: u ≤ ψ then.
    #[inline(always)]
    pub(crate) fn is_below(self) -> bool {
        features::LIMITED && self.length() == -R::INFINITY
    }
}

/// The spans of all contact edges in their order (borrowed); by default every one is ∞.
#[derive(Debug, Clone, Copy, Default)]
pub struct Spans<'a, R> {
    lengths: &'a [R],
    excess: R,
}

impl<'a, R: Real> Spans<'a, R> {
    /// ∞ on every edge.
    pub const UNLIMITED: Self = Self::baked(&[], R::ZERO);

    /// One span per contact edge, ∞ and −∞ among them; none at all where every one is ∞.
    ///
    /// # Errors
    /// NaN; any span where this build of the kernel has no code for limits ([`features`]).
    pub fn new(lengths: &'a [R]) -> Result<Self, Error> {
        known(Array::ContactSpans, features::LIMITED, lengths.len())?;
        match lengths.iter().position(|length| !(*length >= R::ZERO || *length < R::ZERO)) {
            Some(at) => Err(Error::OutOfRange { of: Array::ContactSpans, at }),
            None => Ok(Self::baked(lengths, R::ZERO)),
        }
    }

    /// Takes spans that the host has checked, with the excess of [`Spans::varying`].
    pub const fn baked(lengths: &'a [R], excess: R) -> Self {
        Self { lengths, excess }
    }

    /// Spans whose hi − lo varies along edges: |E| (hi − lo) is at most `excess` more than its integral anywhere.
    #[must_use]
    pub fn varying(self, excess: R) -> Self {
        Self { excess, ..self }
    }

    /// By how much |E| (hi − lo) may exceed its integral; 0 where it is constant along every edge.
    pub fn excess(&self) -> R {
        if features::LIMITED { self.excess } else { R::ZERO }
    }

    /// ∫(hi − lo) of each contact edge, or nothing.
    pub fn lengths(&self) -> &'a [R] {
        if features::LIMITED { self.lengths } else { &[] }
    }

    /// Number of spans: 0 where all are ∞.
    pub const fn count(&self) -> usize {
        if features::LIMITED { self.lengths.len() } else { 0 }
    }

    /// Whether any may be other than ∞.
    #[inline(always)]
    pub fn are_limited(&self) -> bool {
        features::LIMITED && !self.lengths().is_empty()
    }

    /// The span of contact edge `contact`.
    #[inline(always)]
    pub fn on(&self, contact: usize) -> Span<R> {
        self.lengths().get(contact).map_or(Span::UNLIMITED, |&length| Span::new(length))
    }

    /// `Ok` where there is one for each of so many contact edges, or none at all.
    ///
    /// # Errors
    /// Another number.
    pub fn check_length(&self, contact: usize) -> Result<(), Error> {
        if !self.are_limited() {
            return Ok(());
        }
        same_length(Array::ContactSpans, self.lengths().len(), contact)
    }
}

/// The span that a sum of so many `terms` stands for, `size` being the sum of their magnitudes: itself, 0 where it is below
/// 0 by rounding alone, `None` where the range is empty. Two ends that are equal for some inputs are so to rounding.
#[inline(always)]
pub fn settled<R: Real>(span: R, size: R, terms: usize) -> Option<R> {
    let rounding = R::from_count(terms as u32 + 4) * R::EPSILON;
    (span >= -(rounding * size)).then(|| span.or_larger(R::ZERO))
}

/// What ∫_E A∇u·n may be on a contact edge.
#[derive(Debug, Clone, Copy)]
pub struct FluxRange<R> {
    base: R,
    span: Span<R>,
}

impl<R: Real> FluxRange<R> {
    /// All fluxes from ∫_E q on.
    pub const fn from(least: R) -> Self {
        Self { base: least, span: Span::UNLIMITED }
    }

    /// The range from this base on.
    #[inline(always)]
    pub const fn new(base: R, span: Span<R>) -> Self {
        Self { base, span }
    }

    /// The end that the load contains.
    #[inline(always)]
    pub fn base(self) -> R {
        self.base
    }

    /// From the base to the other end.
    pub fn span(self) -> Span<R> {
        self.span
    }

    /// ∫lo and ∫hi.
    #[inline(always)]
    pub fn ends(self) -> [R; 2] {
        let [least, most] = self.span.ends();
        [self.base + least, self.base + most]
    }

    /// Whether ∫_E τ·n may be so. NaN may not.
    #[inline(always)]
    pub fn admits(self, flux: R) -> bool {
        if self.span.is_above() {
            return flux >= self.base;
        }
        let [least, most] = self.ends();
        flux >= least && flux <= most
    }

    /// The admissible flux that is nearest.
    #[inline(always)]
    pub fn nearest(self, flux: R) -> R {
        if self.span.is_above() {
            return flux.or_larger(self.base);
        }
        let [least, most] = self.ends();
        flux.or_larger(least).or_smaller(most)
    }

    /// What a mean `distance` of a flux from an end may lack somewhere along the edge, where |E| (hi − lo) is at most `excess`
    /// above its integral: the flux is lo + θ (hi − lo) there, and from either end by its share of the range.
    #[inline(always)]
    pub fn unseen(self, distance: R, excess: R) -> R {
        let width = self.span.length().magnitude();
        if excess > R::ZERO && width > R::ZERO { excess * (distance / width) } else { R::ZERO }
    }

    /// λ ≥ 0 of an admissible flux: ∫_E (τ·n − lo), or ∫_E (hi − τ·n) where lo = −∞.
    #[inline(always)]
    pub fn multiplier(self, flux: R) -> R {
        if self.span.is_above() {
            return flux - self.base;
        }
        if self.span.is_below() { self.base - flux } else { flux - self.ends()[0] }
    }
}
