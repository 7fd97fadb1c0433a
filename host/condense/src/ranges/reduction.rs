//! The affine maps that take edges which never change sides out of a condensed model.
//!
//! With O always open or always at their upper end, T always touching and U kept, and the end of Sx − Bp that belongs to the
//! side of an edge,
//! ```text
//!   x_T = 0,    x_O = S_OO⁻¹ (B_O p + end_O − S_OU x_U),
//!   r_U = S′x_U − B′p,    S′ = S_UU − S_UO S_OO⁻¹ S_OU,    B′ = B_U − S_UO S_OO⁻¹ B_O,
//!   r_T = S_TU x_U + S_TO x_O − B_T p.
//! ```
//! x_O is what its row says, to the last bit: any x ≥ 0 has a bound. What rounding of that solve leaves of r_O, and what
//! it leaves of the other rows, is counted beside them.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

use super::split::product;
use crate::{CondensedModel, Vertex};

/// A number as an affine function of (p, x_U).
#[derive(Debug, Clone)]
pub struct Affine {
    /// m factors of p, then those of x_U.
    pub factors: Vec<f64>,
    /// By how much rounding may have put each off.
    pub noise: Vec<f64>,
}

/// Affine maps (p, x_U) ─► x, r.
#[derive(Debug, Clone)]
pub struct Reduction {
    /// U
    pub kept: Vec<usize>,
    /// O, those at their upper end after the others.
    pub open: Vec<usize>,
    /// How many of O are not at their upper end.
    pub above: usize,
    /// T
    pub touching: Vec<usize>,
    /// x of every edge, exact by definition.
    pub x: Vec<Vec<f64>>,
    /// r of every edge, on O less the end of its side: zeros there but for rounding.
    pub r: Vec<Affine>,
}

impl Reduction {
    /// The maps that leave `kept` of the edges, the others being open, at their upper end, and touching; nothing where S_OO is not
    /// positive definite.
    pub(super) fn new(
        model: &CondensedModel,
        kept: Vec<usize>,
        [mut open, saturated, touching]: [Vec<usize>; 3],
    ) -> Option<Self> {
        let (m, n, above) = (model.inputs, model.contact, open.len());
        open.extend(saturated);
        let (x, r) = (vec![vec![0.0; m + kept.len()]; n], Vec::new());
        let mut maps = Self { kept, open, above, touching, x, r };
        let ends = maps.ends(model);
        for (&edge, row) in maps.open.iter().zip(maps.openings(model, &ends)?) {
            maps.x[edge] = row;
        }
        for (at, &edge) in maps.kept.iter().enumerate() {
            maps.x[edge][m + at] = 1.0;
        }
        maps.r = (0..n).map(|edge| maps.residual(model, edge)).collect();
        maps.open.iter().zip(&ends).for_each(|(&edge, end)| maps.r[edge].subtract(end));
        Some(maps)
    }

    /// The ends of the sides of O, as factors of p.
    pub(super) fn ends(&self, model: &CondensedModel) -> Vec<Vec<f64>> {
        let end = |(at, &edge): (usize, &usize)| {
            let [least, greatest] = model.end_columns(edge);
            if at < self.above { least } else { greatest }
        };
        self.open.iter().enumerate().map(end).collect()
    }

    /// x_O by rows.
    fn openings(&self, model: &CondensedModel, ends: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
        let (n, m, Self { kept, open, .. }) = (model.contact, model.inputs, self);
        let entry = |i: usize, j: usize| model.matrix[i * n + j];
        let own = Mat::from_fn(open.len(), open.len(), |i, j| entry(open[i], open[j]));
        let columns = m + kept.len();
        let given = Mat::from_fn(open.len(), columns, |i, j| match j.checked_sub(m) {
            None => model.load[j][open[i]] + ends[i][j],
            Some(j) => -entry(open[i], kept[j]),
        });
        let solved = own.llt(Side::Lower).ok()?.solve(given);
        let row = |i: usize| (0..columns).map(|j| solved[(i, j)]).collect();
        Some((0..open.len()).map(row).collect())
    }

    /// (Sx − Bp)_edge
    fn residual(&self, model: &CondensedModel, edge: usize) -> Affine {
        let (n, m, Self { kept, open, x, .. }) = (model.contact, model.inputs, self);
        let own = &model.matrix[edge * n..(edge + 1) * n];
        let of_open: Vec<f64> = open.iter().map(|&at| own[at]).collect();
        let column = |j: usize| {
            let direct = match j.checked_sub(m) {
                None => -model.load[j][edge],
                Some(j) => own[kept[j]],
            };
            let through: Vec<f64> = open.iter().map(|&at| x[at][j]).collect();
            let (sum, noise) = product(&of_open, &through);
            (direct + sum, noise + f64::EPSILON * direct.abs())
        };
        let (factors, noise) = (0..m + kept.len()).map(column).unzip();
        Affine { factors, noise }
    }

