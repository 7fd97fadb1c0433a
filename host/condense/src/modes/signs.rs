//! Whether Ŝ(δ) is an M-matrix whatever δ is.
//!
//! With everything but the contact edges C and the edges R of the coefficient eliminated at the least one,
//! ```text
//!   M = | Ŝ + αᵀν⁻¹α   αᵀν⁻¹Qᵀ |        Ŝ(δ) is the Schur complement on C of M + δ (0 ⊕ 1), R scaled by W^½.
//!       | Qν⁻¹α        Qν⁻¹Qᵀ  |
//! ```
//! M is positive definite. Where no entry off its diagonal is positive it is an M-matrix, with a larger diagonal it stays one,
//! and so do Schur complements: Ŝ(δ) has no positive entry off the diagonal, and its entries grow with δ.
//!
//! What is positive by rounding, at most t √(M_aa M_bb), is taken off: Ŝ(δ) falls by at most t w_i w_j, with the fields of unit
//! openings on R, w_i = √M_ii + Σ_R √M_ee |Q α|_ei.

use super::passing::Mode;
use crate::CondensedModel;

/// Part of an entry that counts as rounding.
const ROUNDING: f64 = 1e-12;

/// The most that rounding makes of the positive part of a row; nothing where more than rounding is positive. `alphas` are
/// U α of every mode.
pub(super) fn slack(model: &CondensedModel, modes: &[Mode], alphas: &[Vec<f64>]) -> Option<f64> {
    let (n, unit) = (model.contact, model.energy_unit);
    let edges = modes.first().map_or(0, |mode| mode.vector.len());
    // What each mode is at contact edges and at those of R.
    let shapes: Vec<Vec<f64>> = modes
        .iter()
        .zip(alphas)
        .map(|(mode, alpha)| {
            alpha.iter().map(|a| a / unit).chain(mode.vector.iter().copied()).collect()
        })
        .collect();
    let entry = |i: usize, j: usize| {
        let terms = shapes.iter().zip(modes);
        let sum: f64 = terms.map(|(of, mode)| of[i] * of[j] / mode.compliance).sum();
        sum + if i < n && j < n { model.matrix[i * n + j] } else { 0.0 }
    };
    let roots: Vec<f64> = (0..n + edges).map(|i| entry(i, i).sqrt()).collect();
    let mut most = f64::EPSILON;
    for (i, j) in (0..n + edges).flat_map(|i| (0..i).map(move |j| (i, j))) {
        let part = entry(i, j) / (roots[i] * roots[j]);
        if part.is_nan() || part > ROUNDING {
            return None;
        }
        most = most.max(part);
    }
    let weight = |i: usize| {
        let of_edge = |e: usize| shapes.iter().map(|of| of[i] * of[n + e]).sum::<f64>().abs();
        roots[i] + (0..edges).map(|e| roots[n + e] * of_edge(e)).sum::<f64>()
    };
    let weights: Vec<f64> = (0..n).map(weight).collect();
    let largest = weights.iter().fold(0.0, |most: f64, w| most.max(*w));
    Some(most * largest * weights.iter().sum::<f64>())
}
