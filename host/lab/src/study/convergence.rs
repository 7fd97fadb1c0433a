//! Rates: the catalogue's scenes on its own grids, refined, and what they become on quads that keep the
//! shape of trapezoids.

use std::path::{Path, PathBuf};

use serde::Serialize;
use signorini_kernel::element::QuadElement::{self, Nonparametric, Parametric};

use super::checks::Check;
use signorini_draw::{Chart, Curve, Strip, measured_rate};
use signorini_problem::Problem;
use signorini_problem::threads::on_two_threads;
use signorini_scene::mesh::structured::Trapezoids::{Everywhere, InTwoRows};
use signorini_scene::mesh::structured::{Cells, grid, trapezoids};
use signorini_scene::{Mesh, Result, Scene, Setting};
use signorini_solve::norms::{Errors, of_solution};
use signorini_solve::{Options, SolverKind, solve};

/// Catalogue scenes with boundary curves `contact` and `dirichlet`, refined up to 2·64 × 64.
const SCENES: [&str; 4] = ["a", "b", "h", "hg"];
const LEVELS: [u32; 4] = [8, 16, 32, 64];

/// The scene that shows what trapezoids do.
const ON_TRAPEZOIDS: &str = "b";

/// The grid that a scene is refined on.
#[derive(Debug)]
struct Grid {
    name: &'static str,
    mesh: fn(u32) -> Mesh,
    element: QuadElement,
    /// Rates of h1, l2 and flux that theory gives. On trapezoids the parametric element lacks a linear function:
    /// its error is of the size of ∇u there, √h of it where they fill two rows.
    expected: [f64; 3],
}

const FULL: [f64; 3] = [1.0, 2.0, 1.0];
const HALF: [f64; 3] = [0.5, 1.0, 1.0];
const NONE: [f64; 3] = [0.0; 3];

const fn on(
    name: &'static str,
    mesh: fn(u32) -> Mesh,
    element: QuadElement,
    expected: [f64; 3],
) -> Grid {
    Grid { name, mesh, element, expected }
}

static SQUARES: [Grid; 2] = [
    on("triangles", |n| grid(n, Cells::Triangles), Parametric, FULL),
    on("quads", |n| grid(n, Cells::Quads), Parametric, FULL),
];

static TRAPEZOIDS: [Grid; 4] = [
    on("two rows of trapezoids", |n| trapezoids(n, InTwoRows), Parametric, HALF),
    on("two rows of trapezoids, nonparametric", |n| trapezoids(n, InTwoRows), Nonparametric, FULL),
    on("trapezoids", |n| trapezoids(n, Everywhere), Parametric, NONE),
    on("trapezoids, nonparametric", |n| trapezoids(n, Everywhere), Nonparametric, FULL),
];

/// One scene on one kind of cells, refined.
#[derive(Debug, Clone, Serialize)]
pub struct ConvergenceStudy {
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
    /// The checks.
    pub checks: Vec<Check>,
    #[serde(skip)]
    grid: &'static Grid,
}

/// A scene still to be refined.
#[derive(Debug, Clone)]
pub struct ConvergencePlan {
    scene: PathBuf,
    grid: &'static Grid,
}

/// The studies of the main job, the long ones first.
pub fn planned(root: &Path) -> Vec<ConvergencePlan> {
    let folder = root.join("meshes/catalogue");
    let scene = |name: &str| folder.join(format!("{name}-tri.toml"));
    let on = |name, grid| ConvergencePlan { scene: scene(name), grid };
    let squares = SCENES.iter().rev().flat_map(|name| SQUARES.iter().map(move |grid| (name, grid)));
    let squares = squares.map(|(name, grid)| on(name, grid));
    squares.chain(TRAPEZOIDS.iter().map(|grid| on(ON_TRAPEZOIDS, grid))).collect()
}

/// Runs the studies; calls `done` after each.
pub fn run(plans: &[ConvergencePlan], done: impl Fn() + Sync) -> Result<Vec<ConvergenceStudy>> {
    let mut studies = on_two_threads(plans, ConvergencePlan::run, done)?;
    studies.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(studies)
}

