//! The stages of the kernel, each timed by itself, in both scalars and at three sizes.
//!
//! ```text
//!   cargo bench --bench kernel                          all of it
//!   cargo bench --bench kernel -- sweep/f32             one stage in one scalar
//! ```
//! Throughput counts unknowns: a sweep at 100 Melem/s relaxes 10⁸ unknowns a second.

mod strip;

use criterion::{BatchSize, Bencher, BenchmarkId, Criterion, Throughput};
use signorini_host::problem::{Assembled, Problem};
use signorini_host::quadrature::DATA_POINTS;
use signorini_host::scalar::Scalar;
use signorini_kernel::mesh::Mesh;
use signorini_kernel::rows::{QUADS, Row, Rows};
use signorini_kernel::solver::{Settings, Solver, Status};
use signorini_kernel::stiffness::{self, Coefficient, Stiffness};
use signorini_kernel::{Tensor, assembly, flux, psor};

/// Squares across the height of the domain.
const SIZES: [u32; 3] = [16, 48, 128];

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    all_stages::<f64>(&mut criterion);
    all_stages::<f32>(&mut criterion);
    criterion.final_summary();
}

fn all_stages<R: Scalar>(criterion: &mut Criterion) {
    stage::<R>(criterion, "pattern", symbolic);
    stage::<R>(criterion, "assembly", numeric);
    stage::<R>(criterion, "sweep", sweep);
    stage::<R>(criterion, "solve", solve);
    stage::<R>(criterion, "flux", recover);
}

/// Times one stage at every size.
fn stage<R: Scalar>(
    criterion: &mut Criterion,
    name: &str,
    time: fn(&mut Bencher, &Problem, &Assembled<R>),
) {
    let mut group = criterion.benchmark_group(format!("{name}/{}", R::NAME));
    group.sample_size(20);
    for n in SIZES {
        let unknowns = strip::unknowns(n);
        group.throughput(Throughput::Elements(unknowns as u64));
        group.bench_function(BenchmarkId::from_parameter(unknowns), |bencher| {
            let problem = strip::problem(n);
            assert_eq!(problem.topology.counts.unknowns(), unknowns);
            let assembled = Assembled::new(&problem).expect("the scalar holds the problem");
            time(bencher, &problem, &assembled);
        });
    }
}

/// The pattern of the matrix.
fn symbolic<R: Scalar>(bencher: &mut Bencher, _: &Problem, assembled: &Assembled<R>) {
    let edges = assembled.edges();
    let mut row_ptr = vec![0; edges.counts().unknowns() + 1];
    let mut col_idx = vec![0; edges.nonzeros()];
    bencher.iter(|| assembly::pattern(edges, &mut row_ptr, &mut col_idx));
}

/// Element matrices, values of the matrix, and load.
fn numeric<R: Scalar>(bencher: &mut Bencher, problem: &Problem, assembled: &Assembled<R>) {
    let vertices: Vec<_> = problem.mesh.vertices.iter().map(|v| v.map(R::narrow)).collect();
    let mesh = Mesh::new(&vertices, &problem.mesh.triangles, &problem.mesh.quads);
    let mesh = mesh.expect("the cells are convex");
    let boundary = assembled.boundary().expect("the records are admissible");
    let system = assembled.system().expect("the numbers are finite");
    let (edges, row_ptr) = (assembled.edges(), system.matrix().row_ptr());
    let mut triangles = vec![[R::ZERO; 3]; mesh.triangles().len()];
    let mut quads = vec![[R::ZERO; 6]; mesh.quads().len()];
    let mut values = vec![R::ZERO; edges.nonzeros()];
    let mut load = vec![R::ZERO; edges.counts().unknowns()];
    let uniform = Coefficient::Uniform(Tensor::scalar(R::ONE));
    bencher.iter(|| {
        stiffness::fill(&mesh, uniform, DATA_POINTS, &mut triangles, &mut quads)?;
        let stiffness = Stiffness { triangles: &triangles, quads: &quads };
        assembly::values(edges, stiffness, &boundary, row_ptr, &mut values)?;
        assembly::load(edges, assembled.cells(), &boundary, &mut load)
    });
}

/// One sweep; its cost does not depend on ω.
fn sweep<R: Scalar>(bencher: &mut Bencher, _: &Problem, assembled: &Assembled<R>) {
    let system = assembled.system().expect("the numbers are finite");
    let mut u = assembled.start();
    system.make_feasible(&mut u);
    let mut memory = vec![Row::<R, u32, QUADS>::EMPTY; system.counts().unknowns()];
    let mut rows = Rows::new(assembled.edges(), &mut memory).expect("u32 holds the edges");
    rows.set(&system, R::narrow(1.9)).expect("one numbering");
    bencher.iter(|| psor::sweep(&rows, system.lower(), &mut u));
}

/// A solve from a cold start to a residual that both scalars reach.
fn solve<R: Scalar>(bencher: &mut Bencher, _: &Problem, assembled: &Assembled<R>) {
    let system = assembled.system().expect("the numbers are finite");
    let settings = Settings { tolerance: R::narrow(1e-5), ..Settings::default() };
    let mut memory = vec![Row::<R, u32, QUADS>::EMPTY; system.counts().unknowns()];
    let mut rows = Rows::new(assembled.edges(), &mut memory).expect("u32 holds the edges");
    let mut run = |u: &mut Vec<R>| Solver::<R>::new(settings)?.run(&system, &mut rows, u);
    let status = run(&mut assembled.start()).map(|outcome| outcome.status);
    assert_eq!(status, Ok(Status::Converged));
    bencher.iter_batched_ref(|| assembled.start(), run, BatchSize::LargeInput);
}

/// The flux through every edge.
fn recover<R: Scalar>(bencher: &mut Bencher, _: &Problem, assembled: &Assembled<R>) {
    let u = assembled.start();
    let mut fluxes = vec![R::ZERO; u.len()];
    let (edges, stiffness, cells) = (assembled.edges(), assembled.stiffness(), assembled.cells());
    bencher.iter(|| flux::recover(edges, stiffness, cells, &u, &[], &mut fluxes));
}
