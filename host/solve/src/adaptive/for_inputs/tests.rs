//! One mesh for all inputs: the promise tried with other inputs and another solver; what cannot be promised says why.

use super::*;
use crate::energy_norm;
use crate::solve;
use signorini_problem::fixtures::{SMOOTH, scene, with_four_sides};
use signorini_scene::goal::Goal;
use signorini_scene::mesh::structured::{Cells, grid};

fn levee(error: &str) -> Scene {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/scenes");
    let text = std::fs::read_to_string(folder.join("levee.toml")).expect("the levee");
    let file = folder.join("levee.toml");
    Scene::parse(&format!("{text}\n[setting]\nerror = \"{error}\"\n"), &file).expect("a scene")
}

fn marked(goal: Goal) -> Promised {
    Promised { goal, refining: Refining::Marked, most_unknowns: MOST_UNKNOWNS }
}

/// Numbers in (0, 1) without a pattern.
fn scatter(at: usize) -> f64 {
    ((at as f64 * 12.9898 + 0.3).sin() * 43_758.545_3).rem_euclid(1.0)
}

#[test]
fn other_inputs_meet_it_too() {
    let scene = levee("12%");
    let MeshOfScene { mesh, promise } = mesh_of_scene(&scene).expect("a mesh");
    let promise = promise.expect("what holds on it");
    assert!(promise.largest <= MARGIN && promise.allowed.len() == 1005, "{promise:?}");
    let problem = Problem::new(&scene, mesh).expect("a problem");
    assert_eq!(problem.topology.counts.unknowns(), promise.unknowns);
    let spaces = InputSpace::of(&scene);
    let options = Options::by(SolverKind::Direct);
    let mut largest = 0.0_f64;
    for number in 0..60 {
        let value = |(at, space): (usize, &InputSpace)| {
            let [lo, hi] = space.range;
            lo + (hi - lo) * scatter(7 * number + at)
        };
        let values: Vec<f64> = spaces.iter().enumerate().map(value).collect();
        let problem = problem.with_inputs(&values).expect("a problem");
        let solution = solve(&problem, &options).expect("a solution");
        let norm = energy_norm::of_solution(&problem, &solution).expect("finite");
        let bound = solution.bound.expect("a bound").total;
        largest = largest.max(promise.goal.ratio(bound, norm));
    }
    // Of a range in which u is small the bound of another solve is as large as the promise has it.
    assert!((0.5..=1.0).contains(&largest), "{largest}");
}

#[test]
fn without_inputs_it_is_the_mesh_of_the_same_goal() {
    let scene = scene(SMOOTH).expect("a scene");
    let mesh = || with_four_sides(grid(4, Cells::Mixed));
    let goal = Goal::Part(0.05);
    let (found, promise) = promised_mesh(&scene, mesh(), marked(goal)).expect("a mesh");
    let options = Options::by(SolverKind::Auto);
    let goal = Goal::Part(MARGIN * 0.05);
    let wanted = super::super::Wanted { goal, most_unknowns: MOST_UNKNOWNS, options };
    let (last, stop) =
        super::super::refined_until(&scene, mesh(), &wanted, |_| Ok(true)).expect("a solution");
    assert_eq!((stop, promise.allowed.len()), (Stop::Reached, 1));
    assert_eq!(found, *last.problem.mesh);
}

#[test]
fn an_error_that_no_mesh_has_is_refused_with_the_reason() {
    let jump = SMOOTH.replace("value = \"x^2*y + y^2 + x^3\"", "value = \"5 + sign(x - 0.3)\"");
    let mesh = with_four_sides(grid(4, Cells::Mixed));
    let error = promised_mesh(&scene(&jump).expect("a scene"), mesh, marked(Goal::Part(0.1)));
    let error = error.expect_err("u_D jumps").to_string();
    assert!(error.contains("setting.error = \"10%\""), "{error}");
    assert!(error.contains("nothing says where to refine"), "{error}");
}
