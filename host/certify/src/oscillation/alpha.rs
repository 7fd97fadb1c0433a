//! How little A conducts in a cell.

use crate::conductivity::{Conductivity, smallest_eigenvalue};
use signorini_problem::Problem;

/// A lower bound of the eigenvalues of A in a cell.
pub fn alpha(problem: &Problem, at: usize) -> f64 {
    let floors = Conductivity::of(problem, at).floors();
    floors.iter().map(smallest_eigenvalue).fold(f64::INFINITY, f64::min)
}
