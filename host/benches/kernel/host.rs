//! The host's layers: from files to integrals, and the direct ways to a solution.

use std::path::Path;
use std::time::Duration;

use criterion::{BatchSize, Bencher, BenchmarkId, Criterion, Throughput};
use signorini_condense::condense;
use signorini_problem::Problem;
use signorini_scene::mesh;
use signorini_scene::mesh::adaptive::Hierarchy;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::scene::Scene;
use signorini_solve::{Options, SolverKind, solve};

use crate::strip::{Strip, scene};
use crate::{Stages, group};

pub fn stages(stages: &mut Stages) {
    stages.time::<f64>("problem", problem);
    stages.time::<f64>("direct solve", direct);
    let small = &stages.strips[..1];
    Stages { criterion: stages.criterion, strips: small, cells: stages.cells }
        .time::<f64>("condensation", condensation);
}

/// Binding, numbering and every integral of the data.
fn problem(bencher: &mut Bencher, strip: &Strip) {
    let (scene, mesh) = (scene(1.0), &strip.problem().mesh);
    bencher.iter(|| Problem::new(&scene, mesh.clone()));
}

/// Factorisation and active set of the reference; the rest of the solve does not count.
fn direct(bencher: &mut Bencher, strip: &Strip) {
    let problem = strip.problem();
    let options = Options { solver: SolverKind::Direct, ..Options::default() };
    let seconds = || solve(problem, &options).map_or(0.0, |found| found.seconds.solve);
    assert!(seconds() > 0.0);
    bencher.iter_custom(|times| Duration::from_secs_f64((0..times).map(|_| seconds()).sum()));
}

/// All that a condensed model needs, its bound included.
fn condensation(bencher: &mut Bencher, strip: &Strip) {
    let problem = strip.problem();
    bencher.iter(|| condense(problem));
}

/// Meshes of the standard scenes, by the unknowns of those.
const SCENES: [&str; 3] = ["catalogue/b-tri.toml", "catalogue/b-quad.toml", "scenes/levee.toml"];

/// Reading mesh files.
pub fn files(criterion: &mut Criterion) {
    let mut group = group(criterion, "mesh file");
    for name in SCENES {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../meshes").join(name);
        let scene = Scene::read(&path).expect("a standard scene");
        let mesh = mesh::read(&scene.mesh.value).expect("a mesh of the project");
        let problem = Problem::new(&scene, mesh).expect("the scene fits the mesh");
        group.throughput(Throughput::Elements(problem.topology.counts.unknowns() as u64));
        group.bench_function(BenchmarkId::from_parameter(name), |bencher| {
            bencher.iter(|| mesh::read(&scene.mesh.value));
        });
    }
}

/// A round of local refinement, a tenth of the cells marked; throughput counts the cells that come out, a million.
pub fn refinement(criterion: &mut Criterion) {
    let mut group = group(criterion, "local refinement");
    for (kind, n) in [(Cells::Triangles, 400), (Cells::Quads, 500)] {
        let before = Hierarchy::new(grid(n, kind)).expect("a mesh");
        let marks: Vec<_> =
            (0..before.mesh().cells()).map(|cell| cell.is_multiple_of(10)).collect();
        let round = |hierarchy: &mut Hierarchy| {
            hierarchy.refine(&marks).expect("a finer mesh");
            hierarchy.mesh().cells()
        };
        let cells = round(&mut before.clone());
        group.throughput(Throughput::Elements(cells as u64));
        group.bench_function(BenchmarkId::new(format!("{kind:?}"), cells), |bencher| {
            bencher.iter_batched_ref(|| before.clone(), round, BatchSize::PerIteration);
        });
    }
}
