//! K x = b for many b at once, where nothing is in contact.

use super::condensation::check_pivots;
use super::problem::{Matrix, check_finite};
use super::sparse_cholesky::SparseCholesky;
use super::{Problem, ReferenceError};

/// A sparse, symmetric, positive definite matrix; see [`Problem`] for its rows.
#[derive(Debug, Clone, Copy)]
pub struct Linear<'a> {
    /// Row starts, n + 1 of them.
    pub row_ptr: &'a [u32],
    /// Column of each entry.
    pub col_idx: &'a [u32],
    /// Value of each entry.
    pub values: &'a [f64],
}

/// Its factor, for loads one after the other.
pub struct LinearFactor {
    matrix: Matrix,
    cholesky: SparseCholesky,
}

impl Linear<'_> {
    /// Factors the matrix.
    ///
    /// # Errors
    /// Arrays that do not fit, numbers that are not finite, a matrix that is not positive definite.
    pub fn factor(&self) -> Result<LinearFactor, ReferenceError> {
        let Self { row_ptr, col_idx, values } = *self;
        let load = &vec![0.0; row_ptr.len().saturating_sub(1)];
        let problem =
            Problem { row_ptr, col_idx, values, load, lower: &[], spans: &[], floating: &[] };
        problem.check()?;
        let matrix = Matrix::of(&problem);
        let cholesky = SparseCholesky::new(&matrix, values)?;
        check_pivots(&cholesky, &matrix)?;
        Ok(LinearFactor { matrix, cholesky })
    }

    /// Solves for the columns of `loads`, n numbers each, one after the other, as [`LinearFactor::solve`] does.
    ///
    /// # Errors
    /// Those of [`Linear::factor`] and [`LinearFactor::solve`].
    pub fn solve(&self, loads: &[f64]) -> Result<Vec<f64>, ReferenceError> {
        self.factor()?.solve(loads)
    }
}

impl LinearFactor {
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
