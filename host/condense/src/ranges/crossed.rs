//! Largest charge of the bound for s on another side of the gap than u, for all inputs of a box, where fluxes have limits.
//!
//! Of a solution an edge is in one of three states, and pays for one side of one of them:
//! ```text
//!   x > 0:  span · mean⁻        x = 0:  what corners are off ψ        x < 0:  span · mean⁺
//! ```

use super::affine::AffineOutput;
use super::interval::{Interval, dot};
use crate::{CondensedModel, Form, Vertex};

/// d of a vertex where fluxes have limits: from nothing to all that brings e to 0.
pub(super) fn eased(vertex: &Vertex, x: &[Interval]) -> Interval {
    let e = dot(vertex.weights.map(Interval::point), vertex.edges.map(|edge| x[edge]));
    Interval { lo: (-e.hi).min(0.0), hi: (-e.lo).max(0.0) }
}

/// Largest charge for s where it is on another side of the gap than u.
pub(super) fn crossed(model: &CondensedModel, form: &Form, p: &[Interval], x: &[Interval]) -> f64 {
    let of_edge = |(at, ends): (usize, &[usize; 2])| {
        let scale = Interval::point(model.energy_unit) * inverse(model.opening[at]);
        let excess = ends.map(|place| match form.vertices.get(place) {
            // d brings e towards 0.
            Some(vertex) => {
                let e = dot(vertex.weights.map(Interval::point), vertex.edges.map(|at| x[at]));
                scale * Interval { lo: e.lo.min(0.0), hi: e.hi.max(0.0) }
            }
            None => corner_of(form, place, p),
        });
        let sum = |of: fn(&Interval) -> f64| of(&excess[0]).max(0.0) + of(&excess[1]).max(0.0);
        let [above, below] = [sum(|e| e.hi), sum(|e| -e.lo)];
        let [least, greatest] = model.end_columns(at).map(|end| match end[0].is_finite() {
            true => dot(end.into_iter().map(Interval::point), p.iter().copied()),
            false => Interval::point(end[0]),
        });
        let price = |excess: f64, room: f64| match excess > 0.0 && room.is_finite() {
            true => excess * (room.max(0.0) + form.span_excess),
            false => 0.0,
        };
        let span = greatest.hi - least.lo;
        let open = if x[at].hi > 0.0 { price(below, span) } else { 0.0 };
        let saturated = if x[at].lo < 0.0 { price(above, span) } else { 0.0 };
        // An edge that touches has s = ψ at its ends but for corners.
        let mut reaction = AffineOutput::none(model);
        reaction.add(model, at, 1.0);
        let r = reaction.within(p, x);
        let corners = ends.map(|place| match form.vertices.get(place) {
            Some(_) => Interval::ZERO,
            None => corner_of(form, place, p),
        });
        let touching = match x[at].lo <= 0.0 && x[at].hi >= 0.0 {
            true => corners.into_iter().fold(0.0, |sum, e| {
                let [down, up] = [(r.hi - least.lo).min(span), (greatest.hi - r.lo).min(span)];
                sum + price(e.hi.max(0.0), down).max(price((-e.lo).max(0.0), up))
            }),
            false => 0.0,
        };
        open.max(saturated).max(touching)
    };
    // A few roundings of sums of positive numbers.
    form.ends.iter().enumerate().map(of_edge).sum::<f64>() * (1.0 + 1e-12)
}

/// (u_D − ψ)/d of a corner, or 0.
fn corner_of(form: &Form, place: usize, p: &[Interval]) -> Interval {
    let corner = form.corners.get(place.wrapping_sub(form.vertices.len()));
    corner.map_or(Interval::ZERO, |corner| {
        dot(corner.excess.iter().copied().map(Interval::point), p.iter().copied())
    })
}

/// 1/x of a positive number.
fn inverse(x: f64) -> Interval {
    Interval { lo: (1.0 / x).next_down(), hi: (1.0 / x).next_up() }
}
