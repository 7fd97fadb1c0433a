//! Nested iteration: where a mesh is refined, multigrid starts from its answer on the mesh that is refined twice less.
//!
//! That mesh has a sixteenth of the unknowns, and most of the search for the active set is done there.

use signorini_problem::{Parts, Problem};
use signorini_scene::mesh::adaptive::coarsened;

use super::Options;
use super::carried::Old;
use super::conclude::{Attempt, Task};
use super::minimised::minimised;
use signorini_multigrid::Settings;

/// Cells of the fine mesh in each coarse one.
const CHILDREN: usize = 16;
/// Digits of the coarse answer: it differs from the fine one by more.
const ROUGHLY: Settings = Settings { tolerance: 1e-6, accuracy: 1e-3, most_iterations: 300 };

/// u to begin with on every unknown edge of `problem`; nothing where its mesh is no refinement of one on which there is an answer.
pub(super) fn start(problem: &Problem) -> Option<Vec<f64>> {
    if problem.loads.step.is_some() {
        return None;
    }
    let mesh = coarsened(&coarsened(&problem.mesh)?)?;
    let mut coarse = Problem::new(&problem.scene, mesh).ok()?;
    if problem.time != coarse.time {
        coarse.set_time(problem.time).ok()?;
    }
    let nested = start(&coarse).unwrap_or_default();
    let (parts, options) = (&Parts::examine(&coarse).ok()?, &Options::default());
    let task = Task { problem: &coarse, parts, options, start: &nested, is_posed: true };
    let found = minimised(&Attempt::<f64>::new(&task).ok()?, &ROUGHLY).ok()?.ok()?;
    let mut u = found.u;
    u.extend_from_slice(&coarse.loads.dirichlet);
    let gap = |at: usize| coarse.loads.gap[at];
    Some(Old { problem: &coarse, u: &u, gap: &gap }.carried(problem, |cell, _| cell / CHILDREN))
}
