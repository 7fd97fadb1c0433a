//! The distance to the exact solution by half of the points: how far the rule may be trusted.

use super::Integrands;
use crate::admissible::Admissible;
use crate::curved;
use crate::sampled::{Lifted, Solution};
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_scene::scene::Exact;

/// [`super::Distance::combined`] with half of the points a direction.
///
/// # Errors
/// As for [`super::distance`].
pub fn of_fewer_points(exact: &Exact, problem: &Problem, admissible: &Admissible) -> Result<f64> {
    let deviations = &curved::followed(problem, admissible)?;
    let (u, lift) = (&Solution { exact, problem }, &Lifted { problem, deviations });
    Integrands { exact, problem, admissible, deviations, u, lift, panels: 1, fewer: 2 }.combined()
}
