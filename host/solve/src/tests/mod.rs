//! Mixed precision and tuned relaxation on the standard scenes; hard problems.

mod auto;
mod bound;
mod hard;
mod level;
mod limits;
mod meshes;
mod multigrid;
mod relaxed;
mod stops;
mod stretched;
mod transfer;
mod zero;

use signorini_tolerances::solve::AGREEMENT;
use std::path::{Path, PathBuf};

use signorini_kernel::contact;
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::solver::{Settings, Status};

use super::{Mixed, Options, Solution, SolverKind, Trials, solve, tuned_omega, went_well};
use signorini_certify::exact::{self, Distance};
use signorini_problem::{Parts, Problem};
use signorini_scene::error::Result;
use signorini_scene::mesh;
use signorini_scene::scene::Scene;
use signorini_scene::setting::Precision;

/// A domain that nothing holds, in balance.
const LOOSE: &str = r#"
mesh = "grid"
material.default.conductivity = "1"
source.f = "x"
boundary.default = { kind = "neumann", flux = "0" }
"#;

fn meshes(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes").join(folder)
}

/// Those whose materials store nothing: the others have the steady states of these.
fn standard_scenes() -> impl Iterator<Item = PathBuf> {
    let files = ["catalogue", "scenes"].map(|folder| std::fs::read_dir(meshes(folder)).unwrap());
    let paths = files.into_iter().flatten().map(|entry| entry.unwrap().path());
    let scenes = paths.filter(|path| path.extension().is_some_and(|ending| ending == "toml"));
    scenes.filter(|path| Scene::read(path).is_ok_and(|scene| !scene.stores()))
}

fn read(path: &Path) -> Result<(Scene, Problem)> {
    let scene = Scene::read(path)?;
    let problem = Problem::new(&scene, mesh::read(&scene.mesh.value)?)?;
    Ok((scene, problem))
}

/// Largest difference, relative to the range of the reference.
fn distance(u: &[f64], reference: &[f64]) -> f64 {
    let low = reference.iter().copied().fold(f64::INFINITY, f64::min);
    let high = reference.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let far = u.iter().zip(reference).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    far / (high - low).max(f64::MIN_POSITIVE)
}

/// A solution, with the distance of its bound's s and τ from the exact one of the scene.
fn judged(problem: &Problem, options: &Options) -> Result<(Solution, Distance)> {
    let found = solve(problem, options)?;
    let exact = problem.scene.exact.as_ref().expect("an exact solution");
    let of = exact::distance(exact, problem, &found.certified.admissible())?;
    Ok((found, of))
}

/// u by sweeps in f32 on residuals in f64, and how many contact edges are active.
fn mixed(what: &str, problem: &Problem) -> Result<(Vec<f64>, usize)> {
    let mut prepared = Mixed::new(problem, &Parts::examine(problem)?).unwrap();
    let mut u = prepared.wide.start();
    let status = prepared.run(Options::default().settings(), &mut u).unwrap().outcome.status;
    assert!(went_well(status), "{what}: {status:?}");
    let (counts, law) = (problem.topology.counts, prepared.wide.law());
    let active = (0..counts.contact).filter(|&at| contact::is_active(counts, law, &u, at)).count();
    Ok((u, active))
}

#[test]
fn mixed_precision_is_as_accurate_as_f64_on_every_standard_scene() -> Result<()> {
    for path in standard_scenes() {
        let (_, problem) = read(&path)?;
        let reference = solve(&problem, &Options::by(SolverKind::Direct))?;
        let name = path.file_stem().unwrap().to_string_lossy();
        let (u, active) = mixed(&name, &problem)?;
        AGREEMENT.check(&name, distance(&u, &reference.u));
        assert_eq!(active, reference.contact_active, "{name}");
    }
    Ok(())
}

#[test]
fn a_limit_of_sweeps_is_kept_and_the_iterate_feasible() -> Result<()> {
    let (_, problem) = read(&meshes("catalogue/h-tri.toml"))?;
    let mut prepared = Mixed::new(&problem, &Parts::examine(&problem)?).unwrap();
    let settings =
        Settings { relaxation: Relaxation::Fixed(1.9), max_sweeps: 12, ..Settings::default() };
    let mut u = prepared.wide.start();
    let found = prepared.run(settings, &mut u).unwrap();
    assert_eq!((found.outcome.status, found.outcome.sweeps), (Status::OutOfSweeps, 12));
    let free = problem.topology.counts.free;
    let lower = prepared.wide.law().lower();
    assert!(u[free..].iter().zip(lower).all(|(u, lower)| u >= lower));
    Ok(())
}

#[test]
fn nothing_is_left_to_do_from_the_solution() -> Result<()> {
    let (_, problem) = read(&meshes("catalogue/h-tri.toml"))?;
    let mut prepared = Mixed::new(&problem, &Parts::examine(&problem)?).unwrap();
    let settings = Settings { tolerance: 1e-12, ..Settings::default() };
    let mut u = prepared.wide.start();
    let cold = prepared.run(settings, &mut u).unwrap();
    let solution = u.clone();
    let warm = prepared.run(settings, &mut u).unwrap();
    assert!(cold.corrections > 1);
    assert_eq!((warm.corrections, warm.outcome.status), (0, Status::Converged));
    assert_eq!(u, solution);
    Ok(())
}

/// The catalogue's table of effort finds its best between 1.8 and 1.9 on H with n = 16.
#[test]
fn the_tuned_factor_needs_the_fewest_sweeps() -> Result<()> {
    let goal = 1e-4;
    for path in standard_scenes() {
        let (_, problem) = read(&path)?;
        let omega = tuned_omega(&problem, Precision::F64, goal)?;
        let trials = Trials::<f64>::new(&problem, goal)?;
        let count = |relaxation| trials.sweeps(relaxation, 50_000).unwrap().unwrap_or(u32::MAX);
        let tuned = count(Relaxation::Fixed(omega));
        let auto = count(Relaxation::Adaptive(1.0));
        let unit = count(Relaxation::Fixed(1.0));
        let name = path.file_stem().unwrap().to_string_lossy();
        assert!(tuned <= auto && tuned <= unit, "{name}: {tuned}, {auto}, {unit}");
        let by_hand = [1.7, 1.8, 1.9, 1.95].map(|omega| count(Relaxation::Fixed(omega)));
        assert!(by_hand.iter().all(|&sweeps| sweeps + 4 >= tuned), "{name}: {by_hand:?}, {tuned}");
        if name == "h-tri" {
            assert!((1.8..1.95).contains(&omega), "{omega}");
            assert!(auto <= unit && 5 * tuned < unit, "{tuned}, {auto}, {unit}");
        }
    }
    Ok(())
}

#[test]
fn f32_cannot_be_tuned_for_what_it_cannot_reach() -> Result<()> {
    let (_, problem) = read(&meshes("catalogue/patch-mixed.toml"))?;
    let refused = tuned_omega(&problem, Precision::F32, 1e-12).expect_err("refused");
    let said = refused.to_string();
    assert!(said.contains("no ω brings the error down to 1e-12"), "{said}");
    Ok(())
}
