//! The tall residual matrix, never held: its triangular factor and the energies of fluxes.
//!
//! Rows come in chunks; of [F; chunk] the triangular factor is the new F, so that |Fz| = |(Gs − Tτ)(z)|
//! for every column vector z, to rounding and without squaring the condition.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};

use super::best::Table;
use super::block::Block;

/// Rows a chunk, on top of one for each column.
const CHUNK: usize = 1024;

/// F of the residual in all columns of `s`.
pub(super) fn triangular(blocks: &[Block], s: &Table, fluxes: &Table) -> Mat<f64> {
    let columns = s.columns;
    let mut factor = Mat::zeros(columns, columns);
    in_chunks(
        blocks,
        columns,
        |chunk| {
            let stacked = Mat::from_fn(columns + chunk.nrows(), columns, |i, j| {
                if i < columns { factor[(i, j)] } else { chunk[(i - columns, j)] }
            });
            factor = stacked.qr().thin_R().to_owned();
        },
        |block, row, sum| block.residual(row, s, fluxes, sum),
    );
    factor
}

/// ∫A⁻¹τ·τ′ + ∫_R (τ·n)(τ′·n)/h for all pairs of columns of `fluxes`.
pub(super) fn energies(blocks: &[Block], fluxes: &Table) -> Mat<f64> {
    let columns = fluxes.columns;
    let mut energies = Mat::zeros(columns, columns);
    in_chunks(
        blocks,
        columns,
        |chunk| {
            matmul(&mut energies, Accum::Add, chunk.transpose(), chunk, 1.0, Par::Seq);
        },
        |block, row, sum| block.of_fluxes(row, fluxes, sum),
    );
    energies
}

/// Hands rows, evaluated in all columns by `evaluate`, to `take`, a chunk at a time.
fn in_chunks(
    blocks: &[Block],
    columns: usize,
    mut take: impl FnMut(&Mat<f64>),
    evaluate: impl Fn(&Block, &[f64], &mut [f64]),
) {
    let mut chunk = Mat::<f64>::zeros(CHUNK, columns);
    let mut sum = vec![0.0; columns];
    let mut filled = 0;
    for (block, row) in
        blocks.iter().flat_map(|block| block.rows.iter().map(move |row| (block, row)))
    {
        evaluate(block, row, &mut sum);
        sum.iter().enumerate().for_each(|(j, &entry)| chunk[(filled, j)] = entry);
        filled += 1;
        if filled == CHUNK {
            take(&chunk);
            filled = 0;
        }
    }
    if filled > 0 {
        // What is left of the chunk before is no part of the matrix.
        (filled..CHUNK).for_each(|i| (0..columns).for_each(|j| chunk[(i, j)] = 0.0));
        take(&chunk);
    }
}

/// The upper triangle by columns, column j with its j + 1 entries.
pub(super) fn packed(factor: &Mat<f64>) -> Vec<f64> {
    (0..factor.ncols()).flat_map(|j| (0..=j).map(move |i| factor[(i, j)])).collect()
}

/// Column j of such a triangle.
pub(super) fn column(factor: &[f64], j: usize) -> &[f64] {
    &factor[j * (j + 1) / 2..(j + 1) * (j + 2) / 2]
}

/// |x|
pub(super) fn norm(x: &[f64]) -> f64 {
    x.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}
