//! Every exact solution by the kernel, through the host, and by the naive twin: both reproduce the target numbers and
//! the theory's rates, which proves either, and the table.

use std::path::Path;
use std::sync::Arc;

use signorini_scene::mesh::{Curve, Mesh, Surface};
use signorini_solve::norms;
use signorini_solve::{Options, solve};
use signorini_tests::contact;
use signorini_tests::exact::Exact;
use signorini_tests::field::{Point, constant};
use signorini_tests::flux::contact_force;
use signorini_tests::grid::{Cells, Grid};
use signorini_tests::norms::{Errors, errors};
use signorini_tests::problem::{Boundary, Kind, Problem};
use signorini_tests::targets::{
    ACTIVE, BENCHMARK, CATALOGUE, FLUX_OF_A, JUMPS, MOVED, TRANSFORMED, TabledCase, Target,
};
use signorini_tolerances::some;
use signorini_tolerances::twins::{CATALOGUE as WITHIN, RATE, TOTAL_FORCE, TRAPEZOID_RATE};

use crate::standard::posed;

/// A problem of the tables.
#[derive(Clone, Copy, Debug)]
enum Case {
    Tabled(TabledCase),
    /// A jump of A by this factor.
    Jump(f64),
    /// T(s, κ) of another one.
    Transformed(f64, f64, TabledCase),
    /// B with x mirrored, no flux data on C to the left, sides Neumann.
    Mirrored,
    /// That of Ben Belgacem and Renard on the unit square, without an exact solution.
    Benchmark,
}

/// Numbers that the tables have.
struct Measured {
    errors: Errors,
    force: f64,
    active: usize,
    unknowns: usize,
}

/// Who solves a case on a grid.
type Solver = fn(Case, Grid) -> Measured;

fn catalogue(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../meshes/catalogue");
    std::fs::read_to_string(folder.join(format!("{name}-tri.toml"))).expect("a catalogue scene")
}

const MIRRORED: &str = r#"
mesh = "none.msh"
material.default.conductivity = 1
boundary.contact = { kind = "contact" }
boundary.top = { kind = "dirichlet", value = "-sqrt(x^2+y^2)^1.5*sin(1.5*atan2(y,x))" }
boundary.left = { kind = "neumann", flux = "1.5*sqrt(sqrt(x^2+y^2))*sin(0.5*atan2(y,x))" }
boundary.right = { kind = "neumann", flux = "-1.5*sqrt(sqrt(x^2+y^2))*sin(0.5*atan2(y,x))" }
exact.u = "-sqrt(x^2+y^2)^1.5*sin(1.5*atan2(y,x))"
exact.gradient = ["-1.5*sqrt(sqrt(x^2+y^2))*sin(0.5*atan2(y,x))", "-1.5*sqrt(sqrt(x^2+y^2))*cos(0.5*atan2(y,x))"]
"#;

const BENCHMARK_SCENE: &str = r#"
mesh = "none.msh"
material.default.conductivity = 1
source.f = "2*pi*sin(2*pi*x)"
boundary.contact = { kind = "contact" }
boundary.top = { kind = "dirichlet", value = 0 }
boundary.default = { kind = "neumann", flux = 0 }
"#;

impl Case {
    /// The scene file.
    fn text(self) -> String {
        match self {
            Self::Tabled(TabledCase::A) => catalogue("a"),
            Self::Tabled(TabledCase::B) => catalogue("b"),
            Self::Tabled(TabledCase::H) => catalogue("h"),
            Self::Tabled(TabledCase::HGap) => catalogue("hg"),
            Self::Jump(k) => catalogue("j100")
                .replace("(100)", &format!("({k})"))
                .replace("conductivity = \"100\"", &format!("conductivity = \"{k}\""))
                .replace("sqrt(100)", &format!("sqrt({k})")),
            Self::Transformed(_, _, TabledCase::A) => catalogue("t-a"),
            Self::Transformed(..) => catalogue("t-h"),
            Self::Mirrored => MIRRORED.to_owned(),
            Self::Benchmark => BENCHMARK_SCENE.to_owned(),
        }
    }

    /// The curve of the scene on which a point of the boundary lies.
    fn curve(self, [x, y]: Point) -> &'static str {
        match (self, x, y) {
            (.., 0.0) => "contact",
            (Self::Mirrored, -1.0, _) => "left",
            (Self::Mirrored, 1.0, _) => "right",
            (Self::Benchmark, _, 0.0..1.0) => "side",
            (Self::Mirrored | Self::Benchmark, ..) => "top",
            _ => "dirichlet",
        }
    }

    /// The exact solution, where there is one.
    fn exact(self) -> Option<Exact> {
        Some(match self {
            Self::Tabled(case) => case.exact(),
            Self::Jump(k) => Exact::jump(k),
            Self::Transformed(s, kappa, case) => case.exact().transformed(s, kappa),
            Self::Mirrored => Exact::b_mirrored(),
            Self::Benchmark => return None,
        })
    }
}

