//! Charge of the bound of a condensed answer where s is on a side of ψ that the flux does not belong to.
//!
//! ```text
//!   2∫_C (s − ψ)⁺ (τ·n − lo) + (ψ − s)⁺ (hi − τ·n)
//! ```
//! Where hi is infinite s may not lie below ψ, and where lo is, not above it: d takes care of both, as it does of vertices beside
//! edges that touch. Where both are finite, a vertex on another side than u is moved towards ψ as far as that pays: it is
//! charged hi − lo for its distance, and half of a form for the square of d. τ is mended into the range of its edge.

use super::{Form, Mended, Vertex};
use crate::candidate::Candidate;
use crate::dense::ranges::Ranges;
use crate::sides::{Baked, ON_GAP};
use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error};
use signorini_kernel::excess::Excess;
use signorini_kernel::flux_range::{FluxRange, Span};
use signorini_kernel::index::read;

/// d at a vertex whose openings say s − ψ = `opening`; `square` is the squared norm of the column of d.
pub(super) fn correction<R: Real>(
    sides: Option<&Baked<R>>,
    ranges: Ranges<R>,
    (vertex, x): (&Vertex<R>, &[R]),
    opening: R,
    square: impl Fn() -> R,
) -> R {
    let beside = || vertex.beside.iter().map(|&edge| usize::from(edge));
    let touches = beside().any(|edge| read(x, edge) == R::ZERO);
    let Some(sides) = sides.filter(|_| !touches) else { return -opening };
    // Infinite towards a side that there is not: e goes back to 0.
    let reach = |edge: usize| {
        let [least, most] = ranges.ends(edge);
        let price = (most - least) * read(sides.scale, edge);
        if sides.excess > R::ZERO { R::INFINITY } else { price / (R::TWO * square()) }
    };
    let moved = beside().fold(opening, |e, edge| {
        let x = read(x, edge);
        if x > R::ZERO && e < R::ZERO {
            (e + reach(edge)).or_smaller(R::ZERO)
        } else if x < R::ZERO && e > R::ZERO {
            (e - reach(edge)).or_larger(R::ZERO)
        } else {
            e
        }
    });
    moved - opening
}

