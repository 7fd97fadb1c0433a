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
    moved: R,
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
        Self { lengths, excess, moved: R::ZERO }
    }

    /// Spans whose hi − lo varies along edges: |E| (hi − lo) is at most `excess` more than its integral anywhere.
    #[must_use]
    pub fn varying(self, excess: R) -> Self {
        Self { excess, ..self }
    }

    /// Spans some of which have [`settled`] to 0: by at most so much each of their ends was moved.
    #[must_use]
    pub fn moved_by(self, moved: R) -> Self {
        Self { moved, ..self }
    }

    /// By how much each of their ends was moved at most.
    #[inline(always)]
    pub fn moved(&self) -> R {
        if features::LIMITED { self.moved } else { R::ZERO }
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

/// Part of the terms of hi − lo that rounding may be, for every scalar: 16 ε of f32. So a controller in f32, one in f64 and a solve
/// take the same inputs.
const SLACK: u32 = 1 << 19;

/// The span that hi − lo stands for, `size` being the sum of the magnitudes of its terms: itself, 0 where it is below 0 by
/// rounding alone, `None` where the range is empty. Both ends are their mean then: each goes by half of it.
#[inline(always)]
pub fn settled<R: Real>(span: R, size: R) -> Option<R> {
    (span * R::from_count(SLACK) >= -size).then(|| span.or_larger(R::ZERO))
}

/// hi − lo as a form of the inputs, for all contact edges on which it is the same (borrowed).
///
/// ```text
///   hi − lo = terms₀ + Σ_j p_j terms_j       the size of its terms is |lo₀| + |hi₀| + Σ_j |p_j terms_j|
/// ```
/// An input acts on one end. Every model of a scene has the same forms, in units that all edges share: so all refuse the same inputs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Room<'a, R> {
    /// The constant first.
    pub terms: &'a [R],
    /// |lo₀| + |hi₀|
    pub size: R,
}

impl<R: Real> Room<'_, R> {
    /// `Ok` where these inputs, without the constant, leave a range of fluxes.
    ///
    /// # Errors
    /// [`Error::EmptyRange`] with the input that leaves least room, [`Error::NotFinite`] where a term overflows.
    pub fn check(&self, inputs: &[R]) -> Result<(), Error> {
        let Some((&constant, terms)) = self.terms.split_first() else { return Ok(()) };
        let (mut sum, mut size) = (constant, self.size);
        let mut least = (0, R::INFINITY);
        for (input, (&term, &p)) in terms.iter().zip(inputs).enumerate() {
            let product = term * p;
            (sum, size) = (sum + product, size + product.magnitude());
            if term != R::ZERO && product < least.1 {
                least = (input, product);
            }
        }
        if !size.finite() {
            return Err(Error::NotFinite { of: Array::ContactSpans, at: 0 });
        }
        settled(sum, size).map(drop).ok_or(Error::EmptyRange { input: least.0 })
    }
}

/// The values that ∫_E A∇u·n may have on a contact edge.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// hi − lo = −1 + p of terms of 1 + 1 where p = 1, and q as a second input that may cancel.
    fn tried<R: Real>(slacks: f64) -> Result<(), Error> {
        let number = |x: f64| R::from_f64(x).unwrap_or(R::ZERO);
        let terms = [number(-1.0), number(1.0), number(0.5)];
        let room = Room { terms: &terms, size: number(1.0) };
        room.check(&[number(1.0 - slacks / f64::from(1 << 18)), number(0.0)])
    }

    #[test]
    fn one_slack_holds_for_every_scalar() {
        let refused = Err(Error::EmptyRange { input: 1 });
        for (slacks, expected) in [(0.5, Ok(())), (0.99, Ok(())), (1.01, refused), (2.0, refused)] {
            assert_eq!(
                (tried::<f32>(slacks), tried::<f64>(slacks)),
                (expected, expected),
                "{slacks}"
            );
        }
    }

    #[test]
    fn the_input_that_leaves_least_room_is_named() {
        let room = Room { terms: &[0.5, 2.0, -1.0, 0.0], size: 1.0 };
        assert_eq!(room.check(&[1.0, 2.5, 9.0]), Ok(()));
        assert_eq!(room.check(&[1.0, 2.6, 9.0]), Err(Error::EmptyRange { input: 1 }));
        assert_eq!(room.check(&[-1.0, 0.6, 9.0]), Err(Error::EmptyRange { input: 0 }));
        assert_eq!(
            room.check(&[f64::NAN, 0.0, 0.0]),
            Err(Error::NotFinite { of: Array::ContactSpans, at: 0 })
        );
        assert_eq!((settled(-1e-6, 1.0), settled(-2e-6, 1.0)), (Some(0.0), None));
        assert_eq!(settled(f64::NAN, 1.0), None);
    }
}