impl Grid {
    /// Checks of the rates.
    fn checks(&self, name: &str, [h1, l2, flux]: [f64; 3]) -> Vec<Check> {
        let claim = "the mean-square error of the flux ‖σ − σ_h‖ falls with rate 1";
        let flux = Check::at_least(name, claim, flux, 0.97);
        match self.expected {
            HALF => {
                let half = "the gradient error |u − u_h|₁ of the parametric element falls with rate ½ on two rows of trapezoids";
                let one = "the mean-square error of u ‖u − u_h‖ of the parametric element falls with rate 1 on two rows of trapezoids";
                vec![
                    Check::between(name, half, h1, [0.45, 0.55]),
                    Check::between(name, one, l2, [0.9, 1.1]),
                    flux,
                ]
            }
            NONE => {
                let claim = "the parametric element does not converge on trapezoids: rate of the gradient error \
                             |u − u_h|₁";
                vec![Check::at_most(name, claim, h1.abs(), 0.1)]
            }
            // The free points of H move against the grid, so that l2 scatters around its slope by up to
            // a twelfth.
            _ => vec![
                Check::at_least(name, "the gradient error |u − u_h|₁ falls with rate 1", h1, 0.97),
                Check::at_least(
                    name,
                    "the mean-square error of u ‖u − u_h‖ falls with rate 2",
                    l2,
                    1.85,
                ),
                flux,
            ],
        }
    }
}

impl ConvergencePlan {
    fn run(&self) -> Result<ConvergenceStudy> {
        let Self { scene, grid } = self;
        let stem = scene.file_stem().unwrap_or_default().to_string_lossy();
        let name = format!("{}, {}", stem.trim_end_matches("-tri"), grid.name);
        let scene = Scene::read(scene)?;
        let own = scene.setting.unwrap_or_default();
        let scene = Scene { setting: Some(Setting { element: grid.element, ..own }), ..scene };
        let (mut found, mut force) = (Vec::new(), Vec::new());
        for n in LEVELS {
            let problem = Problem::new(&scene, (grid.mesh)(n))?;
            let options = Options { solver: SolverKind::Kernel, ..Options::default() };
            let solution = solve(&problem, &options)?;
            found.extend(of_solution(&problem, &solution)?);
            force.push(solution.contact_force);
        }
        let rate = |at: usize| {
            let series = QUANTITIES[at].series(&name, grid, &found);
            measured_rate(&widths(), &series.values).unwrap_or(f64::NAN)
        };
        let rates = [0, 1, 2].map(rate);
        let checks = grid.checks(&name, rates);
        let n = LEVELS.to_vec();
        Ok(ConvergenceStudy { name, n, errors: found, force, rates, checks, grid })
    }
}

/// An error that is studied.
struct Quantity {
    title: &'static str,
    /// Its place among the rates.
    place: usize,
    pick: fn(&Errors) -> f64,
}

const QUANTITIES: [Quantity; 3] = [
    Quantity { title: "Gradient error of u, unweighed: |u − u_h|₁", place: 0, pick: |e| e.h1 },
    Quantity { title: "Mean-square error of u (L²): ‖u − u_h‖", place: 1, pick: |e| e.l2 },
    Quantity {
        title: "Mean-square error of the flux (L²): ‖σ − σ_h‖", place: 2, pick: |e| e.flux
    },
];

impl Quantity {
    fn series(&self, name: &str, grid: &Grid, errors: &[Errors]) -> Curve {
        Curve {
            label: name.to_owned(),
            values: errors.iter().map(|errors| Some((self.pick)(errors))).collect(),
            expected_rate: Some(grid.expected[self.place]),
            ..Curve::default()
        }
    }
}

/// The mesh widths, from coarse to fine.
fn widths() -> Vec<f64> {
    LEVELS.iter().map(|&n| 1.0 / f64::from(n)).collect()
}

/// The pictures: one per error on squares, one on trapezoids, with a curve per study.
pub fn plots(studies: &[ConvergenceStudy]) -> Vec<Chart> {
    let plot = |quantity: &Quantity, bent: bool| {
        let is_bent = |grid: &Grid| TRAPEZOIDS.iter().any(|of| of.name == grid.name);
        let on = studies.iter().filter(|study| is_bent(study.grid) == bent);
        let series = on.map(|study| quantity.series(&study.name, study.grid, &study.errors));
        let place = if bent { ", on trapezoids" } else { "" };
        Chart {
            title: format!("{}{place}", quantity.title),
            across: "mesh width h".to_owned(),
            at: widths(),
            strips: vec![Strip { curves: series.collect(), ..Strip::default() }],
        }
    };
    let both = [false, true].into_iter();
    both.flat_map(|bent| QUANTITIES.iter().map(move |quantity| (quantity, bent)))
        .map(|(quantity, bent)| plot(quantity, bent))
        .collect()
}
