//! The error bound of a condensed model: what its form makes of (p, x), and what contact adds.
//!
//! s may be on either side of the gap where both ends of a flux are finite, and pays for the side that u is not on:
//! ```text
//!   2 Σ_i scale_i (mean⁺_i (τ_i − least_i) + mean⁻_i (greatest_i − τ_i)),       scale_i = U/d_i,
//! ```
//! with the means of the positive and the negative part of s − ψ over edge i.

use super::ends::nearest;
use super::evaluate::dot;
use super::factor::column;
use super::{CondensedModel, Corner, Form};
use signorini_kernel::excess::Excess;
use signorini_kernel::flux_range::{FluxRange, Span};
use signorini_problem::triangular::norm;

/// An excess this far on a side that there is not, against the size of its terms, is rounding of its sum.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Ends that the law allows for some inputs.
pub(super) struct Allowed {
    /// The least and the greatest r̂ of each edge.
    pub ends: Vec<[f64; 2]>,
    /// U/d_i of each edge.
    pub scale: Vec<f64>,
}

impl CondensedModel {
    /// The guaranteed bound of ‖A^½∇_h(u − u_h)‖ for any x within its sides; `None` where there is none.
    pub fn bound_of_u(&self, p: &[f64], x: &[f64]) -> Option<f64> {
        let form = self.certificate.as_ref().ok()?;
        let jump = self.norm(form, form.jump.as_ref().unwrap_or(&form.factor), p, x);
        Some(self.bound(p, x)? + self.energy_unit * jump)
    }

    /// The guaranteed bound of (p, x) for any x within its sides, in the unit of ‖A^½∇u‖; `None` where there is none.
    pub fn bound(&self, p: &[f64], x: &[f64]) -> Option<f64> {
        let form = self.certificate.as_ref().ok()?;
        self.bound_with(self.norm(form, &form.factor, p, x), p, x)
    }

    /// Bound of a state, `norm` being that of the residual A^½∇s − A^{−½}τ.
    pub(super) fn bound_with(&self, norm: f64, p: &[f64], x: &[f64]) -> Option<f64> {
        let form = self.certificate.as_ref().ok()?;
        let allowed = self.allowed(p);
        let mut residual = self.residual(p, x);
        let mended = form.mend(&self.opening, &allowed.ends, &mut residual, x)?;
        let gap = norm + form.stability * mended;
        let (mut square, mut moved) = (gap.powi(2), 0.0);
        for corner in &form.corners {
            let excess = corner.at(p, allowed.ends[corner.edge])?;
            if !self.is_limited() && x[corner.edge] == 0.0 {
                square += excess.max(0.0) * residual[corner.edge];
            }
            moved += corner.misplaced(excess, allowed.ends[corner.edge]) * corner.energy;
        }
        square += form.crossed(&allowed, p, x, &residual);
        let oscillation: f64 = form.oscillation.iter().zip(p).map(|(osc, p)| osc * p.abs()).sum();
        let oscillation = oscillation + moved;
        let total = oscillation + (square + oscillation * oscillation).sqrt();
        Some(self.energy_unit * total)
    }

    /// |F(p, x, d)| for one of the forms.
    pub(super) fn norm(&self, form: &Form, factor: &[f64], p: &[f64], x: &[f64]) -> f64 {
        form.norm(factor, p, x, &form.correction(&self.allowed(p), p.len(), x))
    }

    /// d of (p, x); nothing without a bound.
    pub fn corrections(&self, p: &[f64], x: &[f64]) -> Vec<f64> {
        let of = |form: &Form| form.correction(&self.allowed(p), p.len(), x);
        self.certificate.as_ref().map(of).unwrap_or_default()
    }

    /// Ends that the law allows at `p`.
    pub(super) fn allowed(&self, p: &[f64]) -> Allowed {
        let scale = self.opening.iter().map(|d| self.energy_unit / d).collect();
        Allowed { ends: self.ends_of(p), scale }
    }
}

impl Corner {
    /// (u_D − ψ)/d at p; `None` where that is on a side that there is not by more than rounding.
    fn at(&self, p: &[f64], [least, greatest]: [f64; 2]) -> Option<f64> {
        let excess = dot(&self.excess, p);
        let size: f64 = self.excess.iter().zip(p).map(|(a, p)| (a * p).abs()).sum();
        let is_below = greatest == f64::INFINITY && excess < -ROUNDING * size;
        let is_above = least == f64::NEG_INFINITY && excess > ROUNDING * size;
        (!is_below && !is_above).then_some(excess)
    }

    /// How far an excess is on a side that there is not.
    fn misplaced(&self, excess: f64, [least, greatest]: [f64; 2]) -> f64 {
        let below = if greatest == f64::INFINITY { -excess.min(0.0) } else { 0.0 };
        let above = if least == f64::NEG_INFINITY { excess.max(0.0) } else { 0.0 };
        below + above
    }
}

