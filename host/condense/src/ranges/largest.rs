//! The largest error bound that solutions of a condensed model have for all inputs of a box.
//!
//! For solutions nothing is mended, δ = 0, and with z = (p, x, d) every z_j has an interval of middle z̄_j and half width w_j:
//! ```text
//!   |F z| ≤ |F z̄| + Σ_j w_j |F e_j|.
//! ```
//! In a piece of the box fewer edges may change sides. Those that cannot are taken out as they are of the whole box, which
//! makes all that depends on them part of the columns of p: what is left of the sum shrinks with the piece. So the piece
//! with the largest bound is halved until it is hardly larger than one that some inputs reach, or there are too many.
//!
//! Where fluxes have limits an edge of a solution is in one of three states, and is charged for s on the other side of the gap
//! by one of them:
//! ```text
//!   x > 0:  span · mean⁻        x = 0:  what corners are off ψ        x < 0:  span · mean⁺
//! ```

use super::affine::AffineOutput;
use super::interval::{Interval, between, dot};
use super::reduced::Reduced;
use super::sides::Sides;
use crate::factor::column;
use crate::{CondensedModel, Corner, Form, Vertex};
use signorini_problem::triangular::norm;
use signorini_reference::ReferenceError;

/// Pieces at most.
const PIECES: usize = 256;
/// No piece is halved once the largest bound is this many times one that is reached.
const ENOUGH: f64 = 1.1;
/// Largest ratio of what is proved to what is reached at which the proof says something.
const SHARP: f64 = 2.0;
/// u_D this far below ψ, against the size of its terms, is rounding of inputs in the target's scalar.
const ROUNDING: f64 = 4.0 * f32::EPSILON as f64;
/// Inputs of which all corners of the box are tried.
const CORNERS: usize = 6;

/// The largest bound of ‖A^½∇(u − s)‖ and ‖A^−½(σ − τ)‖ over a box, in the unit of ‖A^½∇u‖.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LargestBound {
    /// No solution has a larger one.
    pub proved: f64,
    /// Some inputs have this one.
    pub reached: f64,
    /// Pieces of the box that the proof took.
    pub pieces: usize,
}

impl LargestBound {
    /// Nothing where the model has no bound or nothing is proved of its solutions, as where an input has no range.
    ///
    /// # Errors
    /// Loads that are not finite.
    pub fn new(model: &CondensedModel) -> Result<Option<Self>, ReferenceError> {
        let Some(whole) = Piece::new(model, model.ranges.clone())? else { return Ok(None) };
        let corners = corners(&model.ranges);
        let mut reached = corners.iter().filter_map(|p| solved(model, p)).fold(0.0, f64::max);
        let mut pieces = vec![whole];
        loop {
            let Some(worst) =
                (0..pieces.len()).max_by(|&i, &j| pieces[i].bound.total_cmp(&pieces[j].bound))
            else {
                return Ok(None);
            };
            let proved = pieces[worst].bound;
            let halves = match proved > ENOUGH * reached && pieces.len() < PIECES {
                true => pieces[worst].halves(&model.ranges),
                false => None,
            };
            let Some(halves) = halves else {
                return Ok(Some(Self { proved, reached, pieces: pieces.len() }));
            };
            pieces.swap_remove(worst);
            for half in halves {
                let middle: Vec<f64> = half.iter().map(|[lo, hi]| 0.5 * lo + 0.5 * hi).collect();
                reached = reached.max(solved(model, &middle).unwrap_or(0.0));
                let Some(piece) = Piece::new(model, half)? else { return Ok(None) };
                pieces.push(piece);
            }
        }
    }

    /// Tells whether the proved bound is near the one that is reached.
    pub fn is_sharp(&self) -> bool {
        self.proved <= SHARP * self.reached
    }
}

/// A piece of the box of inputs.
#[derive(Debug)]
struct Piece {
    inputs: Vec<[f64; 2]>,
    /// No solution has a larger one.
    bound: f64,
}

