//! What each solver takes, from element matrices to a converged u: five scenes, four sizes, three anisotropies.
//!
//! ```text
//!   cargo bench --bench solvers                    all of it, and renews host/benches/solvers/record.csv
//!   cargo bench --bench solvers -- "levee/1/"      a part of it, and renews its rows
//!   cargo bench --bench solvers -- --test          each once, for its answer alone
//! ```
//! The record has the fastest time of each. `auto` is chosen by it (`host/solve/src/cost.rs`), and a test compares the two.

mod record;

use std::path::Path;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput};
use record::{Record, Row};
use signorini_problem::Problem;
use signorini_scene::mesh::adapted::adapted;
use signorini_scene::mesh::read;
use signorini_scene::scene::Scene;
use signorini_solve::cost::Size;
use signorini_solve::{Options, Ran, SolverKind, solve};

/// Scenes, from the root of the repository.
const SCENES: [&str; 5] = [
    "meshes/scenes/levee.toml",
    "meshes/scenes/slab.toml",
    "meshes/scenes/strip.toml",
    "meshes/scenes/pit.toml",
    "tests/firmware/scenes/dam.toml",
];
/// Factors of the first entry of A.
const STRETCHES: [f64; 3] = [1.0, 5.0, 25.0];
/// How often a mesh is refined.
const LEVELS: u32 = 4;
/// Solvers, each with what it has to be when it ends, and its place in the record.
const SOLVERS: [(SolverKind, Ran); 4] = [
    (SolverKind::Kernel, Ran::Sweeps),
    (SolverKind::Factor, Ran::Factor),
    (SolverKind::Direct, Ran::Direct),
    (SolverKind::Multigrid, Ran::Multigrid),
];
/// A solver that takes so many times as long as the quickest is not timed on larger meshes.
const FAR_BEHIND: f64 = 8.0;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let mut record = Record::default();
    for path in SCENES {
        for stretch in STRETCHES {
            let mut still = SOLVERS.map(|_| true);
            for level in 0..LEVELS {
                let row = timed(&mut criterion, path, stretch, level, still);
                let quickest = row.quickest();
                for (still, seconds) in still.iter_mut().zip(row.seconds) {
                    *still &= seconds.is_none_or(|seconds| seconds < FAR_BEHIND * quickest);
                }
                record.rows.push(row);
            }
        }
    }
    criterion.final_summary();
    record.renew();
}

/// One problem by the solvers that are still near.
fn timed(
    criterion: &mut Criterion,
    path: &str,
    stretch: f64,
    level: u32,
    still: [bool; SOLVERS.len()],
) -> Row {
    let problem = problem(path, stretch, level);
    let size = Size::of(&problem);
    let unknowns = size.unknowns;
    let name = Path::new(path).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let mut group = criterion.benchmark_group(format!("{name}/{stretch}"));
    group.sample_size(10).warm_up_time(Duration::from_millis(1));
    group
        .measurement_time(Duration::from_millis(100))
        .throughput(Throughput::Elements(unknowns as u64));
    let mut seconds = SOLVERS.map(|_| None);
    for (at, (solver, ran)) in SOLVERS.into_iter().enumerate().filter(|(at, _)| still[*at]) {
        let id = BenchmarkId::new(format!("{solver:?}"), unknowns);
        group.bench_function(id, |bencher| {
            bencher.iter_custom(|times| {
                let taken: Vec<f64> = (0..times).map(|_| once(&problem, solver, ran)).collect();
                let all: f64 = taken.iter().sum();
                let least = taken.into_iter().fold(f64::INFINITY, f64::min);
                let best = seconds[at].get_or_insert(f64::INFINITY);
                *best = best.min(least);
                Duration::from_secs_f64(all.clamp(1e-9, 1e9))
            });
        });
    }
    group.finish();
    Row { name, factor: stretch, level, size, asked: still, seconds }
}

/// Seconds of one solve; infinite where another solver had to end it.
fn once(problem: &Problem, solver: SolverKind, ran: Ran) -> f64 {
    let options = Options { solver, averages: true, ..Options::default() };
    let found = solve(problem, &options).expect("the scene has a solution");
    if found.ran == ran && found.converged() { found.seconds.solve } else { f64::INFINITY }
}

fn problem(path: &str, stretch: f64, level: u32) -> Problem {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path);
    let mut scene = Scene::read(&path).expect("the scene is well-formed");
    for material in &mut scene.materials {
        let first = &mut material.conductivity[0].value;
        *first = first.times(stretch);
    }
    let mesh =
        adapted(read(&scene.mesh.value).expect("a mesh"), None, level).expect("a finer mesh");
    Problem::new(&scene, mesh).expect("the scene fits the mesh")
}
