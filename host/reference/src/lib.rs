//! The independent reference for the contact problem: a direct solver that shares nothing with the
//! kernel but the matrix.
//!
//! ```text
//! minimise ½ uᵀKu − bᵀu   over u ∈ Rⁿ with u_i ≥ ψ_i on the contact unknowns
//! ```
//!
//! Unknowns are ordered free first (F), contact last (C). With λ = Ku − b the solution is the u with
//!
//! ```text
//! λ_F = 0,   u_C ≥ ψ,   λ_C ≥ 0,   λ_i (u_i − ψ_i) = 0.
//! ```
//!
//! Where λ_i may be at most s_i ≥ 0, u_i may fall below ψ_i where it is that; where s_i = −∞, u_i ≤ ψ_i and λ_i ≤ 0.
//!
//! The way there, a file each: `sparse_cholesky` keeps C last and the fill low; `condensation` factors
//! once by it and reads the Schur complement S on C from the trailing block of L;
//! `active_set` solves the small dense problem on S exactly; `refinement` repeats the two with
//! the remaining residual until u is right to its last digits.

mod active_set;
mod condensation;
mod linear;
mod problem;
mod refinement;
mod sparse_cholesky;
#[cfg(test)]
mod tests;

use faer::MatRef;
use faer::sparse::FaerError;
use thiserror::Error;

pub use linear::LinearFactor;
pub use problem::Problem;
pub use refinement::Solution;
pub use sparse_cholesky::minimum_degree;

use active_set::ActiveSet;
use condensation::Condensation;
use problem::{Matrix, check_finite};

/// One sparse Cholesky factorisation, good for any number of loads and obstacles.
pub struct Factor {
    matrix: Matrix,
    condensation: Condensation,
    /// The contact unknowns of each floating component, numbered from 0 within C.
    floating: Vec<Vec<usize>>,
}

impl Factor {
    /// Factors the matrix of `problem`; its `load` and `lower` are checked but not used.
    pub fn new(problem: &Problem) -> Result<Self, ReferenceError> {
        problem.check()?;
        let matrix = Matrix::of(problem);
        let condensation = Condensation::new(&matrix)?;
        let floating = problem.floating_components();
        Ok(Self { matrix, condensation, floating })
    }

    /// Entries of its L, zeros within its dense blocks among them.
    pub fn entries(&self) -> usize {
        self.condensation.cholesky.stored()
    }

    /// The Schur complement S = K_CC − K_CF K_FF⁻¹ K_FC, n_c × n_c, both triangles.
    pub fn schur(&self) -> MatRef<'_, f64> {
        self.condensation.schur.as_ref()
    }
}

/// The minimiser of ½ xᵀSx − bᵀx over x ≥ 0 for a dense S = `matrix` and b = `load`: 0 exactly where it
/// touches. `floating` lists the unknowns of each block on which S is singular. Where Sx − b may be at most `spans`,
/// as in [`Problem`], x is of any sign.
///
/// # Errors
/// A matrix that is not positive definite, loads that point away from contact.
pub fn minimise_between(
    matrix: MatRef<'_, f64>,
    floating: &[Vec<usize>],
    load: &[f64],
    spans: &[f64],
) -> Result<Vec<f64>, ReferenceError> {
    let n = matrix.nrows();
    if load.len() != n || matrix.ncols() != n || floating.iter().flatten().any(|&i| i >= n) {
        return Err(ReferenceError::Malformed("load or floating does not match the matrix"));
    }
    check_finite("load", load)?;
    let lower = vec![0.0; n];
    let mut set = ActiveSet::new(matrix, floating, 0, spans, vec![true; n]);
    let mut x = set.minimise(load, &lower, 0.0)?;
    // What is not in contact may lie on the wrong side of 0 by rounding.
    for ((x, &active), &below) in x.iter_mut().zip(&set.active).zip(&set.below) {
        *x = match (active, below) {
            (true, _) => 0.0,
            (_, true) => x.min(0.0),
            _ => x.max(0.0),
        };
    }
    Ok(x)
}

/// Why there is no reference solution.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ReferenceError {
    /// The arrays do not describe a square matrix with a right-hand side and bounds.
    #[error("the reference solver was given arrays that do not fit: {0}")]
    Malformed(&'static str),
    /// An entry is infinite or not a number.
    #[error("{array}[{index}] is not finite")]
    NotFinite {
        /// Which array: `values`, `load`, `lower`, `solution`.
        array: &'static str,
        /// Position in it.
        index: usize,
    },
    /// The matrix is indefinite, or singular where only rounding could hide it.
    #[error("the stiffness matrix is not positive definite at unknown {unknown}")]
    NotPositiveDefinite {
        /// The unknown where the elimination broke down.
        unknown: usize,
    },
    /// Refinement does not converge: K_FF is singular but for rounding, or nearly so.
    #[error(
        "the stiffness matrix is singular to working precision: the last correction is {correction:e} of the solution"
    )]
    Singular {
        /// max |d_i| of the last pass over max |u_i|.
        correction: f64,
    },
    /// A floating component is pushed away from its obstacle: no minimum exists.
    #[error(
        "the component of unknown {unknown} is held by nothing and its load points away from contact"
    )]
    Unbounded {
        /// A contact unknown of that component.
        unknown: usize,
    },
    /// The active set did not settle.
    #[error("the active set did not settle in {steps} steps")]
    Cycling {
        /// Steps made.
        steps: usize,
    },
    /// The dense Schur complement would not fit into memory.
    #[error("{contact} contact unknowns are more than the {most} that fit a dense matrix")]
    TooManyContacts {
        /// n_c.
        contact: usize,
        /// The largest n_c that is tried.
        most: usize,
    },
    /// The factor does not fit into memory or its indices.
    #[error("the sparse factorisation is too large: {0:?}")]
    TooLarge(FaerError),
}

impl From<FaerError> for ReferenceError {
    fn from(error: FaerError) -> Self {
        Self::TooLarge(error)
    }
}