impl Piece {
    /// Nothing where nothing is proved of it.
    fn new(model: &CondensedModel, inputs: Vec<[f64; 2]>) -> Result<Option<Self>, ReferenceError> {
        let own = CondensedModel { ranges: inputs.clone(), ..model.clone() };
        let sides = Sides::new(&own)?;
        let p = between(&sides.inputs);
        let x = match &sides.enclosure {
            Some(enclosure) => enclosure.intervals(),
            None if own.contact == 0 => Vec::new(),
            None => return Ok(None),
        };
        let bound = match Reduced::new(&own, sides) {
            Some(reduced) => most(&reduced.model, &p, &reduced.within(&x)),
            None => most(&own, &p, &x),
        };
        Ok(bound.filter(|bound| bound.is_finite()).map(|bound| Self { inputs, bound }))
    }

    /// Halved along the input of which it has the largest part; nothing where it is a point.
    fn halves(&self, all: &[[f64; 2]]) -> Option<[Vec<[f64; 2]>; 2]> {
        let part = |at: usize| {
            let [[lo, hi], [least, most]] = [self.inputs[at], all[at]];
            if most > least { (hi - lo) / (most - least) } else { 0.0 }
        };
        let longest = (0..all.len()).max_by(|&i, &j| part(i).total_cmp(&part(j)))?;
        let [lo, hi] = self.inputs[longest];
        let middle = 0.5 * lo + 0.5 * hi;
        let half = |own: [f64; 2]| {
            let mut inputs = self.inputs.clone();
            inputs[longest] = own;
            inputs
        };
        (lo < middle && middle < hi).then(|| [half([lo, middle]), half([middle, hi])])
    }
}

/// The bound of the solution for p.
fn solved(model: &CondensedModel, p: &[f64]) -> Option<f64> {
    model.bound(p, &model.solve(p).ok()?)
}

/// Corners of the box, of its first inputs.
fn corners(ranges: &[[f64; 2]]) -> Vec<Vec<f64>> {
    let bits = CORNERS.min(ranges.len() - 1);
    let end = |bits: usize, at: usize| match at.checked_sub(1) {
        Some(input) => ranges[at][(bits >> input) & 1],
        None => 1.0,
    };
    (0..1_usize << bits).map(|bits| (0..ranges.len()).map(|at| end(bits, at)).collect()).collect()
}

/// The largest bound of solutions with p and x within these; nothing where there may be none.
fn most(model: &CondensedModel, p: &[Interval], x: &[Interval]) -> Option<f64> {
    let form = model.certificate.as_ref().ok()?;
    let limits = model.is_limited();
    let moved = form.vertices.iter().map(|vertex| match limits {
        true => eased(vertex, x),
        false => correction(vertex, x),
    });
    let z: Vec<_> = p.iter().chain(x).copied().chain(moved).collect();
    let (mut square, mut moved) = (form.largest(&z).powi(2), 0.0);
    for corner in &form.corners {
        let excess = excess(corner, p);
        let size: f64 = corner.excess.iter().zip(p).map(|(a, p)| a.abs() * p.size()).sum();
        let ends = model.end_columns(corner.edge).map(|end| end[0]);
        let [is_below, is_above] = [ends[1] == f64::INFINITY, ends[0] == f64::NEG_INFINITY];
        if is_below && excess.lo < -ROUNDING * size || is_above && excess.hi > ROUNDING * size {
            return None;
        }
        if !limits && x[corner.edge].lo <= 0.0 {
            let reaction = AffineOutput::row(model, corner.edge).within(p, x);
            square += excess.hi.max(0.0) * reaction.hi.max(0.0);
        }
        moved += if is_below { (-excess.lo).max(0.0) * corner.energy } else { 0.0 };
        moved += if is_above { excess.hi.max(0.0) * corner.energy } else { 0.0 };
    }
    square += crossed(model, form, p, x);
    let oscillation: f64 = form.oscillation.iter().zip(p).map(|(osc, p)| osc * p.size()).sum();
    let oscillation = oscillation + moved;
    // A few roundings of sums of positive numbers.
    let total = (oscillation + (square + oscillation * oscillation).sqrt()) * (1.0 + 1e-14);
    Some(model.energy_unit * total)
}