/// The twins' grid as the host holds meshes, with the curves of a case.
fn mesh(grid: &Grid, case: Case) -> Mesh {
    let mut curves: Vec<Curve> = Vec::new();
    for edge in grid.boundary() {
        let [a, b] = grid.ends(edge);
        let name = case.curve([(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0]);
        let at = curves.iter().position(|curve| curve.name == name).unwrap_or_else(|| {
            curves.push(Curve { name: name.to_owned(), edges: Vec::new() });
            curves.len() - 1
        });
        curves[at].edges.push([edge.0, edge.1]);
    }
    let surface = |(name, is_left): (&str, bool)| {
        let on_side = |cell: &u32| {
            let corners = grid.cell(*cell as usize);
            let sum: f64 = corners.iter().map(|&v| grid.vertices[v as usize][0]).sum();
            (sum < 0.0) == is_left
        };
        let cells = (0..grid.cell_count() as u32).filter(on_side).collect();
        Surface { name: name.to_owned(), cells }
    };
    Mesh {
        vertices: grid.vertices.clone(),
        triangles: grid.triangles.clone(),
        quads: grid.quads.clone(),
        surfaces: [("left", true), ("right", false)].map(surface).into(),
        curves,
    }
}

fn by_kernel(case: Case, grid: Grid) -> Measured {
    let problem = posed(&case.text(), mesh(&grid, case)).expect("scene and mesh fit");
    let solution = solve(&problem, &Options::default()).expect("a solution exists");
    assert!(solution.converged(), "{:?}", solution.status);
    let errors = problem.scene.exact.as_ref().map_or(Ok(norms::Errors::default()), |exact| {
        norms::errors(exact, &problem, &solution.u, &solution.flux)
    });
    let norms::Errors { h1, l2, flux, energy, .. } = errors.expect("a finite exact solution");
    Measured {
        errors: Errors { h1, l2, flux, energy },
        force: solution.contact_force,
        active: solution.contact_active,
        unknowns: problem.topology.counts.unknowns(),
    }
}

/// The twin's problem without an exact solution: u = 0 on top, no flux on the sides, contact below.
fn benchmark(grid: Grid) -> Problem {
    let condition = |y: f64| match y {
        0.0 => Boundary::Contact { gap: constant(0.0), flux: constant(0.0) },
        1.0 => Boundary::Dirichlet { value: constant(0.0) },
        _ => Boundary::Neumann { flux: constant(0.0) },
    };
    let height = |e| grid.ends(e).iter().map(|p| p[1]).sum::<f64>() / 2.0;
    let boundary = grid.boundary().into_iter().map(|e| (e, condition(height(e)))).collect();
    let tau = 2.0 * std::f64::consts::PI;
    let tensor = Arc::new(|_, _| [1.0, 0.0, 1.0]);
    let source = Arc::new(move |_, [x, _]: Point| tau * (tau * x).sin());
    Problem { boundary, grid, tensor, source, order: 8 }
}

fn by_twin(case: Case, grid: Grid) -> Measured {
    let exact = case.exact();
    let problem = match &exact {
        Some(exact) => Problem::of_exact(exact, grid, |point| match case.curve(point) {
            "contact" => Kind::Contact,
            "left" | "right" => Kind::Neumann,
            _ => Kind::Dirichlet,
        }),
        None => benchmark(grid),
    };
    let solution = contact::solve(&problem.system()).expect("the scene has exactly one solution");
    let dirichlet = problem.boundary.values().filter(|b| matches!(b, Boundary::Dirichlet { .. }));
    Measured {
        errors: exact.map_or(Errors::default(), |exact| errors(&problem, &solution, &exact)),
        force: contact_force(&problem, &solution),
        active: solution.active.len(),
        unknowns: problem.grid.edges().len() - dirichlet.count(),
    }
}

/// Asserts the numbers of a case of the catalogue.
fn check(by: Solver, target: &Target) -> Errors {
    let Target { cells, case, n, h1, l2, force } = *target;
    let what = format!("{case:?} on {cells:?}, n = {n}");
    let Measured { errors, force: found, active, .. } =
        by(Case::Tabled(case), Grid::catalogue(n, cells));
    WITHIN.check_relative(format_args!("h1 of {what}"), errors.h1, h1);
    WITHIN.check_relative(format_args!("l2 of {what}"), errors.l2, l2);
    TOTAL_FORCE.check_relative(&what, found, force);
    let tabled = ACTIVE.iter().find(|(of, _)| *of == case && cells == Cells::Triangles);
    if let Some((_, expected)) = tabled {
        assert_eq!(active, expected[n.ilog2() as usize - 3], "{what}");
    }
    if case == TabledCase::A && n == 32 {
        let flux = FLUX_OF_A.iter().find(|(of, _)| *of == cells);
        WITHIN.check_relative(&what, errors.flux, flux.expect("both cells are listed").1);
    }
    errors
}

fn check_jumps(by: Solver) {
    for (k, energy, force) in JUMPS {
        let found = by(Case::Jump(k), Grid::catalogue(32, Cells::Triangles));
        WITHIN.check_relative(format_args!("J({k})"), found.errors.energy, energy);
        WITHIN.check_relative(format_args!("J({k})"), found.force, force);
    }
}

/// Oblique and stretched tensors; `has_scene`: those alone that there is a scene of.
fn check_transformed(by: Solver, has_scene: bool) {
    let rows = TRANSFORMED.into_iter().filter(|row| row.4.is_some() || !has_scene);
    for (s, kappa, case, n, energy, force) in rows {
        let grid = Grid::catalogue(n, Cells::Triangles);
        let found = by(Case::Transformed(s, kappa, case), grid);
        WITHIN.check_relative(format_args!("T({s}, {kappa})"), found.force, force);
        if let Some(energy) = energy {
            WITHIN.check_relative(format_args!("T({s}, {kappa})"), found.errors.energy, energy);
        }
    }
}

fn check_moved(by: Solver, most: u32) {
    for (cells, n, unknowns, [h1, l2, flux]) in MOVED.into_iter().filter(|row| row.1 <= most) {
        let found = by(Case::Mirrored, Grid::catalogue(n, cells).moved_smoothly());
        assert_eq!(found.unknowns, unknowns);
        let what = format!("moved {cells:?}, n = {n}");
        WITHIN.check_relative(&what, found.errors.h1, h1);
        WITHIN.check_relative(&what, found.errors.l2, l2);
        WITHIN.check_relative(&what, found.errors.flux, flux);
    }
}

/// Orders of the errors on quads that stay trapezoids along the boundary: the parametric element loses half an order in the
/// gradient and one in u, the recovered flux loses nothing: shown, not hidden. What becomes of it where all of them do, and
/// what helps, is in `bound/nonparametric.rs`.
fn check_trapezoids(by: Solver) {
    let [coarse, fine] = [16, 32].map(|n| {
        by(Case::Mirrored, Grid::catalogue(n, Cells::Quads).moved_to_trapezoids(n)).errors
    });
    let rate = |pick: fn(&Errors) -> f64| (pick(&coarse) / pick(&fine)).log2();
    TRAPEZOID_RATE.check("h1", rate(|e| e.h1) - 0.5);
    TRAPEZOID_RATE.check("l2", rate(|e| e.l2) - 1.0);
    TRAPEZOID_RATE.check("flux", rate(|e| e.flux) - 1.0);
}

fn check_benchmark(by: Solver, most: u32) {
    for (n, force) in BENCHMARK.into_iter().filter(|row| row.0 <= most) {
        let grid = Grid::rectangle([0.0, 0.0], [1.0, 1.0], n, n, Cells::Triangles);
        let found = by(Case::Benchmark, grid).force;
        TOTAL_FORCE.check_relative(format_args!("benchmark, n = {n}"), found, force);
    }
}

/// −d log error / d log n over n = 8, 16, 32, 64.
fn slope(errors: [f64; 4]) -> f64 {
    let [a, b, c, d] = errors.map(f64::log2);
    (3.0 * (a - d) + (b - c)) / 10.0
}

#[test]
fn errors_forces_and_rates_by_the_kernel() {
    for row in some(3, CATALOGUE) {
        let found = row.map(|target| check(by_kernel, &target));
        let what = format!("{:?} on {:?}", row[0].case, row[0].cells);
        for (quantity, pick, rate) in [
            ("h1", (|e| e.h1) as fn(Errors) -> f64, 1.0),
            ("l2", |e| e.l2, 2.0),
            ("flux", |e| e.flux, 1.0),
        ] {
            RATE.check(format_args!("{quantity} of {what}"), slope(found.map(pick)) / rate - 1.0);
        }
    }
}

#[test]
fn errors_and_forces_by_the_twin_on_coarse_meshes() {
    for row in some(3, CATALOGUE) {
        // The third mesh tells the error of the flux with a source.
        let meshes = if row[0].case == TabledCase::A { 3 } else { 2 };
        for target in &row[..meshes] {
            check(by_twin, target);
        }
    }
}

#[test]
fn jumps_of_any_size() {
    [by_kernel, by_twin].into_iter().for_each(check_jumps);
}

#[test]
fn oblique_and_stretched_tensors() {
    check_transformed(by_kernel, true);
    check_transformed(by_twin, false);
}

#[test]
fn moved_grids() {
    check_moved(by_kernel, 64);
    check_moved(by_twin, 16);
}

#[test]
fn trapezoids_keep_the_rate_of_the_flux_only() {
    [by_kernel, by_twin].into_iter().for_each(check_trapezoids);
}

#[test]
fn benchmark_of_ben_belgacem_and_renard() {
    check_benchmark(by_kernel, 64);
    check_benchmark(by_twin, 32);
}
