//! Outputs of the evolution in time: the ends between which its bound has them.
//!
//! ```text
//!   |J(u) − J(s)| ≤ ‖j c^{−½}‖ ‖c^½(u − s)‖,     J(u) = ∫ j u
//! ```
//! of what materials store, j = c, and of a mean over one that stores everywhere, j = 1/|P|. s is that of the tick, and u has gone
//! through all its steps.

use super::answer::{Answered, OnMesh};
use super::values::{self, INTEGRATED, Value};
use signorini_certify::curved::followed;
use signorini_problem::Problem;
use signorini_problem::functional::of_cells;
use signorini_scene::error::Result;
use signorini_scene::scene::{Output, Quantity};

/// Roundings of the sums, next to their terms.
const ROUNDINGS: f64 = 512.0 * f64::EPSILON;

/// The ends of each declared output for the exact evolution, where ‖c^½(u − s)‖ is at most `distance`; nothing for outputs that it says
/// nothing of.
///
/// # Errors
/// Data that are not finite.
pub fn over_time(
    problem: &Problem,
    answer: &Answered,
    distance: f64,
) -> Result<Vec<Option<[f64; 2]>>> {
    let outputs = &problem.scene.outputs;
    if !outputs.iter().any(|output| output.quantity.is_inside()) {
        return Ok(vec![None; outputs.len()]);
    }
    let deviations = followed(problem, &answer.certified.admissible())?;
    let on = OnMesh { problem, answer: *answer, deviations: &deviations };
    let integrated = if deviations.found.is_empty() { 0.0 } else { INTEGRATED };
    let ends = |output: &Output| {
        let weights = of_cells(problem, output);
        let off = norm(problem, output, &weights) * distance;
        if weights.is_empty() || !off.is_finite() {
            return Ok(None);
        }
        let Value { value, terms, .. } = values::inside(&on, &weights)?;
        let off = off + (ROUNDINGS + integrated) * terms;
        Ok(Some([value - off, value + off]))
    };
    outputs.iter().map(ends).collect()
}

/// ‖j c^{−½}‖, ∞ where j weighs a cell that stores nothing.
fn norm(problem: &Problem, output: &Output, weights: &[f64]) -> f64 {
    let square = |(at, &weight): (usize, &f64)| match output.quantity {
        // ∫_T c²/c
        Quantity::Content => weight,
        _ if weight == 0.0 => 0.0,
        _ => {
            let sides = problem.topology.edges_of(at).len() as f64;
            weight * weight / (sides * problem.capacities.get(at).copied().unwrap_or(0.0))
        }
    };
    weights.iter().enumerate().map(square).sum::<f64>().sqrt()
}
