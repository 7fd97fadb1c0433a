//! Ranges of w = Sx − b on each contact edge, where that is not just w ≥ 0: three sides instead of two.
//!
//! ```text
//!   x > 0:  w = 0        x = 0:  0 ≤ w ≤ m        x < 0:  w = m          m ≥ 0, or ∞: no third side
//!   x > 0:  w = m        x = 0:  m ≤ w ≤ 0        x < 0:  w = 0          m < 0, or −∞: no first side
//! ```
//! An exchanged unknown has the load of its side, b or b + m. Which side that is stands in the sign of x while a search goes
//! on, and from one search to the next.

use super::sizes;
use super::tableau::Tableau;
use signorini_kernel::Real;
use signorini_kernel::features;
use signorini_kernel::flux_range::Spans;
use signorini_kernel::index::{read, write};

/// A load with the ranges that belong to it (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Given<'a, R> {
    /// b
    pub load: &'a [R],
    /// The values that w may have.
    pub ranges: Ranges<'a, R>,
}

impl<'a, R: Real> Given<'a, R> {
    /// w ≥ 0.
    pub const fn above(load: &'a [R]) -> Self {
        Self::between(load, Spans::UNLIMITED, &[])
    }

    /// m in `spans`, each times its entry in `scale` where that is not empty.
    pub const fn between(load: &'a [R], spans: Spans<'a, R>, scale: &'a [R]) -> Self {
        Self { load, ranges: Ranges { spans, scale } }
    }

    /// b of edge `at` and what its side has beyond.
    #[inline(always)]
    pub(super) fn on(&self, at: usize, load: R, x: R) -> R {
        if self.ranges.are_limited() { load + self.ranges.excess(at, x) } else { load }
    }

    /// The answer of a tableau to this load, each exchanged unknown being on its side; `scratch` is as long as the load.
    pub(super) fn answer(
        &self,
        tableau: &mut Tableau<R>,
        x: &[R],
        scratch: &mut [R],
        answer: &mut [R],
    ) -> Result<(), signorini_kernel::Error> {
        if !self.ranges.are_limited() {
            return tableau.answer(self.load, answer);
        }
        let sides = x.iter().zip(tableau.exchanged()).zip(self.load).enumerate();
        for (scratch, (at, ((&x, &within), &load))) in scratch.iter_mut().zip(sides) {
            *scratch = self.on(at, load, if within { x } else { R::ZERO });
        }
        tableau.answer(scratch, answer)
    }
}

/// The values that w may have on each contact edge (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Ranges<'a, R> {
    spans: Spans<'a, R>,
    scale: &'a [R],
}

impl<R: Real> Ranges<'_, R> {
    /// Whether any edge may have a third side, or another second one.
    #[inline(always)]
    pub(crate) fn are_limited(&self) -> bool {
        features::LIMITED && self.spans.are_limited()
    }

    /// The least and the largest w of an edge.
    #[inline(always)]
    pub(crate) fn ends(&self, at: usize) -> [R; 2] {
        self.spans.on(at).ends().map(|end| match end.finite() {
            true if features::LIMITED && !self.scale.is_empty() => end * read(self.scale, at),
            _ => end,
        })
    }

    /// By how much ends of ranges have moved at most.
    #[inline(always)]
    pub(crate) fn moved(&self) -> R {
        self.spans.moved()
    }

    /// The flux added to b for an edge off the gap: the end that belongs to the sign of x; 0 at x = 0 or for an infinite end.
    #[inline(always)]
    pub fn excess(&self, at: usize, x: R) -> R {
        let [least, most] = self.ends(at);
        let end = if x < R::ZERO { most } else { least };
        if x != R::ZERO && end.finite() { end } else { R::ZERO }
    }

    /// By how much a w is outside of its range, with its sign.
    pub fn outside(&self, at: usize, w: R) -> R {
        let [least, most] = self.ends(at);
        if w < least {
            w - least
        } else if w > most {
            w - most
        } else {
            R::ZERO
        }
    }

    /// z mapped to the case w ≥ 0, so that one rule serves all ranges: where nothing is wrong it is ≥ 0 for an edge that touches, ≤ 0
    /// for an exchanged one.
    pub(super) fn violation(&self, at: usize, z: R, x: R, within: bool) -> R {
        if within {
            return if x < R::ZERO { -z } else { z };
        }
        let [least, most] = self.ends(at);
        (z - least).or_smaller(most - z)
    }

    /// The violation in phases in which whoever is above its range, or at its upper end, waits.
    pub(super) fn violation_from_below(&self, at: usize, z: R, x: R, within: bool) -> R {
        match within {
            true if x < R::ZERO => R::ZERO,
            true => z,
            false => z - self.ends(at)[0],
        }
    }

    /// By how much an edge is above its range, or x > 0 at its upper end; below 0 elsewhere.
    pub(super) fn above(&self, at: usize, z: R, x: R, within: bool) -> R {
        match within {
            true if x < R::ZERO => -z,
            true => -R::ONE,
            false => z - self.ends(at)[1],
        }
    }

    /// Exchanged unknowns whose x is 0 are on the side whose end the load contains, and none on a side that there is not.
    pub(super) fn begin(&self, exchanged: &[bool], x: &mut [R]) {
        if !self.are_limited() {
            return;
        }
        for (at, (x, &within)) in x.iter_mut().zip(exchanged).enumerate() {
            let [least, most] = self.ends(at);
            let is_lost =
                *x == R::ZERO || *x < R::ZERO && !most.finite() || *x > R::ZERO && !least.finite();
            if within && is_lost {
                *x = if least < R::ZERO { -R::ONE } else { R::ONE };
            }
        }
    }

    /// The flux that an answer stands for: w within its range where x = 0, and the end of its side elsewhere.
    #[inline(always)]
    pub(crate) fn admissible(&self, at: usize, x: R, w: R) -> R {
        let [least, most] = self.ends(at);
        if x > R::ZERO {
            least
        } else if x < R::ZERO {
            most
        } else {
            w.or_larger(least).or_smaller(most)
        }
    }

    /// To be called before unknown `at` is exchanged: if it comes in, the sign of x says to which side, and the answer is
    /// that to the load of this side.
    pub(super) fn before_exchange(&self, at: usize, within: bool, z: &mut [R], x: &mut [R]) {
        if !self.are_limited() || within {
            return;
        }
        let (w, [_, most]) = (read(z, at), self.ends(at));
        let side = if w > most { -R::ONE } else { R::ONE };
        write(x, at, side);
        write(z, at, w - self.excess(at, side));
    }

    /// The same after it was: if it has left, what its side had beyond b is gone.
    pub(super) fn after_exchange(&self, at: usize, was_within: bool, z: &mut [R], x: &mut [R]) {
        if !self.are_limited() || !was_within {
            return;
        }
        write(z, at, read(z, at) + self.excess(at, read(x, at)));
        write(x, at, R::ZERO);
    }

    /// The root of the sum of r_i² over the edges that are open, or should be; `residual` as `settle` leaves it.
    pub(super) fn unbalanced(&self, residual: &[R], x: &[R]) -> R {
        if !self.are_limited() {
            return sizes::unbalanced(residual, x);
        }
        let wrong = |at: usize| {
            let r = read(residual, at);
            if read(x, at) == R::ZERO { self.outside(at, r) } else { r }
        };
        sizes::norm_of(residual.len().min(x.len()), &wrong)
    }
}
