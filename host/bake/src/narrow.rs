//! Arrays in the target's scalar; those of contact edges and their matrix filled up with 0 to whole blocks.

use signorini_contact::dense::blocks::{Block, SIDE, count, padded};

use signorini_condense::CondensedModel;
use signorini_problem::scalar::Scalar;

/// Numbers in the scalar `R`.
pub fn narrow<R: Scalar>(numbers: &[f64]) -> Vec<R> {
    numbers.iter().map(|&x| R::narrow(x)).collect()
}

pub(crate) fn pairs<R: Scalar>(all: &[[f64; 2]]) -> Vec<[R; 2]> {
    all.iter().map(|pair| pair.map(R::narrow)).collect()
}

pub(crate) fn filled_up<R: Scalar>(column: &[f64]) -> Vec<R> {
    let mut column = narrow(column);
    column.resize(padded(column.len()), R::ZERO);
    column
}

/// Ŝ in blocks, padding 0.
pub(crate) fn matrix<R: Scalar>(condensate: &CondensedModel) -> Vec<Block<R>> {
    let n = condensate.contact;
    let entry = |row: usize, column: usize| {
        let inside = row < n && column < n;
        R::narrow(if inside { condensate.matrix[row * n + column] } else { 0.0 })
    };
    let block = |row: usize, column: usize| {
        let line = |r| std::array::from_fn(|c| entry(SIDE * row + r, SIDE * column + c));
        std::array::from_fn(line)
    };
    let rows = 0..n.div_ceil(SIDE);
    let all: Vec<_> = rows.flat_map(|row| (0..=row).map(move |c| (row, c))).collect();
    debug_assert_eq!(all.len(), count(n));
    all.into_iter().map(|(row, column)| block(row, column)).collect()
}
