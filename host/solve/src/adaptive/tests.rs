//! Goals, rates, starts and ends of adaptive solves.

use super::*;
use crate::norms;
use crate::{SolverKind, solve};
use signorini_problem::fixtures::limited::two_transitions;
use signorini_problem::fixtures::{SMOOTH, distorted, scene, with_four_sides};
use signorini_scene::mesh;
use signorini_scene::mesh::adaptive::refined;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::mesh::{Curve, Surface};
use signorini_tolerances::solve::{CARRIED, GUARANTEE};
use signorini_tolerances::{is_whole, some};

const KINDS: [Cells; 3] = [Cells::Triangles, Cells::Quads, Cells::Mixed];

fn wanted(goal: Goal) -> Wanted {
    let options = Options::by(SolverKind::Auto);
    Wanted { goal, most_unknowns: 60_000, options }
}

/// With the average of u_h for s: a better one gains most where cells are fine everywhere.
fn averaged(goal: Goal) -> Wanted {
    let wanted = wanted(goal);
    Wanted { options: Options { averages: true, ..wanted.options }, ..wanted }
}

/// The problem on a mesh refined everywhere, and its bound as a goal.
fn uniform(scene: &Scene, mesh: &Mesh, times: u32) -> (Problem, Goal) {
    let finer =
        (1..times).fold(refined(mesh).expect("finer"), |mesh, _| refined(&mesh).expect("finer"));
    let problem = Problem::new(scene, finer).expect("a problem");
    let solution = solve(&problem, &averaged(Goal::Part(1.0)).options).expect("a solution");
    (problem, Goal::Energy(solution.bound.expect("a bound").total))
}

/// N and bound of every level, and how it ended.
fn levels(scene: &Scene, mesh: Mesh, wanted: &Wanted) -> (Vec<[f64; 2]>, Level, Stop) {
    let mut found = Vec::new();
    let look = |level: &Level| {
        let bound = level.solution.bound.map_or(f64::NAN, |bound| bound.total);
        found.push([level.problem.topology.counts.unknowns() as f64, bound]);
        Ok(true)
    };
    let (last, stop) = refined_until(scene, mesh, wanted, look).expect("a solution");
    (found, last, stop)
}

/// The grid without its upper right quarter: a corner of 3π/2 at (0, ½), u_D on all of its boundary.
fn corner(n: u32, cells: Cells) -> Mesh {
    let mut mesh = grid(n, cells);
    let vertices = mesh.vertices.clone();
    let is_out = |cell: &[u32]| {
        let sum = cell.iter().fold([0.0; 2], |[x, y], &at| {
            let [a, b] = vertices[at as usize];
            [x + a, y + b]
        });
        let share = 1.0 / cell.len() as f64;
        sum[0] * share > 0.0 && sum[1] * share > 0.5
    };
    mesh.triangles.retain(|cell| !is_out(cell));
    mesh.quads.retain(|cell| !is_out(cell));
    let used = |at: u32| {
        let has = |cell: &[u32]| cell.contains(&at);
        mesh.triangles.iter().any(|cell| has(cell)) || mesh.quads.iter().any(|cell| has(cell))
    };
    let kept: Vec<u32> = (0..vertices.len() as u32).filter(|&at| used(at)).collect();
    let place = |at: u32| kept.iter().position(|&other| other == at).expect("kept") as u32;
    let mut sides = Vec::new();
    let mut count = |cell: &[u32]| {
        for (k, &a) in cell.iter().enumerate() {
            let b = cell[(k + 1) % cell.len()];
            sides.push([a.min(b), a.max(b)]);
        }
    };
    mesh.triangles.iter_mut().for_each(|cell| *cell = cell.map(place));
    mesh.quads.iter_mut().for_each(|cell| *cell = cell.map(place));
    mesh.triangles.iter().for_each(|cell| count(cell));
    mesh.quads.iter().for_each(|cell| count(cell));
    sides.sort_unstable();
    let alone = sides.chunk_by(|a, b| a == b).filter(|same| same.len() == 1).map(|same| same[0]);
    let edges = alone.collect();
    mesh.vertices = kept.iter().map(|&at| vertices[at as usize]).collect();
    mesh.curves = vec![Curve { name: "dirichlet".to_owned(), edges }];
    mesh.surfaces = Vec::<Surface>::new();
    mesh
}