/// d of a vertex: −e beside an edge that touches, else what brings e up to 0.
fn correction(vertex: &Vertex, x: &[Interval]) -> Interval {
    let e = interpolated(vertex, x);
    let up = Interval { lo: -e.hi, hi: -e.lo }.not_negative();
    match vertex.beside.iter().all(|&edge| x[edge].lo > 0.0) {
        true => up,
        false => Interval { lo: up.lo.min(-e.hi), hi: up.hi },
    }
}

impl Form {
    /// At least |F z| for z within these, and what rounding hides of F.
    fn largest(&self, z: &[Interval]) -> f64 {
        let mut middle = vec![0.0; z.len()];
        let (mut apart, mut hidden) = (0.0, 0.0);
        // Sums of so many products, and the same of squares.
        let share = 2.0 * (z.len() as f64 + 4.0) * f64::EPSILON;
        for (j, z) in z.iter().enumerate() {
            let column = column(&self.factor, j);
            let center = 0.5 * z.lo + 0.5 * z.hi;
            middle.iter_mut().zip(column).for_each(|(sum, entry)| *sum += entry * center);
            let norm = norm(column);
            apart += (z.hi - center).max(center - z.lo).next_up() * norm;
            hidden += z.size() * (self.lost[j] + share * norm);
        }
        norm(&middle) + apart + hidden
    }
}

/// d of a vertex where fluxes have limits: from nothing to all that brings e to 0.
fn eased(vertex: &Vertex, x: &[Interval]) -> Interval {
    let e = interpolated(vertex, x);
    Interval { lo: (-e.hi).min(0.0), hi: (-e.lo).max(0.0) }
}

/// Largest charge for s where it is on another side of the gap than u.
fn crossed(model: &CondensedModel, form: &Form, p: &[Interval], x: &[Interval]) -> f64 {
    let of_edge = |(at, ends): (usize, &[usize; 2])| {
        let scale = Interval::point(model.energy_unit) * inverse(model.opening[at]);
        let excess = ends.map(|place| match form.vertices.get(place) {
            // d brings e towards 0.
            Some(vertex) => {
                let e = interpolated(vertex, x);
                scale * Interval { lo: e.lo.min(0.0), hi: e.hi.max(0.0) }
            }
            None => corner_of(form, place, p),
        });
        let sum = |of: fn(&Interval) -> f64| of(&excess[0]).max(0.0) + of(&excess[1]).max(0.0);
        let [above, below] = [sum(|e| e.hi), sum(|e| -e.lo)];
        let [least, greatest] = model.ends_within(at, p);
        let price = |excess: f64, room: f64| match excess > 0.0 && room.is_finite() {
            true => excess * (room.max(0.0) + form.span_excess),
            false => 0.0,
        };
        let span = greatest.hi - least.lo;
        let open = if x[at].hi > 0.0 { price(below, span) } else { 0.0 };
        let saturated = if x[at].lo < 0.0 { price(above, span) } else { 0.0 };
        // An edge that touches has s = ψ at its ends but for corners.
        let r = AffineOutput::row(model, at).within(p, x);
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
    corner.map_or(Interval::ZERO, |corner| excess(corner, p))
}

/// (u_D − ψ)/d
fn excess(corner: &Corner, p: &[Interval]) -> Interval {
    dot(corner.excess.iter().copied().map(Interval::point), p.iter().copied())
}

/// e of a vertex.
fn interpolated(vertex: &Vertex, x: &[Interval]) -> Interval {
    dot(vertex.weights.map(Interval::point), vertex.edges.map(|edge| x[edge]))
}

/// 1/x of a positive number.
fn inverse(x: f64) -> Interval {
    Interval { lo: (1.0 / x).next_down(), hi: (1.0 / x).next_up() }
}