impl<R: Real> Form<'_, R> {
    /// How large spans are that r is compared with, or that loads of sides have.
    pub(super) fn spans(&self, answer: &Candidate<R>) -> R {
        let Candidate { inputs, x, residual, ranges } = *answer;
        if !ranges.are_limited() {
            return R::ZERO;
        }
        let of_edge = |(at, (&x, &r)): (usize, (&R, &R))| match x == R::ZERO {
            true => r.magnitude(),
            false => ranges.excess(at, x).magnitude(),
        };
        let used = x.iter().zip(residual).enumerate().map(of_edge);
        let used = used.fold(R::ZERO, R::or_larger);
        // Where inputs make a span, its terms may cancel.
        let largest = self.sides.baked().map_or(&[][..], |sides| sides.largest);
        let terms = largest.iter().zip(inputs).skip(1);
        terms.fold(R::TWO * used, |sum, (&span, p)| sum + span * p.magnitude())
    }

    /// Mends like [`Form::mend`], into the ranges of r: a surplus leaves through the touching edge with most room.
    pub(super) fn mend_within(&self, answer: &Candidate<R>, uncertainty: R) -> Option<Mended<R>> {
        let Candidate { x, residual, ranges, .. } = *answer;
        let amount = |at: usize| {
            let r = read(residual, at);
            if read(x, at) == R::ZERO { ranges.outside(at, r) } else { r }
        };
        let square = (0..x.len()).fold(R::ZERO, |sum, at| sum + amount(at) * amount(at));
        if self.floating.is_empty() {
            return Some(Mended { known: square.rounded_sqrt(), hidden: R::ZERO });
        }
        let mut widest = (R::ZERO, R::ONE);
        for (at, (&x, &flux)) in x.iter().zip(self.floating).enumerate() {
            let ([least, most], r) = (ranges.ends(at), read(residual, at));
            let room = (r - least).or_smaller(most - r) * flux;
            if x == R::ZERO && room > widest.0 {
                widest = (room, flux);
            }
        }
        let fluxes = self.floating.iter().enumerate();
        let total = fluxes.fold(R::ZERO, |sum, (at, &flux)| sum + amount(at) * flux);
        let hidden = self.floating.iter().fold(R::ZERO, |sum, &flux| sum + flux * uncertainty);
        let (total, hidden) = (total.magnitude() / widest.1, R::TWO * hidden / widest.1);
        let bears = widest.0 / widest.1 > total + hidden;
        bears.then(|| Mended { known: (square + total * total).rounded_sqrt(), hidden })
    }

    /// 2∫_C (s − ψ)⁺(τ·n − lo) + (ψ − s)⁺(hi − τ·n), and what rounding of u_D − ψ costs; nothing where a Dirichlet value is on a
    /// side that there is not.
    pub(super) fn price(
        &self,
        answer: &Candidate<R>,
        z: &[R],
        uncertainty: R,
    ) -> Result<Option<[R; 2]>, Error> {
        let Some(sides) = self.sides.baked() else { return Ok(None) };
        let (mut sum, mut misplaced) = (R::ZERO, R::ZERO);
        for corner in self.corners {
            misplaced += corner.at(answer.inputs)?[1] * corner.energy;
        }
        for (edge, ends) in sides.ends.iter().enumerate() {
            let [a, b] = ends.map(|end| self.end(sides, (edge, end), answer, z));
            let Some(charge) = self.charge(edge, answer, [a?, b?], uncertainty) else {
                return Ok(None);
            };
            sum += charge;
        }
        Ok(Some([sum, misplaced]))
    }

    /// s − ψ at an end of an edge in the unit of 1/r, and what rounding may hide of it.
    fn end(
        &self,
        sides: &Baked<R>,
        (edge, end): (usize, u16),
        answer: &Candidate<R>,
        z: &[R],
    ) -> Result<[R; 2], Error> {
        if end == ON_GAP {
            return Ok([R::ZERO; 2]);
        }
        let Candidate { inputs, x, .. } = *answer;
        let end = usize::from(end);
        if let Some(vertex) = self.vertices.get(end) {
            let ([left, right], scale) = (vertex.terms(x), read(sides.scale, edge));
            let d = read(z, inputs.len() + x.len() + end);
            // s is what these numbers are: rounding of d is weighed elsewhere.
            return Ok([((left + right) + d) * scale, R::ZERO]);
        }
        let at = end - self.vertices.len();
        let stray = Error::OutOfRange { of: Array::Vertices, at };
        self.corners.get(at).ok_or(stray)?.at(inputs)
    }

    /// Charge of a contact edge for s − ψ at its ends, each with what rounding may hide; `None` where s is on a side that does not exist by more than rounding.
    pub(crate) fn charge(
        &self,
        edge: usize,
        answer: &Candidate<R>,
        [a, b]: [[R; 2]; 2],
        uncertainty: R,
    ) -> Option<R> {
        let most_excess = self.sides.baked().map_or(R::ZERO, |sides| sides.excess);
        let (x, r) = (read(answer.x, edge), read(answer.residual, edge));
        let [least, most] = answer.ranges.ends(edge);
        let tau = answer.ranges.admissible(edge, x, r);
        let unsure = if x == R::ZERO { R::TWO * uncertainty } else { R::ZERO };
        let slack = a[1].or_larger(b[1]);
        let (low, high) = (a[0].or_smaller(b[0]), a[0].or_larger(b[0]));
        if low < -slack && !most.finite() || high > slack && !least.finite() {
            return None;
        }
        let [above, below] = Excess { ends: [a[0], b[0]], bubble: R::ZERO }.sides();
        let range = FluxRange::new(R::ZERO, Span::new(most - least));
        let one = |mean: R, may_be: bool, distance: R| {
            let mean = if may_be { mean + slack } else { mean };
            if mean > R::ZERO && distance.finite() {
                let unseen = range.unseen(distance + unsure, most_excess).or_smaller(most_excess);
                R::TWO * mean * (distance + unseen + unsure)
            } else {
                R::ZERO
            }
        };
        Some(one(above, high > -slack, tau - least) + one(below, low < slack, most - tau))
    }
}
