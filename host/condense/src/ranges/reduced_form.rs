//! The error bound of a reduced model: the form of the whole one in what is left, F M = Q F′, and what that loses to rounding.

use faer::Mat;

use super::reduced::Build;
use super::reduction::Affine;
use super::sides::VertexSide;
use crate::factor::{column, packed};
use crate::{Corner, Form, Vertex};
use signorini_problem::triangular::norm;

impl Build<'_> {
    pub fn form(&self, form: &Form) -> Form {
        let at = |vertex: &Vertex| self.sides.at(vertex, self.maps);
        let seen: Vec<_> =
            form.vertices.iter().filter(|vertex| at(vertex) == VertexSide::MayChange).collect();
        let columns = self.columns(form, &seen);
        let most = self.scale.iter().fold(0.0, |most: f64, s| most.max(*s));
        let least = self.scale.iter().fold(f64::INFINITY, |least: f64, s| least.min(*s));
        Form {
            factor: product(&form.factor, &columns),
            jump: form.jump.as_ref().map(|jump| product(jump, &columns)),
            lost: lost(form, &columns, &self.rescaled(self.maps.hidden(self.whole.inputs))),
            vertices: seen.into_iter().map(|vertex| self.vertex(vertex)).collect(),
            stability: form.stability * most,
            corners: form.corners.iter().map(|corner| self.corner(corner)).collect(),
            oscillation: form.oscillation.clone(),
            floating: Vec::new(),
            ends: self.ends(form),
            span_excess: if self.is_limited() { form.span_excess / least } else { 0.0 },
        }
    }

    /// Where s − ψ comes from at the ends of the edges that are left. It is 0 beside edges that always touch. At a vertex with
    /// d = 0 it is at least 0 beside an open edge, which pays for s below ψ alone: 0 is the worst there.
    fn ends(&self, form: &Form) -> Vec<[usize; 2]> {
        if !self.is_limited() {
            return Vec::new();
        }
        let is_seen =
            |at: &usize| self.sides.at(&form.vertices[*at], self.maps) == VertexSide::MayChange;
        let seen: Vec<usize> = (0..form.vertices.len()).filter(is_seen).collect();
        let place = |end: usize| match end.checked_sub(form.vertices.len()) {
            _ if end == Form::NOTHING => end,
            Some(corner) => seen.len() + corner,
            None => seen.iter().position(|&at| at == end).unwrap_or(Form::NOTHING),
        };
        self.maps.kept.iter().map(|&edge| form.ends[edge].map(place)).collect()
    }

    /// Factors of (p, x′, d′) from those of (p, x, d), with what each may be off.
    pub fn combined(&self, form: &Form, of_whole: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let at = |vertex: &&Vertex| self.sides.at(vertex, self.maps) == VertexSide::MayChange;
        let rows = self.columns(form, &form.vertices.iter().filter(at).collect::<Vec<_>>());
        let mut sum = vec![[0.0; 2]; width(&rows)];
        for ([factor, off], row) in of_whole.iter().zip(&rows) {
            for ((sum, share), noise) in sum.iter_mut().zip(&row.factors).zip(&row.noise) {
                let term = factor * share;
                let rounding = factor.abs() * noise + 4.0 * f64::EPSILON * term.abs();
                *sum = [sum[0] + term, sum[1] + off * share.abs() + rounding];
            }
        }
        sum
    }

    /// M, row by row: each column of F in (p, x′, d′).
    fn columns(&self, form: &Form, seen: &[&Vertex]) -> Vec<Affine> {
        let m = self.whole.inputs;
        let width = m + self.maps.kept.len() + seen.len();
        let wide = |factors: Vec<f64>| {
            let mut row = self.rescaled(factors);
            row.resize(width, 0.0);
            row
        };
        let unit = |at: usize| Affine::exact((0..width).map(|k| f64::from(k == at)).collect());
        let inputs = (0..m).map(unit);
        let openings = self.maps.x.iter().map(|row| Affine::exact(wide(row.clone())));
        let mut next = m + self.maps.kept.len();
        let corrections =
            form.vertices.iter().map(|vertex| match self.sides.at(vertex, self.maps) {
                VertexSide::Free => Affine::exact(vec![0.0; width]),
                VertexSide::Touching => {
                    let e = self.maps.interpolated(vertex);
                    let factors = wide(e.factors).into_iter().map(|factor| -factor);
                    Affine { factors: factors.collect(), noise: wide(e.noise) }
                }
                VertexSide::MayChange => {
                    next += 1;
                    unit(next - 1)
                }
            });
        inputs.chain(openings).chain(corrections).collect()
    }

    /// e in x′; an edge that always touches has no share in it.
    fn vertex(&self, vertex: &Vertex) -> Vertex {
        let place = |edge: usize| self.maps.kept.iter().position(|&kept| kept == edge);
        let first = vertex.beside.iter().find_map(|&edge| place(edge)).unwrap_or(0);
        let (mut edges, mut weights) = ([first; 2], [0.0; 2]);
        for (at, (edge, weight)) in vertex.edges.into_iter().zip(vertex.weights).enumerate() {
            if let Some(place) = place(edge) {
                (edges[at], weights[at]) = (place, weight / self.scale[place]);
            }
        }
        Vertex { edges, weights, beside: vertex.beside.map(|edge| place(edge).unwrap_or(first)) }
    }

    fn corner(&self, corner: &Corner) -> Corner {
        let edge = self.maps.kept.iter().position(|&kept| kept == corner.edge).unwrap_or(0);
        let s = self.scale[edge];
        Corner {
            edge,
            excess: corner.excess.iter().map(|e| e * s).collect(),
            energy: corner.energy / s,
        }
    }
}

/// How many numbers the rows of M take.
fn width(columns: &[Affine]) -> usize {
    columns.first().map_or(0, |row| row.factors.len())
}

/// F′ of F, both upper triangles by columns.
fn product(factor: &[f64], columns: &[Affine]) -> Vec<f64> {
    let width = width(columns);
    let mut product = Mat::<f64>::zeros(columns.len().max(width), width);
    for (j, row) in columns.iter().enumerate() {
        for (k, &weight) in row.factors.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
            for (i, entry) in column(factor, j).iter().enumerate() {
                product[(i, k)] += weight * entry;
            }
        }
    }
    packed(&product.qr().thin_R().to_owned())
}

/// Parts of the columns of F′ that rounding may hide, `left` beside those that M loses.
fn lost(form: &Form, columns: &[Affine], left: &[f64]) -> Vec<f64> {
    let width = width(columns);
    // Sums of so many products, and the rotations of as many rows.
    let share = 8.0 * (columns.len() + width) as f64 * f64::EPSILON;
    let mut lost = vec![0.0; width];
    for (j, Affine { factors, noise }) in columns.iter().enumerate() {
        let of_jump = form.jump.as_ref().map_or(0.0, |jump| norm(column(jump, j)));
        let largest = norm(column(&form.factor, j)).max(of_jump);
        let size = form.lost[j] + share * largest;
        for ((lost, weight), noise) in lost.iter_mut().zip(factors).zip(noise) {
            *lost += size * weight.abs() + largest * noise;
        }
    }
    lost.iter_mut().zip(left).for_each(|(lost, left)| *lost += form.stability * left);
    lost
}
