//! What the flux through a contact edge may be: from one end to another, either of which may be infinite.
//!
//! ```text
//!   ∫lo ≤ ∫_E A∇u·n ≤ ∫hi        base = ∫lo,  span = ∫(hi − lo), 0 at least or ∞      [base, base + span]
//!                                 base = ∫hi,  span = ∫(lo − hi), negative or −∞       [base + span, base]
//! ```
//! The base is the end that the load b contains: the smaller one, so that no digit of it is lost beside a huge one. A span of ∞
//! is unilateral contact, u ≥ ψ; −∞ is u ≤ ψ; 0 is a given flux. In a build without the feature `limited` all spans are ∞,
//! and nothing is stored or asked.

use core::marker::PhantomData;

use crate::error::{Array, Error, same_length};
use crate::features;
use crate::real::Real;

/// From the base of a range to its other end.
#[derive(Debug, Clone, Copy)]
pub struct Span<R> {
    #[cfg(feature = "limited")]
    length: R,
    scalar: PhantomData<R>,
}

impl<R: Real> Span<R> {
    /// ∞
    pub const UNLIMITED: Self = Self {
        #[cfg(feature = "limited")]
        length: R::INFINITY,
        scalar: PhantomData,
    };

    /// A span of this length, of either sign or infinite.
    #[cfg(feature = "limited")]
    pub const fn new(length: R) -> Self {
        Self { length, scalar: PhantomData }
    }

    /// From the base to the other end, ∞ and −∞ among them.
    #[inline(always)]
    pub fn length(self) -> R {
        #[cfg(feature = "limited")]
        return self.length;
        #[cfg(not(feature = "limited"))]
        R::INFINITY
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

/// The spans of all contact edges in their order (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Spans<'a, R> {
    #[cfg(feature = "limited")]
    lengths: &'a [R],
    #[cfg(feature = "limited")]
    excess: R,
    lent: PhantomData<&'a R>,
}

impl<'a, R: Real> Spans<'a, R> {
    /// ∞ on every edge.
    pub const UNLIMITED: Self = Self {
        #[cfg(feature = "limited")]
        lengths: &[],
        #[cfg(feature = "limited")]
        excess: R::ZERO,
        lent: PhantomData,
    };

    /// Those of each contact edge, ∞ and −∞ among them; none at all where every one is ∞.
    ///
    /// # Errors
    /// NaN.
    #[cfg(feature = "limited")]
    pub fn new(lengths: &'a [R]) -> Result<Self, Error> {
        match lengths.iter().position(|length| !(*length >= R::ZERO || *length < R::ZERO)) {
            Some(at) => Err(Error::OutOfRange { of: Array::ContactSpans, at }),
            None => Ok(Self { lengths, excess: R::ZERO, lent: PhantomData }),
        }
    }

    /// The same of numbers that the host has checked, with the excess of [`Spans::varying`].
    #[cfg(feature = "limited")]
    pub const fn baked(lengths: &'a [R], excess: R) -> Self {
        Self { lengths, excess, lent: PhantomData }
    }

    /// The same where hi − lo varies along edges: |E| (hi − lo) is at most `excess` more than its integral anywhere.
    #[cfg(feature = "limited")]
    #[must_use]
    pub fn varying(self, excess: R) -> Self {
        Self { excess, ..self }
    }

    /// By how much |E| (hi − lo) may exceed its integral; 0 where it is constant along every edge.
    pub fn excess(&self) -> R {
        #[cfg(feature = "limited")]
        return self.excess;
        #[cfg(not(feature = "limited"))]
        R::ZERO
    }

    /// ∫(hi − lo) of each contact edge, or nothing.
    pub fn lengths(&self) -> &'a [R] {
        #[cfg(feature = "limited")]
        return self.lengths;
        #[cfg(not(feature = "limited"))]
        &[]
    }

    /// How many there are: none where all are ∞.
    #[cfg(feature = "limited")]
    pub const fn count(&self) -> usize {
        self.lengths.len()
    }

    /// Whether any may be other than ∞.
    #[inline(always)]
    pub fn are_limited(&self) -> bool {
        features::LIMITED && !self.lengths().is_empty()
    }

    /// The span of contact edge `contact`.
    #[inline(always)]
    pub fn on(&self, contact: usize) -> Span<R> {
        #[cfg(feature = "limited")]
        return self.lengths.get(contact).map_or(Span::UNLIMITED, |&length| Span::new(length));
        #[cfg(not(feature = "limited"))]
        {
            let _ = contact;
            Span::UNLIMITED
        }
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

    /// The end that is nearest to a flux.
    pub fn nearest_end(self, flux: R) -> R {
        let [least, most] = self.ends();
        if (flux - least).magnitude() <= (most - flux).magnitude() { least } else { most }
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
