//! A scene on the mesh that its setting asks for.

use signorini_problem::Problem;
use signorini_problem::progress::{note, waiting};
use signorini_scene::error::Result;
use signorini_scene::scene::Scene;
use signorini_solve::adaptive::{MeshOfScene, Promise, mesh_of_scene};

/// The problem; what holds on a refined mesh is said.
pub(super) fn problem_of(scene: &Scene) -> Result<Problem> {
    Ok(promised_problem_of(scene)?.0)
}

/// The same with what holds, where the setting has an error.
pub(super) fn promised_problem_of(scene: &Scene) -> Result<(Problem, Option<Promise>)> {
    let MeshOfScene { mesh, promise } = waiting("refining the mesh", || mesh_of_scene(scene))?;
    promise.iter().for_each(note);
    Ok((Problem::new(scene, mesh)?, promise))
}
