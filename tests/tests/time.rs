//! Steps in time against exact solutions whose contact opens, closes and travels: rates in h and dt.

use signorini_tolerances::some;
use std::path::Path;

use signorini_problem::{Problem, State};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::mesh::{self, Mesh};
use signorini_scene::scene::Scene;
use signorini_session::tick::{Budget, play, schedule};
use signorini_session::with_session;
use signorini_solve::Solution;
use signorini_solve::norms::errors;
use signorini_tolerances::twins::STORED;

use crate::standard::posed;

/// A scene of the catalogue, with more of it.
fn catalogue(name: &str, more: &str) -> Result<Scene> {
    let path = format!("{}/../meshes/time/{name}-tri.toml", env!("CARGO_MANIFEST_DIR"));
    let path = Path::new(&path);
    let text = std::fs::read_to_string(path).expect("a scene of the catalogue");
    Scene::parse(&(text + more), path)
}

/// ‖u − u_h‖ at the ends of steps of length `dt` up to `end`, from the exact u at the start: the largest, and the last.
fn errors_in_time(name: &str, mesh: Mesh, dt: f64, end: f64) -> Result<[f64; 2]> {
    let scene = catalogue(name, "[setting]\ncertificate = false\nmodel = \"full\"\n")?;
    let problem = Problem::new(&scene, mesh)?;
    let exact = scene.exact.clone().expect("it is stated");
    let mean = |edge: usize| {
        let points = signorini_problem::quadrature::gauss(8);
        let of = |[t, weight]: &[f64; 2]| {
            let [x, y] = problem.along(edge, *t);
            weight * exact.u.value.eval(x, y, 0.0)
        };
        points.iter().map(of).sum::<f64>()
    };
    let start: Vec<f64> = (0..problem.ends.len()).map(mean).collect();
    let mut found = [0.0_f64; 2];
    stepped(&problem, start, (dt, (end / dt).round() as u32), |problem, solution| {
        let last = errors(&exact, problem, &solution.u, &solution.flux)?.l2;
        found = [found[0].max(last), last];
        Ok(())
    })?;
    Ok(found)
}

/// Looks at each of so many steps from these means.
fn stepped(
    problem: &Problem,
    u: Vec<f64>,
    (dt, steps): (f64, u32),
    mut look: impl FnMut(&Problem, &Solution) -> Result<()>,
) -> Result<()> {
    let posed = problem.stepping(dt, State { u, ..State::default() })?;
    let mut problem = posed.clone();
    with_session(&posed, |session| {
        for step in 1..=steps {
            problem.set_time(f64::from(step) * dt)?;
            session.play(&problem)?;
            let solution = session.answer(&problem)?;
            look(&problem, &solution)?;
            problem.advance(solution.state());
        }
        Ok(())
    })
}

/// The fluxes out of a cell add up to what it stores less ∫f.
#[test]
fn every_cell_is_in_balance() {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        let text = "mesh = \"grid\"\n[material.default]\nconductivity = [2, 0.5, 1]\ncapacity = \"1 + x^2\"\n[source]\nf = \"x - t\"\n\
             [boundary.dirichlet]\nkind = \"robin\"\ncoefficient = 2\nambient = \"y\"\n[boundary.contact]\nkind = \"contact\"\n\
             [setting]\ncertificate = false\nmodel = \"full\"\n";
        let problem = posed(text, grid(4, cells)).unwrap();
        let start = vec![0.25; problem.ends.len()];
        stepped(&problem, start, (0.01, 5), |problem, solution| {
            let stored: f64 = problem.stored(0, &solution.u).iter().sum();
            let defect = solution.conservation_defect(problem) * solution.largest_flux();
            STORED.check("balance", defect / stored.abs().max(1.0));
            Ok(())
        })
        .unwrap();
    }
}

fn rate([coarse, fine]: [f64; 2]) -> f64 {
    (coarse / fine).log2()
}

/// With dt ~ h² the error falls like h², on triangles and quads.
#[test]
fn errors_fall_like_the_square_of_h() {
    let solutions = [("breathing", 0.625), ("travelling", 0.5), ("oscillating", 0.125)];
    let on = |of| [Cells::Triangles, Cells::Quads, Cells::Mixed].map(|cells| (of, cells));
    for ((name, until), cells) in some(4, solutions.into_iter().flat_map(on)) {
        let of = |n: u32| errors_in_time(name, grid(n, cells), 0.5 / f64::from(n * n), until);
        let all = [4, 8].map(|n| of(n).unwrap()[0]);
        println!("{name} {cells:?}: {all:?}, rate {:.2}", rate(all));
        assert!(rate(all) > 1.85, "{cells:?}: {all:?}");
    }
}

/// The implicit Euler method is of first order in dt, also where contact changes.
#[test]
fn errors_fall_like_dt() {
    for (name, least) in [("breathing", 0.9), ("travelling", 0.85)] {
        let of = |dt: f64| errors_in_time(name, grid(16, Cells::Triangles), dt, 0.75);
        let all = [0.125, 0.0625].map(|dt| of(dt).unwrap()[0]);
        println!("{all:?}, rate {:.2}", rate(all));
        assert!(rate(all) > least, "{all:?}");
    }
}

/// Data jump at the start of the release: its error is of first order in dt once that has faded.
#[test]
fn the_release_of_contact_is_found_in_time() {
    let column = || mesh::read(&catalogue("release", "").unwrap().mesh.value).unwrap();
    let all = [0.02, 0.01].map(|dt| errors_in_time("release", column(), dt, 0.4).unwrap()[1]);
    println!("{all:?}, rate {:.2}", rate(all));
    assert!(rate(all) > 0.9, "{all:?}");
}

/// The bound over time against the error of the evolution, whose data the ticks of the release hold as they are.
#[test]
fn the_bound_over_time_is_above_the_error_of_the_release() {
    let scene = catalogue("release", "").unwrap();
    let problem = Problem::new(&scene, mesh::read(&scene.mesh.value).unwrap()).unwrap();
    let moments = schedule::moments_after(&scene, Some(12), None).unwrap();
    let budget = Budget { intervals: false, ..Budget::of(&scene) };
    let ticks = play(&problem, None, &moments, &budget, |_, _| Ok(())).unwrap();
    let ratios: Vec<f64> = ticks[1..]
        .iter()
        .map(|tick| tick.window.unwrap()[0] / tick.window_error.unwrap())
        .collect();
    println!("{ratios:.2?}");
    assert!(ratios.iter().all(|ratio| (1.0..2.0).contains(ratio)), "{ratios:?}");
}
