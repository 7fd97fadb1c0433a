//! Rates: the catalogue's scenes on its own grids, refined.

use std::path::{Path, PathBuf};

use serde::Serialize;

use super::checks::Check;
use crate::error::Result;
use crate::mesh::structured::{Cells, grid};
use crate::norms::{Errors, of_solution};
use crate::problem::Problem;
use crate::report::{ConvergencePlot, ConvergenceSeries, measured_rate};
use crate::scene::Scene;
use crate::solve::{Options, SolverKind, solve};
use crate::threads::on_two_threads;

/// Catalogue scenes with boundary curves `contact` and `dirichlet`, refined up to 2·64 × 64.
const SCENES: [&str; 4] = ["a", "b", "h", "hg"];
const LEVELS: [u32; 4] = [8, 16, 32, 64];

/// One scene on one kind of cells, refined.
#[derive(Debug, Clone, Serialize)]
pub struct Study {
    /// Scene and cells.
    pub name: String,
    /// Squares over the height of the domain.
    pub n: Vec<u32>,
    /// Errors on each grid.
    pub errors: Vec<Errors>,
    /// ∫λ on each grid.
    pub force: Vec<f64>,
    /// Measured rates of h1, l2, flux: the least-squares slope over all grids.
    pub rates: [f64; 3],
    /// What was checked.
    pub checks: Vec<Check>,
}

/// A scene still to be refined.
#[derive(Debug, Clone)]
pub struct Plan {
    scene: PathBuf,
    cells: Cells,
}

/// The studies of the main job, the long ones first.
pub fn planned(root: &Path) -> Result<Vec<Plan>> {
    let folder = root.join("meshes/catalogue");
    let plans = SCENES.iter().rev().flat_map(|name| {
        let scene = folder.join(format!("{name}-tri.toml"));
        [Cells::Triangles, Cells::Quads].map(|cells| Plan { scene: scene.clone(), cells })
    });
    Ok(plans.collect())
}

/// Runs the studies; calls `done` after each.
pub fn run(plans: &[Plan], done: impl Fn() + Sync) -> Result<Vec<Study>> {
    let mut studies = on_two_threads(plans, Plan::run, done)?;
    studies.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(studies)
}

impl Plan {
    fn run(&self) -> Result<Study> {
        let scene = Scene::read(&self.scene)?;
        let cells = match self.cells {
            Cells::Triangles => "triangles",
            Cells::Quads => "quads",
            Cells::Mixed => "mixed",
        };
        let stem = self.scene.file_stem().unwrap_or_default().to_string_lossy();
        let name = format!("{}, {cells}", stem.trim_end_matches("-tri"));
        let (mut found, mut force) = (Vec::new(), Vec::new());
        for n in LEVELS {
            let problem = Problem::new(&scene, grid(n, self.cells))?;
            let options = Options { solver: SolverKind::Kernel, ..Options::default() };
            let solution = solve(&scene, &problem, &options)?;
            found.extend(of_solution(&scene, &problem, &solution)?);
            force.push(solution.contact_force);
        }
        let rates = QUANTITIES
            .map(|quantity| measured_rate(&quantity.series(&name, &found)).unwrap_or(f64::NAN));
        // The theory's rates are 1, 2, 1. The free points of H move against the grid, so that l2
        // scatters around its slope by up to a twelfth.
        let bounds = [
            ("|u − u_h|₁ falls with rate 1", 0.97),
            ("‖u − u_h‖ falls with rate 2", 1.85),
            ("‖σ − σ_h‖ falls with rate 1", 0.97),
        ];
        let checks = bounds.iter().zip(rates);
        let checks =
            checks.map(|(&(claim, bound), rate)| Check::at_least(&name, claim, rate, bound));
        let checks = checks.collect();
        Ok(Study { name, n: LEVELS.to_vec(), errors: found, force, rates, checks })
    }
}

/// An error that is studied.
struct Quantity {
    title: &'static str,
    /// The rate that theory gives.
    rate: f64,
    pick: fn(&Errors) -> f64,
}

const QUANTITIES: [Quantity; 3] = [
    Quantity { title: "Broken energy error |u − u_h|₁", rate: 1.0, pick: |e| e.h1 },
    Quantity { title: "L² error ‖u − u_h‖", rate: 2.0, pick: |e| e.l2 },
    Quantity { title: "Flux error ‖σ − σ_h‖", rate: 1.0, pick: |e| e.flux },
];

impl Quantity {
    fn series(&self, name: &str, errors: &[Errors]) -> ConvergenceSeries {
        ConvergenceSeries {
            label: name.to_owned(),
            h: LEVELS.iter().map(|&n| 1.0 / f64::from(n)).collect(),
            error: errors.iter().map(self.pick).collect(),
            expected_rate: self.rate,
        }
    }
}

/// The pictures: one an error, a curve a study.
pub fn plots(studies: &[Study]) -> Vec<ConvergencePlot> {
    let plot = |quantity: &Quantity| ConvergencePlot {
        title: quantity.title.to_owned(),
        series: studies.iter().map(|study| quantity.series(&study.name, &study.errors)).collect(),
    };
    QUANTITIES.iter().map(plot).collect()
}
