//! Arrays in the target's scalar, those of contact edges and their matrix filled up with 0 to whole blocks; whether
//! that keeps its signs.

use signorini_contact::dense::blocks::{Block, SIDE, count, padded};
use signorini_kernel::{Error, error::Array};

use signorini_condense::CondensedModel;
use signorini_condense::ranges::split::Split;
use signorini_problem::Exclusion;
use signorini_problem::scalar::Scalar;

/// Numbers in the scalar `R`.
pub fn narrow<R: Scalar>(numbers: &[f64]) -> Vec<R> {
    numbers.iter().map(|&x| R::narrow(x)).collect()
}

/// Rows for [`signorini_device::exclusions`], each over its largest factor.
pub(crate) fn exclusions<R: Scalar>(rows: &[Exclusion]) -> Vec<R> {
    let of = |row: &Exclusion| {
        let largest = row.factors.iter().fold(f64::MIN_POSITIVE, |most, of| most.max(of.abs()));
        let numbers = std::iter::once(&row.slack).chain(&row.factors);
        numbers.map(|number| R::narrow(number / largest)).collect::<Vec<_>>()
    };
    rows.iter().flat_map(of).collect()
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

/// The columns of spans that the target needs.
///
/// # Errors
/// A limit that the scalar takes for none.
pub(crate) fn spans<R: Scalar>(condensate: &CondensedModel) -> Result<Vec<R>, Error> {
    let columns = if condensate.is_varying() { condensate.inputs } else { 1 };
    let columns = || condensate.spans.iter().take(columns);
    let is_lost = |span: &f64| span.is_finite() && !R::narrow(*span).finite();
    match columns().flatten().position(is_lost) {
        Some(at) => Err(Error::NotFinite { of: Array::ContactSpans, at }),
        None => Ok(columns().flat_map(|column| filled_up(column)).collect()),
    }
}

/// Whether Ŝ in the scalar of the target is a nonsingular M-matrix.
pub(crate) fn is_monotone<R: Scalar>(condensate: &CondensedModel) -> bool {
    let stored: Vec<f64> = condensate.matrix.iter().map(|&entry| R::narrow(entry).wide()).collect();
    let split = Split::new(&stored, condensate.contact);
    split.is_some_and(|split| split.has_all_signs())
}
