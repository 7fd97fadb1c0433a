//! Smoothed aggregation: prolongations that are constant on aggregates, after a step of damped Jacobi.
//!
//! ```text
//!   P = (I − ω D⁻¹ Ã) T,   T_iJ = 1 where i is in aggregate J,   D_ii = Σ_j |ã_ij|,   ω = 4/3
//! ```
//! Ã has the strong couplings of A, the weak ones added to its diagonal. D dominates Ã, so that ω D⁻¹ Ã has no eigenvalue above
//! ω, whatever the cells are.

use crate::aggregation::{NONE, Strength, aggregates};
use crate::sparse::{RowSum, Sparse};

/// ω
const DAMPING: f64 = 4.0 / 3.0;

/// P of `matrix`; `threshold` is θ of its strong couplings.
pub(crate) fn smoothed(matrix: &Sparse, diagonal: &[f64], threshold: f64) -> Sparse {
    let strength = Strength::new(matrix, diagonal, threshold);
    let (of, count) = aggregates(&strength);
    let mut prolongation = Sparse::with_columns(count);
    let mut sum = RowSum::new(count);
    for row in 0..matrix.rows() {
        if of[row] != NONE {
            smooth_row(matrix, &strength, row, &of, |aggregate, weight| {
                sum.add(&mut prolongation, aggregate, weight);
            });
        }
        prolongation.end_row();
    }
    prolongation
}

/// Weights of one row, some aggregates more than once.
fn smooth_row(
    matrix: &Sparse,
    strength: &Strength,
    row: usize,
    of: &[u32],
    mut add: impl FnMut(u32, f64),
) {
    let (mut own, mut others) = (0.0, 0.0);
    for &entry in matrix.row(row) {
        match strength.is_strong(row, entry) {
            true => others += entry.1.abs(),
            false => own += entry.1,
        }
    }
    if others == 0.0 {
        return add(of[row], 1.0);
    }
    let step = DAMPING / (own.abs() + others);
    add(of[row], 1.0 - step * own);
    for &entry in matrix.row(row) {
        let aggregate = of[entry.0 as usize];
        if aggregate != NONE && strength.is_strong(row, entry) {
            add(aggregate, -step * entry.1);
        }
    }
}
