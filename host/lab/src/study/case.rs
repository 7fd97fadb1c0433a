//! One standard scene: kernel in both scalars against the reference, errors, cost, picture.

use std::path::Path;

use serde::Serialize;

use super::bound::Certified;
use super::checks::{self, Check};
use super::cost::{self, Cost};
use super::outputs::KnownOutputs;
use crate::cycles::counted;
use crate::mesh_solution::solve_directly;
use signorini_problem::Problem;
use signorini_scene::{Result, Scene};
use signorini_solve::adaptive::mesh_of_scene;
use signorini_solve::{Options, ScalarKind, Solution, solve};

#[derive(Debug, Clone, Serialize)]
pub struct KnownScene {
    pub name: String,
    pub title: String,
    pub cells: [usize; 2],
    pub unknowns: usize,
    /// Active contact edges, and all of them.
    pub contact: [usize; 2],
    /// ∫_C (σ·n − q)
    pub force: f64,
    /// ‖A^½∇_h u_h‖
    pub energy: f64,
    pub f64: Run,
    pub f32: Run,
    pub outputs: KnownOutputs,
    pub checks: Vec<Check>,
}

/// The kernel in one scalar.
#[derive(Debug, Clone, Serialize)]
pub struct Run {
    /// Sweeps down to the rounding floor, the error bound there, and distances to the exact solution.
    #[serde(flatten)]
    pub certified: Certified,
    pub omega: f64,
    /// Largest distance to the reference, relative to the range of u.
    pub distance: f64,
    /// Cycles per unknown for the whole solve.
    pub solve_cycles: f64,
    pub cost: Cost,
}

/// Solves the scene at `path` three times and compares; its problem and the solution in f64 are there to be drawn.
pub fn study(path: &Path) -> Result<(Problem, Solution, KnownScene)> {
    let scene = Scene::read(path)?;
    let problem = Problem::new(&scene, mesh_of_scene(&scene)?.mesh)?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let reference = solve_directly(&problem)?;
    let (double, f64) = run(&problem, ScalarKind::F64, &reference)?;
    let (single, f32) = run(&problem, ScalarKind::F32, &reference)?;
    let mut checks = Vec::new();
    for (solution, run) in [(&double, &f64), (&single, &f32)] {
        checks.extend(checks::of(&name, &problem, solution, &reference));
        let subject = checks::subject(&name, solution.scalar);
        checks.extend(run.certified.when_converged(&subject, &problem, solution));
    }
    let (outputs, of_outputs) = KnownOutputs::new(&name, &problem, &double)?;
    checks.extend(of_outputs);
    let counts = problem.topology.counts;
    let case = KnownScene {
        name,
        title: scene.title.clone(),
        cells: [problem.mesh.triangles.len(), problem.mesh.quads.len()],
        unknowns: counts.unknowns(),
        contact: [double.contact_active, counts.contact],
        force: double.contact_force,
        energy: double.energy(&problem),
        f64,
        f32,
        outputs,
        checks,
    };
    Ok((problem, double, case))
}

/// The kernel down to the rounding floor.
fn run(problem: &Problem, scalar: ScalarKind, reference: &Solution) -> Result<(Solution, Run)> {
    let options = Options { scalar, to_the_floor: true, ..Options::default() };
    let (spent, solution) = counted(|| solve(problem, &options));
    let solution = solution?;
    let cost = match scalar {
        ScalarKind::F64 => cost::measure::<f64>(problem),
        ScalarKind::F32 => cost::measure::<f32>(problem),
    };
    let run = Run {
        certified: Certified::new(problem, &solution)?,
        omega: solution.omega,
        distance: checks::distance(&solution.u, &reference.u),
        solve_cycles: spent / problem.topology.counts.unknowns().max(1) as f64,
        cost: cost.unwrap_or_default(),
    };
    Ok((solution, run))
}
