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
pub struct Grid {
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
    pub name: String,
    /// Squares over the height of the domain.
    pub n: Vec<u32>,
    pub errors: Vec<Errors>,
    /// ∫λ on each grid.
    pub force: Vec<f64>,
    /// Measured rates of h1, l2, flux: the least-squares slope over all grids.
    pub rates: [f64; 3],
    pub checks: Vec<Check>,
    #[serde(skip)]
    grid: &'static Grid,
}

/// A scene still to be refined, and on which grid.
type Plan = (PathBuf, &'static Grid);

/// The studies of the main job, the long ones first.
pub fn planned(root: &Path) -> Vec<Plan> {
    let folder = root.join("meshes/catalogue");
    let squares =
        SCENES.into_iter().rev().flat_map(|name| SQUARES.iter().map(move |of| (name, of)));
    let all = squares.chain(TRAPEZOIDS.iter().map(|of| (ON_TRAPEZOIDS, of)));
    all.map(|(name, grid)| (folder.join(format!("{name}-tri.toml")), grid)).collect()
}

/// Runs the studies; calls `done` after each.
pub fn run(plans: &[Plan], done: impl Fn() + Sync) -> Result<Vec<ConvergenceStudy>> {
    let mut studies = on_two_threads(plans, |(scene, grid)| refined(scene, grid), done)?;
    studies.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(studies)
}

impl Grid {
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

fn refined(scene: &Path, grid: &'static Grid) -> Result<ConvergenceStudy> {
    let stem = scene.file_stem().unwrap_or_default().to_string_lossy();
    let name = format!("{}, {}", stem.trim_end_matches("-tri"), grid.name);
    let scene = Scene::read(scene)?;
    let own = scene.setting.unwrap_or_default();
    let scene = Scene { setting: Some(Setting { element: grid.element, ..own }), ..scene };
    let (mut errors, mut force) = (Vec::new(), Vec::new());
    for n in LEVELS {
        let problem = Problem::new(&scene, (grid.mesh)(n))?;
        let options = Options { solver: SolverKind::Kernel, ..Options::default() };
        let solution = solve(&problem, &options)?;
        errors.extend(of_solution(&problem, &solution)?);
        force.push(solution.contact_force);
    }
    let rates = QUANTITIES.map(|(_, pick)| {
        let values: Vec<_> = errors.iter().map(|of| Some(pick(of))).collect();
        measured_rate(&widths(), &values).unwrap_or(f64::NAN)
    });
    let checks = grid.checks(&name, rates);
    Ok(ConvergenceStudy { name, n: LEVELS.to_vec(), errors, force, rates, checks, grid })
}

type Pick = fn(&Errors) -> f64;

/// The errors that are studied, in the order of their rates.
const QUANTITIES: [(&str, Pick); 3] = [
    ("Gradient error of u, unweighed: |u − u_h|₁", |errors| errors.h1),
    ("Mean-square error of u (L²): ‖u − u_h‖", |errors| errors.l2),
    ("Mean-square error of the flux (L²): ‖σ − σ_h‖", |errors| errors.flux),
];

fn widths() -> Vec<f64> {
    LEVELS.iter().map(|&n| 1.0 / f64::from(n)).collect()
}

/// The pictures: one per error on squares, one on trapezoids, with a curve per study.
pub fn plots(studies: &[ConvergenceStudy]) -> Vec<Chart> {
    let plot = |(at, bent): (usize, bool)| {
        let (title, pick) = QUANTITIES[at];
        let is_bent = |grid: &Grid| TRAPEZOIDS.iter().any(|of| of.name == grid.name);
        let on = studies.iter().filter(|study| is_bent(study.grid) == bent);
        let curves = on.map(|study| Curve {
            label: study.name.clone(),
            values: study.errors.iter().map(|errors| Some(pick(errors))).collect(),
            expected_rate: Some(study.grid.expected[at]),
            ..Curve::default()
        });
        let place = if bent { ", on trapezoids" } else { "" };
        Chart {
            title: format!("{title}{place}"),
            across: "mesh width h".to_owned(),
            at: widths(),
            strips: vec![Strip { curves: curves.collect(), ..Strip::default() }],
        }
    };
    let all = [false, true].into_iter().flat_map(|bent| (0..3).map(move |at| (at, bent)));
    all.map(plot).collect()
}