    /// The edges of O and T that some (p, x_U) within `intervals` might put on another side.
    pub fn unproved(&self, model: &CondensedModel, intervals: &[[f64; 2]]) -> Vec<usize> {
        // A NaN proves nothing.
        let is_open = |(at, edge): (usize, usize)| {
            let sign = if at < self.above { 1.0 } else { -1.0 };
            let signed: Vec<f64> = self.x[edge].iter().map(|factor| sign * factor).collect();
            least(&signed, &[], intervals) > 0.0
        };
        let is_touching = |edge: usize| {
            let is_within = |(end, sign): (Vec<f64>, f64)| {
                let mut row = self.r[edge].clone();
                row.subtract(&end);
                end[0].is_infinite() || row.least(sign, intervals) >= 0.0
            };
            model.end_columns(edge).into_iter().zip([1.0, -1.0]).all(is_within)
        };
        let open = self.open.iter().copied().enumerate().filter(|&of| !is_open(of));
        let touching = self.touching.iter().copied().filter(|&edge| !is_touching(edge));
        open.map(|(_, edge)| edge).chain(touching).collect()
    }

    /// Σ_i of what rounding leaves of r_O, and of r_U beside what S′ and B′ say, by columns of (p, x_U). S′ is made
    /// symmetric: what the solve for x_O leaves of r_O stands in its skew part too.
    pub(super) fn hidden(&self, inputs: usize) -> Vec<f64> {
        let mut sum = vec![0.0; inputs + self.kept.len()];
        let mut add = |row: &Affine, share: f64| {
            for ((sum, factor), noise) in sum.iter_mut().zip(&row.factors).zip(&row.noise) {
                *sum += share * factor.abs() + noise + 4.0 * f64::EPSILON * factor.abs();
            }
        };
        let rows = |edges: &[usize]| edges.iter().map(|&at| &self.r[at]).collect::<Vec<_>>();
        let (left, residuals) = (rows(&self.open), rows(&self.kept));
        left.iter().for_each(|row| add(row, 1.0));
        residuals.iter().for_each(|row| add(row, 0.0));
        for (i, row) in residuals.iter().enumerate() {
            for (j, other) in residuals.iter().enumerate() {
                sum[inputs + j] +=
                    0.5 * (row.factors[inputs + j] - other.factors[inputs + i]).abs();
            }
        }
        sum
    }

    /// e of a vertex. Its two terms may cancel, their rounding does not.
    pub(super) fn interpolated(&self, vertex: &Vertex) -> Affine {
        let ([a, b], [p, q]) = (vertex.edges.map(|edge| &self.x[edge]), vertex.weights);
        let factors = a.iter().zip(b).map(|(a, b)| p * a + q * b).collect();
        let noise = |(a, b): (&f64, &f64)| 2.0 * f64::EPSILON * ((p * a).abs() + (q * b).abs());
        Affine { factors, noise: a.iter().zip(b).map(noise).collect() }
    }
}

impl Affine {
    /// Factors that no rounding has put off.
    pub(super) fn exact(factors: Vec<f64>) -> Self {
        let noise = vec![0.0; factors.len()];
        Self { factors, noise }
    }

    /// At most the least value of `sign` times it, for variables within `intervals`.
    pub(super) fn least(&self, sign: f64, intervals: &[[f64; 2]]) -> f64 {
        let signed: Vec<f64> = self.factors.iter().map(|factor| sign * factor).collect();
        least(&signed, &self.noise, intervals)
    }

    /// Less what the m factors of p in `end` make.
    fn subtract(&mut self, end: &[f64]) {
        for ((factor, noise), end) in self.factors.iter_mut().zip(&mut self.noise).zip(end) {
            *noise += if *end == 0.0 { 0.0 } else { f64::EPSILON * (factor.abs() + end.abs()) };
            *factor -= end;
        }
    }
}

/// At most the least value of an affine function whose variables lie in `intervals`.
pub(super) fn least(factors: &[f64], noise: &[f64], intervals: &[[f64; 2]]) -> f64 {
    let worst = |(a, [lo, hi]): (&f64, &[f64; 2])| if *a > 0.0 { *lo } else { *hi };
    let at: Vec<f64> = factors.iter().zip(intervals).map(worst).collect();
    let (sum, rounding) = product(factors, &at);
    let largest = |[lo, hi]: &[f64; 2]| lo.abs().max(hi.abs());
    let off: f64 = noise.iter().zip(intervals).map(|(noise, range)| noise * largest(range)).sum();
    sum - 2.0 * (rounding + off)
}
