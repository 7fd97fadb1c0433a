//! The kernel's matrix and law in the hands of [`signorini_multigrid`], in f64 whatever the scalar.

use signorini_multigrid::{Failure, Problem, Settings, Solution, solve};

use super::conclude::{Attempt, Task};
use super::{Reduced, unfit};
use signorini_problem::progress::stage;
use signorini_problem::scalar::{Scalar, widened};
use signorini_scene::error::Result;

/// The minimiser in f64, from the start of the attempt, or why there is none.
pub(super) fn minimised<R: Scalar>(
    attempt: &Attempt<R>,
    settings: &Settings,
) -> Result<std::result::Result<Solution, Failure>> {
    let Task { problem, parts, start, .. } = attempt.task;
    let unfit = unfit::<R>(&problem.scene);
    let (system, u) = (attempt.assembled.system().map_err(&unfit)?, attempt.started());
    let reduced = Reduced::new(problem, parts, &attempt.assembled, &u).map_err(&unfit)?;
    stage("conjugate gradients and multigrid");
    let unknowns = problem.topology.counts.unknowns();
    let (lower, spans) = (system.law().lower(), system.law().spans().lengths());
    let (lower, spans) = (widened(lower), widened(spans));
    let given = ends(lower.iter().copied().chain(u[unknowns..].iter().map(|u| u.wide())));
    let rows = system.matrix().iter().zip(system.load());
    let loaded = rows.map(|(row, load)| load.wide().abs() / row.diagonal().wide());
    let posed = Problem {
        contact: reduced.problem(&lower, &spans),
        ends: &problem.ends,
        vertices: problem.mesh.vertices.len(),
        given: given.unwrap_or_default(),
        loaded: loaded.fold(0.0, f64::max),
    };
    let own = if start.is_empty() { Vec::new() } else { widened(&u[..unknowns]) };
    Ok(solve(&posed, settings, &own))
}

/// The least and the largest of all.
fn ends(all: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    all.map(|value| [value; 2]).reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
}