impl Form {
    /// d of x at each vertex, with so many inputs: what brings e to 0 beside active edges and to a side that there is
    /// elsewhere. On the side that u is not on, e is left as far as that costs less than it saves.
    pub(super) fn correction(&self, allowed: &Allowed, inputs: usize, x: &[f64]) -> Vec<f64> {
        let first = inputs + x.len();
        let correction = |(at, vertex): (usize, &super::Vertex)| {
            let [a, b] = vertex.edges;
            let e = vertex.weights[0] * x[a] + vertex.weights[1] * x[b];
            let ends = vertex.beside.map(|edge| allowed.ends[edge]);
            let active = vertex.beside.iter().any(|&edge| x[edge] == 0.0);
            let is_nowhere = |[least, greatest]: [f64; 2]| {
                e < 0.0 && greatest == f64::INFINITY || e > 0.0 && least == f64::NEG_INFINITY
            };
            if active || ends.into_iter().any(is_nowhere) {
                return -e;
            }
            let column = column(&self.factor, first + at);
            let eased = vertex.beside.into_iter().fold(e, |e, edge| {
                let reach = self.reach(allowed, edge, column);
                match (x[edge] > 0.0, e > 0.0) {
                    (true, false) => (e + reach).min(0.0),
                    (false, true) => (e - reach).max(0.0),
                    _ => e,
                }
            });
            if eased == e { 0.0 } else { eased - e }
        };
        self.vertices.iter().enumerate().map(correction).collect()
    }

    /// How far an e that pays for an edge is worth moving, `column` being that of its d.
    fn reach(&self, allowed: &Allowed, edge: usize, column: &[f64]) -> f64 {
        if self.span_excess > 0.0 {
            return f64::INFINITY;
        }
        let [least, greatest] = allowed.ends[edge];
        0.5 * (greatest - least) * allowed.scale[edge] / dot(column, column)
    }

    /// |F(p, x, d)|
    pub(super) fn norm(&self, factor: &[f64], p: &[f64], x: &[f64], d: &[f64]) -> f64 {
        let z = p.iter().chain(x).chain(d);
        let mut rows = vec![0.0; p.len() + x.len() + d.len()];
        for (j, z) in z.enumerate() {
            let entries = rows.iter_mut().zip(column(factor, j));
            entries.for_each(|(row, entry)| *row += entry * z);
        }
        norm(&rows)
    }

    /// Mends the residual r̂ and returns |δ|; `None` where what is left over has no way out.
    ///
    /// What is mended must be at an end of its range on inactive edges, and within it on active ones. Where contact alone
    /// holds a part, the sum of all that was taken there leaves through its edge that has most room on either side.
    pub(super) fn mend(
        &self,
        openings: &[f64],
        ends: &[[f64; 2]],
        residual: &mut [f64],
        x: &[f64],
    ) -> Option<f64> {
        let (mut square, mut surplus) = (0.0, 0.0);
        let mut deltas = vec![0.0; residual.len()];
        for (at, (residual, delta)) in residual.iter_mut().zip(&mut deltas).enumerate() {
            let mended = nearest(*residual, x[at], ends[at]);
            *delta = *residual - mended;
            *residual = mended;
            square += *delta * *delta;
        }
        self.floating.iter().for_each(|&edge| surplus += deltas[edge] / openings[edge]);
        if self.floating.iter().any(|&edge| deltas[edge] != 0.0) {
            let room = |edge: usize| {
                let [least, greatest] = ends[edge];
                (residual[edge] - least).min(greatest - residual[edge]) / openings[edge]
            };
            let touching = self.floating.iter().copied().filter(|&edge| x[edge] == 0.0);
            let out = touching.max_by(|&i, &j| room(i).total_cmp(&room(j)))?;
            let change = openings[out] * surplus;
            residual[out] += change;
            square += change * change;
            if residual[out] < ends[out][0] || residual[out] > ends[out][1] {
                return None;
            }
        }
        Some(square.sqrt())
    }

    /// Charge for s on edges whose flux has limits, where it is on the side of the gap that u is not on, `tau` being within the law.
    fn crossed(&self, allowed: &Allowed, p: &[f64], x: &[f64], tau: &[f64]) -> f64 {
        if self.ends.is_empty() {
            return 0.0;
        }
        let moved = self.correction(allowed, p.len(), x);
        let excess = |place: usize, scale: f64| match self.vertices.get(place) {
            Some(vertex) => {
                let [a, b] = vertex.edges;
                scale * (vertex.weights[0] * x[a] + vertex.weights[1] * x[b] + moved[place])
            }
            None => {
                let corner = self.corners.get(place.wrapping_sub(self.vertices.len()));
                corner.map_or(0.0, |corner| dot(&corner.excess, p))
            }
        };
        let of_edge = |at: usize| {
            let scale = allowed.scale[at];
            let ends = self.ends[at].map(|place| excess(place, scale));
            let [above, below] = Excess { ends, bubble: 0.0 }.sides();
            2.0 * self.price(above, below, tau[at], allowed.ends[at])
        };
        (0..self.ends.len()).map(of_edge).sum()
    }

    /// mean⁺ (τ − least) + mean⁻ (greatest − τ), where the range of the edge is the widest that it may be along it. On a side that
    /// there is not, s is but for rounding, which stands elsewhere.
    fn price(&self, above: f64, below: f64, tau: f64, [least, greatest]: [f64; 2]) -> f64 {
        let range = FluxRange::new(0.0, Span::new(greatest - least));
        let side = |excess: f64, room: f64| match excess > 0.0 && room.is_finite() {
            true => excess * (room + range.unseen(room, self.span_excess)),
            false => 0.0,
        };
        side(above, tau - least) + side(below, greatest - tau)
    }
}
