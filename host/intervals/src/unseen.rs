//! Loads that a tick does not see: what quadrature misses of their integrals, next to its bound.

use signorini_certify::Evaluated;
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_scene::scene::{Field, Input};

/// How much may be missed of the integrals of loads in a tick, over its total, at most: in the base and for every input what is missed has an
/// oscillation, and the total is at least twice the sum of all.
pub(super) fn unseen(problem: &Problem) -> Result<f64> {
    let mut most = 0.0_f64;
    let is_load =
        |input: &Input| matches!(input.field.value, Field::Source | Field::Flux | Field::Limit);
    let inputs = problem.scene.inputs.iter().enumerate().filter(|(_, input)| is_load(input));
    for term in std::iter::once(0).chain(inputs.map(|(at, _)| at + 1)) {
        let alone = problem.left_with(&[term])?;
        if alone.loads.missed > 0.0 {
            let oscillation = Evaluated::of_term(&alone)?.oscillation;
            most = most.max(0.5 * alone.loads.missed / oscillation);
        }
    }
    Ok(most)
}