/// u = r^{2/3} cos(2ω/3), ω from the middle of the corner.
fn singular() -> Scene {
    let [along, across] = ["(-(x+(y-0.5))/sqrt(2))", "((x-(y-0.5))/sqrt(2))"];
    let angle = format!("atan2({across}, {along})");
    let size = "(x^2+(y-0.5)^2)";
    let [p, q] = ["cos", "sin"].map(|of| format!("2/3*{size}^(-1/6)*{of}({angle}/3)"));
    let u = format!("{size}^(1/3)*cos(2*{angle}/3)");
    let text = format!(
        "mesh = \"grid\"
material.default.conductivity = \"1\"
boundary.dirichlet = {{ kind = \"dirichlet\", value = \"{u}\" }}
exact = {{ u = \"{u}\", gradient = [\"({q}-{p})/sqrt(2)\", \"(-{q}-{p})/sqrt(2)\"] }}
"
    );
    scene(&text).expect("a scene")
}

#[test]
fn the_bound_falls_as_it_would_without_the_corner() {
    // Quads are better than triangles, and take longer to show their rate.
    let parts = if is_whole() { [0.012, 0.008, 0.012] } else { [0.018; 3] };
    for (cells, part) in some(3, KINDS.into_iter().zip(parts)) {
        let goal = Goal::Part(part);
        let (levels, last, stop) = levels(&singular(), corner(4, cells), &wanted(goal));
        assert_eq!(stop, Stop::Reached);
        let rates: Vec<f64> = levels.iter().map(|[n, bound]| bound * n.sqrt()).collect();
        let end = &rates[rates.len() - 4..];
        let [least, most] = [f64::min, f64::max].map(|of| end.iter().copied().fold(end[0], of));
        assert!(most < 1.15 * least, "{cells:?}: {end:?}");
        let errors = norms::of_solution(&last.problem, &last.solution).expect("finite").expect("u");
        let bound = last.solution.bound.expect("a bound").total;
        let error = errors.combined.expect("of s and τ");
        GUARANTEE.check_at_most(format_args!("{cells:?}"), error, bound);
        assert!(goal.is_met(error, last.energy_norm));
    }
}

/// Never more unknowns than 1.3 times those of the mesh refined everywhere. On quads 1.4 times, and 1.5 times where u is like r^{3/2}:
/// their cuts are triangles, between which less of the oscillation cancels than in a row of quads.
#[test]
fn where_u_is_smooth_it_costs_what_refining_everywhere_does() {
    for (text, kind) in [(SMOOTH.to_owned(), 0), (two_transitions([-1.0, 2.0]), 1)] {
        let scene = scene(&text).expect("a scene");
        for cells in KINDS {
            let mesh = if kind == 0 { with_four_sides(grid(4, cells)) } else { grid(4, cells) };
            let (problem, goal) = uniform(&scene, &mesh, 2);
            let (levels, _, stop) = levels(&scene, mesh, &averaged(goal));
            let factor = if cells == Cells::Quads { [1.4, 1.5][kind] } else { 1.3 };
            let most = factor * problem.topology.counts.unknowns() as f64;
            assert_eq!(stop, Stop::Reached);
            assert!(levels[levels.len() - 1][0] <= most, "{cells:?}: {levels:?}");
        }
    }
}

/// On open edges s takes nothing of a curved gap, and cells may stay coarse there.
#[test]
fn a_curved_gap_is_followed_where_it_touches_alone() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../meshes/scenes/strip.toml");
    let scene = Scene::read(file.as_ref()).expect("a scene");
    let mesh = mesh::read(&scene.mesh.value).expect("a mesh");
    let (problem, goal) = uniform(&scene, &mesh, 1);
    let (levels, _, stop) = levels(&scene, mesh, &averaged(goal));
    assert_eq!(stop, Stop::Reached);
    assert!(levels[levels.len() - 1][0] < 0.5 * problem.topology.counts.unknowns() as f64);
}

/// u = 1 + 2x − y, which is exact on every mesh, as the element for quads is the one that has all affine functions.
fn affine() -> Scene {
    let text = SMOOTH
        .replace("-(4*y + 14*x + 2)", "0")
        .replace("x^2*y + y^2 + x^3", "1 + 2*x - y")
        .replace("y + y^2 - 1 + (3*y - 6.5)/(2+y)", "-1 - y - 3.5/2")
        .replace("coefficient = \"2+y\"", "coefficient = \"2\"")
        .replace("5*y + 6.5", "3.5")
        .replace("gap = \"x^3\"", "gap = \"1 + 2*x\"")
        .replace("-3.5*x^2 - 1", "-5");
    let text = &text[..text.find("exact = ").expect("an exact solution")];
    scene(&format!("{text}[setting]\nelement = \"nonparametric\"\n")).expect("a scene")
}

/// An affine u is carried as it is, through closures that are undone.
#[test]
fn a_start_is_the_old_solution_on_the_new_mesh() {
    let scene = affine();
    for cells in KINDS {
        let mut hierarchy =
            Hierarchy::new(with_four_sides(distorted(grid(3, cells)))).expect("one");
        let pose = |hierarchy: &Hierarchy| Problem::new(&scene, hierarchy.mesh().clone());
        let mut problem = pose(&hierarchy).expect("a problem");
        let options = wanted(Goal::Energy(1e-9)).options;
        for number in 0..4 {
            let level = Level::solved(number, problem, Instant::now(), &options, &[]);
            let level = level.expect("a solution");
            let marked: Vec<bool> =
                (0..level.problem.cells()).map(|cell| cell % 7 == number).collect();
            let carried = hierarchy.refine(&marked).expect("finer");
            problem = pose(&hierarchy).expect("a problem");
            let start = level.carried(&problem, &carried);
            for (edge, start) in start.iter().enumerate() {
                let [a, b] = problem.segment(edge);
                let exact = 1.0 + (a[0] + b[0]) - 0.5 * (a[1] + b[1]);
                CARRIED.check(format_args!("{cells:?}, edge {edge}"), start - exact);
            }
        }
    }
}

/// Where a level is solved no better than its mesh deserves, fewer sweeps lead there than from nothing.
#[test]
fn a_level_starts_where_the_last_one_ended() {
    let scene = scene(&two_transitions([-1.0, 2.0])).expect("a scene");
    let sweeps =
        Options { solver: SolverKind::Kernel, tolerance: Some(1e-4), ..Options::default() };
    let goal = Wanted { options: sweeps, ..wanted(Goal::Energy(0.1)) };
    let mut seen = Vec::new();
    let look = |level: &Level| {
        let cold = solve(&level.problem, &sweeps)?;
        seen.push([level.solution.sweeps, cold.sweeps]);
        Ok(true)
    };
    refined_until(&scene, grid(6, Cells::Mixed), &goal, look).expect("a solution");
    assert!(seen.len() > 2 && seen[1..].iter().all(|[warm, cold]| warm < cold), "{seen:?}");
}

#[test]
fn every_end_is_told() {
    let smooth = scene(SMOOTH).expect("a scene");
    let mesh = || with_four_sides(grid(4, Cells::Mixed));
    let ended = |scene: &Scene, wanted: &Wanted| levels(scene, mesh(), wanted).2;
    let few = Wanted { most_unknowns: 300, ..wanted(Goal::Part(1e-3)) };
    assert!(matches!(ended(&smooth, &few), Stop::TooLarge { unknowns: 301.., most: 300 }));
    let (levels, _, stop) = levels(&affine(), mesh(), &wanted(Goal::Energy(1e-17)));
    let Stop::Stalled { term, .. } = stop else { panic!("{stop:?}: {levels:?}") };
    assert!(matches!(term, Term::Rounding | Term::Algebraic), "{term:?}");
    let jump = SMOOTH.replace("value = \"x^2*y + y^2 + x^3\"", "value = \"5 + sign(x - 0.3)\"");
    let jump = scene(&jump).expect("a scene");
    assert_eq!(ended(&jump, &wanted(Goal::Part(0.1))), Stop::NoBound);
    let look = |level: &Level| Ok(level.number < 1);
    let goal = wanted(Goal::Part(1e-3));
    let (last, stop) = refined_until(&smooth, mesh(), &goal, look).expect("a solution");
    assert_eq!((last.number, stop), (1, Stop::Interrupted));
}
