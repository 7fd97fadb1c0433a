//! What helps to choose a step in time.

use signorini_files::digits::rounded;
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_session::tick::ScheduledTick;
use signorini_session::tick::half::Halved;
use signorini_solve::decay::{TimeConstants, time_constants};

const DIGITS: usize = 3;

/// Sentences on the time constants of a scene, and on what half the step would change in these `moments`; none of scenes that do not
/// step in time.
///
/// # Errors
/// A mesh that cannot be cut into triangles.
pub(super) fn step_advice(problem: &Problem, moments: &[ScheduledTick]) -> Result<Vec<String>> {
    let known = time_constants(problem)?.zip(problem.scene.step());
    let Some((TimeConstants { slowest, fastest }, step)) = known else { return Ok(Vec::new()) };
    let slowest = match slowest.is_finite() {
        // Rounded up, since it is guaranteed.
        true => format!("{} at most, guaranteed", rounded(slowest * 1.005, DIGITS, 0.0)),
        false => "unknown, since contact alone holds a part".to_owned(),
    };
    let constants = format!(
        "time constants with open contact: the slowest {slowest}; the fastest of the mesh about {}; a step is {step}",
        rounded(fastest, DIGITS, 0.0)
    );
    // A time between two ticks may have data that are not admissible: then there is nothing to compare.
    let halved = Halved::of(problem, moments).ok().flatten();
    let halved = halved.and_then(|halved| halved.sentence(&problem.scene));
    Ok([constants].into_iter().chain(halved).collect())
}
