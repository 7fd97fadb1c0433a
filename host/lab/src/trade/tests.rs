//! Scenes of the repository for tests, and studies: plausible, deterministic, with everything in them.

use std::path::Path;

use super::record::{FunctionCost, Point, PointError, Recommendation, Skipped, Trade};
use super::target::Target;
use crate::baseline::Baseline;
use signorini_draw::plain;
use signorini_problem::Problem;
use signorini_scene::{Scene, Setting, mesh};

/// A scene of `meshes`.
pub fn scene(name: &str) -> Scene {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes");
    Scene::read(&root.join(format!("{name}.toml"))).unwrap()
}

/// The scene on its mesh.
pub fn problem(name: &str) -> Problem {
    let scene = scene(name);
    Problem::new(&scene, mesh::read(&scene.mesh.value).unwrap()).unwrap()
}

/// One of many settings: level, model, scalar and stop from the digits of `at`.
pub fn point(at: usize) -> Point {
    let digit = |place: usize, base: usize| at / place % base;
    let (model, scalar) =
        (["condensed", "full"][digit(1, 2)], ["f32", "f64", "f32+f64"][digit(2, 3)]);
    let (level, sweeps) = (digit(6, 2) as u32, [0, 4, 12, 40, 120][digit(12, 5)]);
    let h = 0.5_f64.powi(level as i32);
    let energy =
        0.06 * h * (1.0 + 6.0 / (1.0 + f64::from(sweeps)).powi(2) + 0.01 * digit(2, 3) as f64);
    let unknowns = 400 << (2 * level);
    let work =
        if model == "full" { 20.0 * f64::from(sweeps + 10) } else { 8.0 + 0.3 * f64::from(sweeps) };
    let cycles = unknowns as f64 * work * (1.0 + 0.6 * digit(2, 3) as f64);
    let stop = if sweeps == 0 { "exact".to_owned() } else { format!("{sweeps} sweeps") };
    Point {
        name: format!("{model}, level {level}, {scalar}, {stop}"),
        scalar: scalar.to_owned(),
        math: "libm".to_owned(),
        cells: "triangles".to_owned(),
        level,
        unknowns,
        stop,
        sweeps,
        start: "warm".to_owned(),
        omega: "auto".to_owned(),
        model: model.to_owned(),
        certificate: true,
        error: PointError {
            energy,
            combined: Some(1.3 * energy),
            l2: 0.1 * energy,
            flux: energy,
            force: 0.2 * energy * energy,
            length: 0.05 * h,
        },
        bound: Some(1.7 * energy),
        bound_of_u: Some(2.5 * energy),
        cycles,
        cycles_spread: 0.03,
        cycles_per_unknown: cycles / unknowns as f64,
        instructions: Some((1.4 * cycles) as u64),
        ram_bytes: Some(20_000 + 60 * unknowns as u64),
        flash_bytes: Some(24_044),
        pareto: false,
        setting: Setting { refine: level, ..Setting::default() },
    }
}

/// A study of so many settings on the host; the last point of its front is recommended.
pub fn trade(scene: &str, count: usize) -> Trade {
    let mut points: Vec<Point> = (0..count).map(point).collect();
    let better = |a: &Point, b: &Point| {
        a.cycles <= b.cycles && a.error.energy <= b.error.energy && a.name != b.name
    };
    let front = points.iter().map(|point| !points.iter().any(|other| better(other, point)));
    let front: Vec<bool> = front.collect();
    points.iter_mut().zip(front).for_each(|(point, pareto)| point.pareto = pareto);
    let taken = points.iter().rfind(|point| point.pareto).cloned();
    let text = taken.as_ref().map_or("Nothing meets what was asked.".to_owned(), |point| {
        let (cycles, error) = (plain(point.cycles), plain(100.0 * point.error.energy / 2.0));
        format!("For {cycles} cycles a tick take {}: error {error} %.", point.name)
    });
    Trade {
        scene: scene.to_owned(),
        title: format!("A {scene} <after> rain & snow"),
        registers: "any x86-64".to_owned(),
        target: Target::Host,
        truth: "against the mesh two levels finer".to_owned(),
        energy: 2.0,
        force: 0.8,
        length: 1.0,
        points,
        skipped: 1140,
        skipped_reasons: vec![
            Skipped { reason: "a condensed model takes no sweeps".to_owned(), count: 1000 },
            Skipped { reason: "micromath has no f64".to_owned(), count: 140 },
        ],
        baselines: vec![
            baseline("kernel PSOR", 1.0, 3),
            baseline("Clarabel", 24.0, 9),
            baseline("OSQP", 150.0, 75),
        ],
        notes: Vec::new(),
        math: vec![FunctionCost {
            function: "sqrt".to_owned(),
            used_in: "the search for ω".to_owned(),
            energy: Some(3e-7),
            force: Some(1e-6),
            sweeps: Some(-2),
            saved: 18.0,
            ..FunctionCost::default()
        }],
        recommendation: Recommendation { text, point: taken },
    }
}

/// Another solver, so many times slower than the kernel.
pub fn baseline(solver: &str, ratio: f64, iterations: u32) -> Baseline {
    Baseline {
        solver: solver.to_owned(),
        problem: "condensed".to_owned(),
        unknowns: 96,
        start: "warm".to_owned(),
        cycles: 9_876.0 * ratio,
        worst: 20_000.0 * ratio,
        tolerance: 1e-6,
        to_condensed: Some(ratio),
        target: 1e-4,
        cycles_spread: 0.042,
        ratio,
        algebraic_error: 1e-9 * ratio,
        iterations,
    }
}
