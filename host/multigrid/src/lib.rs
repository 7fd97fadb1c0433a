//! The contact problem on a mesh in linear cost.
//!
//! ```text
//!   active set ─► r = b − Ku in f64 ─► correction in f32: conjugate gradients
//!       ▲                                 └─ Gauss–Seidel on edges, W-cycle on vertices
//!       └──────────── u + correction ◄────┘
//! ```
//! As long as the set changes a correction is only made to some digits, and the next set goes on from there. Once it has
//! settled, corrections follow each other until the residual is as small as is asked for, or as rounding allows.

mod active_set;
mod aggregation;
mod around;
mod coarsest;
mod conjugate;
mod edges;
mod hierarchy;
mod level;
mod lines;
mod problem;
mod prolongation;
mod relaxation;
mod row;
mod sectors;
mod solver;
mod sparse;
#[cfg(test)]
mod tests;
mod vertex_matrix;

use thiserror::Error;

pub use active_set::Side;
pub use problem::Problem;

use solver::Solver;

/// When the work ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Largest residual max |r_i|/K_ii, on contact edges that of complementarity, over the range of u and what is given.
    pub tolerance: f64,
    /// Largest error on the same scale, as the last correction tells it.
    pub accuracy: f64,
    /// Most iterations in all.
    pub most_iterations: usize,
}

/// The minimiser and how it was reached.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// u of the unknowns.
    pub u: Vec<f64>,
    /// The side of each contact edge.
    pub sides: Vec<Side>,
    /// Iterations of conjugate gradients in all.
    pub iterations: usize,
    /// The most iterations for one active set.
    pub longest: usize,
    /// Active sets.
    pub sets: usize,
}

/// Why there is no solution.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum Failure {
    /// Arrays that do not describe a contact problem.
    #[error("the arrays do not fit each other, or a row has no positive diagonal in first place")]
    Malformed,
    /// A row has more entries than a cell of either kind gives.
    #[error("a row of the matrix has {0} entries beside its own, expected at most 6")]
    TooWide(usize),
    /// Too many iterations.
    #[error(
        "no convergence in {iterations} iterations on {sets} active sets: scaled residual {residual:.1e}"
    )]
    Slow {
        /// Iterations made.
        iterations: usize,
        /// Active sets tried.
        sets: usize,
        /// Scaled residual then.
        residual: f64,
    },
    /// The preconditioner or the matrix is not positive definite in f32.
    #[error("breakdown after {iterations} iterations: scaled residual {residual:.1e}")]
    Breakdown {
        /// Iterations made.
        iterations: usize,
        /// Scaled residual then.
        residual: f64,
    },
}

/// Solves `problem` from `start`, one value an unknown; where it is empty from the middle of what is given, with all contact
/// edges touching.
///
/// # Errors
/// No convergence within `settings`.
pub fn solve(problem: &Problem, settings: &Settings, start: &[f64]) -> Result<Solution, Failure> {
    if !problem.fits() || !(start.is_empty() || start.len() == problem.unknowns()) {
        return Err(Failure::Malformed);
    }
    match problem.width() {
        ..=4 => Solver::<4>::new(problem, start).run(settings),
        5..=6 => Solver::<6>::new(problem, start).run(settings),
        wider => Err(Failure::TooWide(wider)),
    }
}
