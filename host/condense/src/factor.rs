//! The tall residual matrix, never held: its triangular factor and the energies of fluxes.
//!
//! Rows come in chunks; of [F; chunk] the triangular factor is the new F, so that |Fz| = |(Gs − Tτ)(z)|
//! for every column vector z, to rounding and without squaring the condition.
//!
//! Energies tell how far it is from a residual of 1 on a contact edge to a flux that mends it.
//!
//! w_i is a flux that brings 1 in through contact edge i and out where the part is held: τ of the column
//! Ŝ⁻¹e_i. Then |A^{−½} Σδ_i w_i| ≤ stability |δ| with reach² = λ_max(Ŵ), Ŵ_ij = ∫A⁻¹w_i·w_j + ∫_R …/h.
//! Where contact alone holds one of the parts, Ŝ is singular on its constants; there w_i lets its 1 go
//! through a source all over the part, and whoever mends sends the sum of all through one more edge.

use faer::linalg::matmul::matmul;
use faer::linalg::solvers::Solve;
use faer::{Accum, Mat, Par, Side};

use super::best::Table;
use super::block::Block;

/// Rows per chunk, on top of one for each column.
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

/// Source for a part held by contact alone.
pub(super) struct Source {
    /// 1/d_i of the unknowns of that part, 0 of the others.
    pub inverse: Vec<f64>,
    /// The condensed load B̂ of a source that adds up to 1.
    pub load: Vec<f64>,
}

/// stability for Ŝ = `matrix`; `energies` of the columns of x, and of the source's where there is one.
/// `None` where Ŝ is singular to rounding.
pub(super) fn stability(
    matrix: &Mat<f64>,
    energies: &Mat<f64>,
    source: Option<&Source>,
) -> Option<f64> {
    if matrix.nrows() == 0 {
        return Some(0.0);
    }
    let columns = match source {
        None => held(matrix)?,
        Some(source) => floating(matrix, source)?,
    };
    let mending = columns.transpose() * energies * &columns;
    let eigenvalues = mending.self_adjoint_eigenvalues(Side::Lower).ok()?;
    let largest = eigenvalues.into_iter().fold(0.0, f64::max);
    largest.is_finite().then(|| largest.sqrt())
}

/// Ŝ⁻¹
fn held(matrix: &Mat<f64>) -> Option<Mat<f64>> {
    let n = matrix.nrows();
    Some(matrix.llt(Side::Lower).ok()?.solve(Mat::<f64>::identity(n, n)))
}

/// The columns (x, source) of the w_i: x solves Ŝx = e_i + Q_i B̂ with the source Q_i = −1/d_i that
/// makes it solvable, Q_i = 0 in parts that something else holds; adding the constants' projection picks one x and changes no flux.
fn floating(matrix: &Mat<f64>, Source { inverse, load }: &Source) -> Option<Mat<f64>> {
    let n = matrix.nrows();
    let square: f64 = inverse.iter().map(|c| c * c).sum();
    let constant: Vec<f64> = inverse.iter().map(|c| c / square.sqrt()).collect();
    let shifted = Mat::from_fn(n, n, |i, j| matrix[(i, j)] + constant[i] * constant[j]);
    let given = Mat::from_fn(n, n, |i, j| f64::from(u8::from(i == j)) - load[i] * inverse[j]);
    let x = shifted.llt(Side::Lower).ok()?.solve(given);
    Some(Mat::from_fn(n + 1, n, |i, j| if i < n { x[(i, j)] } else { -inverse[j] }))
}
