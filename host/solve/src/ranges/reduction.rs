//! A condensed model with the edges that never change sides taken out, exactly.
//!
//! With O always open, T always touching and U kept,
//! ```text
//!   x_T = 0,    x_O = S_OO⁻¹ (B_O p − S_OU x_U),
//!   S′ = S_UU − S_UO S_OO⁻¹ S_OU,    B′ = B_U − S_UO S_OO⁻¹ B_O,    r_T = S_TU x_U + S_TO x_O − B_T p.
//! ```
//! All that a model has is affine in x_O, x_T, r_T or a form in them, and follows.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

use super::sides::{EdgeSide, Sides};
use super::split::product;
use crate::condense::CondensedModel;

/// Affine maps (p, x_U) ─► x_O and (p, x_U) ─► r_T, a row an edge: m numbers of p, then those of x_U.
#[derive(Debug, Clone)]
pub struct Reduction {
    /// U
    pub kept: Vec<usize>,
    /// O
    pub open: Vec<usize>,
    /// T
    pub touching: Vec<usize>,
    /// The openings of O.
    pub openings: Vec<Vec<f64>>,
    /// The reactions of T.
    pub reactions: Vec<Vec<f64>>,
    /// S′ x_U − B′ p of U.
    pub residuals: Vec<Vec<f64>>,
}

impl Reduction {
    /// The maps for these sides; nothing where S_OO is not positive definite.
    pub fn new(model: &CondensedModel, sides: &Sides) -> Option<Self> {
        let [kept, open, touching] =
            [EdgeSide::MayChange, EdgeSide::Open, EdgeSide::Touching].map(|side| sides.all(side));
        let (n, m) = (model.contact, model.inputs);
        let entry = |i: usize, j: usize| model.matrix[i * n + j];
        let own = Mat::from_fn(open.len(), open.len(), |i, j| entry(open[i], open[j]));
        let given = Mat::from_fn(open.len(), m + kept.len(), |i, j| match j.checked_sub(m) {
            None => model.load[j][open[i]],
            Some(j) => -entry(open[i], kept[j]),
        });
        let solved = own.llt(Side::Lower).ok()?.solve(given);
        let openings: Vec<Vec<f64>> =
            (0..open.len()).map(|i| (0..m + kept.len()).map(|j| solved[(i, j)]).collect()).collect();
        let residual = |&edge: &usize| {
            let column = |j: usize| {
                let direct = match j.checked_sub(m) {
                    None => -model.load[j][edge],
                    Some(j) => entry(edge, kept[j]),
                };
                open.iter().zip(&openings).fold(direct, |sum, (&o, row)| sum + entry(edge, o) * row[j])
            };
            (0..m + kept.len()).map(column).collect::<Vec<f64>>()
        };
        let residuals = kept.iter().map(residual).collect();
        let reactions = touching.iter().map(residual).collect();
        Some(Self { kept, open, touching, openings, reactions, residuals })
    }

    /// The edges of O and T that some p of the box and some 0 ≤ x_U ≤ `most` might put on their other side.
    pub fn unproved(&self, ranges: &[[f64; 2]], most: &[f64]) -> Vec<usize> {
        let rows = self.open.iter().zip(&self.openings).chain(self.touching.iter().zip(&self.reactions));
        let intervals: Vec<[f64; 2]> =
            ranges.iter().copied().chain(most.iter().map(|&most| [0.0, most])).collect();
        let fails = |row: &[f64]| {
            let worst = |(a, [lo, hi]): (&f64, &[f64; 2])| if *a > 0.0 { *lo } else { *hi };
            let at: Vec<f64> = row.iter().zip(&intervals).map(worst).collect();
            let (sum, noise) = product(row, &at);
            // The rows were solved for: some n ε of their entries more.
            !(sum > 64.0 * noise)
        };
        rows.filter(|(_, row)| fails(row)).map(|(&edge, _)| edge).collect()
    }
}
