//! K x = b for many b at once, where nothing is in contact.

use super::condensation::check_pivots;
use super::problem::{Matrix, check_finite};
use super::sparse_cholesky::SparseCholesky;
use super::{Problem, ReferenceError};

/// The factor of a sparse, symmetric, positive definite matrix, for loads one after the other.
pub struct LinearFactor {
    matrix: Matrix,
    cholesky: SparseCholesky,
}

impl LinearFactor {
    /// Factors the matrix with these columns and values in its rows; see [`Problem`] for them.
    ///
    /// # Errors
    /// Columns that do not fit, numbers that are not finite, a matrix that is not positive definite.
    pub fn new<Row: IntoIterator<Item = (u32, f64)>>(
        rows: impl IntoIterator<Item = Row>,
    ) -> Result<Self, ReferenceError> {
        let (mut row_ptr, mut col_idx, mut values) = (vec![0], Vec::new(), Vec::new());
        for row in rows {
            for (column, value) in row {
                col_idx.push(column);
                values.push(value);
            }
            row_ptr.push(values.len() as u32);
        }
        let load = &vec![0.0; row_ptr.len() - 1];
        let (row_ptr, col_idx, values) = (&row_ptr[..], &col_idx[..], &values[..]);
        let problem =
            Problem { row_ptr, col_idx, values, load, lower: &[], spans: &[], floating: &[] };
        problem.check()?;
        let matrix = Matrix::of(&problem);
        let cholesky = SparseCholesky::new(&matrix, values)?;
        check_pivots(&cholesky, &matrix)?;
        Ok(Self { matrix, cholesky })
    }

    /// Solves for the columns of `loads`, n numbers each, one after the other, and corrects the result
    /// once by a residual summed in twice the working precision.
    ///
    /// # Errors
    /// Columns that are not whole, numbers that are not finite.
    pub fn solve(&self, loads: &[f64]) -> Result<Vec<f64>, ReferenceError> {
        let Self { matrix, cholesky } = self;
        let n = matrix.unknowns();
        check_finite("load", loads)?;
        if n == 0 || loads.is_empty() {
            return Ok(Vec::new());
        }
        if !loads.len().is_multiple_of(n) {
            return Err(ReferenceError::Malformed("loads must hold whole columns"));
        }
        let mut solutions = loads.to_vec();
        cholesky.solve_in_place(&mut solutions, n)?;
        let pairs = loads.chunks(n).zip(solutions.chunks(n));
        let mut corrections: Vec<f64> =
            pairs.flat_map(|(load, solution)| matrix.residual(load, solution)).collect();
        cholesky.solve_in_place(&mut corrections, n)?;
        solutions.iter_mut().zip(corrections).for_each(|(x, correction)| *x += correction);
        check_finite("solution", &solutions)?;
        Ok(solutions)
    }
}
