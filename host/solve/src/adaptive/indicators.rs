//! The error bound as a sum over cells.
//!
//! ```text
//!   total² ≈ gap² + (2 osc)² = Σ_T η_T²,     η_T² = gap_T² + 4 osc_T²
//! ```
//! gap_T² holds the cell's own part and those of its sides on the boundary, contact and transfer laws included.

use crate::Solution;
use signorini_certify::oscillation::oscillation;
use signorini_problem::Problem;
use signorini_scene::error::Result;

/// An oscillation below this part of the bound is not looked for in the cells.
const SILENT: f64 = 1e-3;

/// η_T² of every cell, triangles first, in the scene's units.
///
/// # Errors
/// Data that are not finite.
pub fn squares(problem: &Problem, solution: &Solution) -> Result<Vec<f64>> {
    let mut squares = solution.certified.indicators.clone();
    // Rounding may leave a part of the gap below 0.
    squares.iter_mut().for_each(|square| *square = square.max(0.0));
    let matters = solution.bound.is_some_and(|bound| bound.oscillation > SILENT * bound.total);
    if matters {
        for (square, osc) in squares.iter_mut().zip(oscillations(problem)?) {
            *square += 4.0 * osc * osc;
        }
    }
    Ok(squares)
}

/// osc_T of every cell.
pub(super) fn oscillations(problem: &Problem) -> Result<Vec<f64>> {
    Ok(oscillation(problem)?.of_cells)
}
