//! A case as a user would pose it: a scene file and a mesh file, read, checked and solved.

use std::path::Path;
use std::sync::Arc;

use super::case::{Effort, ExtremeCase};
use crate::record_file::word;
use signorini_problem::Problem;
use signorini_scene::mesh::{Mesh, gmsh::write as msh};
use signorini_scene::{Error, Result, Scene};
use signorini_session::tick::{Budget, ScheduledTick, TickRecord, play};
use signorini_solve::adaptive::mesh_of_scene;
use signorini_solve::{Ending, Options, Solution, solve};

#[derive(Debug, Clone)]
pub struct Attempt {
    pub mesh: Arc<Mesh>,
    /// Edges not on D.
    pub unknowns: usize,
    /// The answer; of ticks how they ended and their sweeps alone.
    pub answer: Solution,
    /// The ticks, where ticks were asked for.
    pub ticks: Vec<TickRecord>,
}

/// Writes the files of the case into `folder` and solves what they say.
pub fn attempt(case: &ExtremeCase, folder: &Path) -> Result<Attempt> {
    let (path, mesh) = (folder.join("scene.toml"), folder.join("mesh.msh"));
    let write = |path: &Path, text: String| std::fs::write(path, text).map_err(Error::io(path));
    write(&path, case.posed.scene() + &setting(case))?;
    write(&mesh, msh::text(&case.posed.mesh()))?;
    let scene = Scene::read(&path)?;
    let problem = Problem::new(&scene, mesh_of_scene(&scene)?.mesh)?;
    let options =
        Options { scalar: case.scalar, max_sweeps: Some(case.most_sweeps()), ..Options::default() };
    let (answer, ticks) = match case.effort {
        Effort { ticks: 1.., .. } => ticks(case, &problem)?,
        Effort { omega: None, .. } => (solve(&problem, &options)?, Vec::new()),
        _ => (signorini_session::solve(&problem)?, Vec::new()),
    };
    Ok(Attempt { unknowns: problem.topology.counts.unknowns(), answer, ticks, mesh: problem.mesh })
}

/// A fixed ω is a setting of the scene.
fn setting(case: &ExtremeCase) -> String {
    let Some(omega) = case.effort.omega else { return String::new() };
    let scalar = word(&case.scalar);
    format!("[setting]\nomega = {omega:?}\nscalar = \"{scalar}\"\nmodel = \"full\"\n")
}

/// Ticks at t = 0, 1, 2, …; of the sweeps the most of one tick count.
fn ticks(case: &ExtremeCase, problem: &Problem) -> Result<(Solution, Vec<TickRecord>)> {
    let moment = |tick: u32| ScheduledTick { time: f64::from(tick), inputs: Vec::new() };
    let moments: Vec<ScheduledTick> = (0..case.effort.ticks).map(moment).collect();
    let budget = Budget {
        scalar: case.scalar,
        sweeps: case.most_sweeps(),
        error: 0.0,
        tolerance: None,
        intervals: false,
        shows_start: false,
    };
    let ticks = play(problem, None, &moments, &budget, |_, _| Ok(()))?;
    let worst = ticks.iter().find(|tick| tick.failed()).or(ticks.last());
    let answer = Solution {
        status: worst.map_or_else(Ending::default, |tick| tick.status),
        sweeps: ticks.iter().map(|tick| tick.sweeps).max().unwrap_or(0),
        ..Solution::default()
    };
    Ok((answer, ticks))
}
