//! The kernel against the naive twin on random scenes: every kind of cell, tensor and condition.

use crate::factored;
use crate::numbering::NumberedMesh;
use signorini_kernel::law::Law;
use std::collections::BTreeMap;
use std::sync::Arc;

use signorini_kernel::assembly::{self, CellLoads};
use signorini_kernel::csr::Csr;
use signorini_kernel::mesh::boundary::{Boundary, Neumann, Robin};
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::{Block, Edges};
use signorini_kernel::refinement;
use signorini_kernel::rows::{QUADS, Row, Rows, TRIANGLES};
use signorini_kernel::solver::{Settings, Status};
use signorini_kernel::stiffness::{self, Coefficient, Stiffness};
use signorini_kernel::system::Shifts;
use signorini_kernel::system::System;
use signorini_kernel::{Index, Libm, Tensor, contact, flux, psor};
use signorini_problem::scalar::Scalar as Number;
use signorini_tests::cell::Cell;
use signorini_tests::field::Scalar;
use signorini_tests::grid::{Edge, edge};
use signorini_tests::problem::{Boundary as Condition, Problem};
use signorini_tests::quadrature::edge_mean;
use signorini_tests::random::{self, Random};
use signorini_tests::{contact as twin_contact, flux as twin_flux};
use signorini_tolerances::twins::{KERNEL_AGREEMENT, KERNEL_FLUX, NARROW_AGREEMENT, ONE_SWEEP};

/// The numbers that kernel and twin are compared by.
struct Answer {
    converged: bool,
    means: BTreeMap<Edge, f64>,
    outward: BTreeMap<Edge, f64>,
    force: f64,
}

/// Who solves.
#[derive(Clone, Copy)]
enum Method {
    Sweeps,
    /// With the free unknowns eliminated in an order of this seed.
    Factor(u64),
}

/// Solves `problem` with the kernel, in the scalar R, numbered by I.
fn by_kernel<R: Number, I: Index>(problem: &Problem, method: Method) -> Answer {
    let grid = &problem.grid;
    let index = |vertex: u32| I::new(vertex as usize).expect("a small grid");
    let vertices = grid.vertices.iter().map(|v| v.map(R::narrow)).collect();
    let triangles = grid.triangles.iter().map(|cell| cell.map(index)).collect();
    let quads = grid.quads.iter().map(|cell| cell.map(index)).collect();
    let key = |ends: [I; 2]| edge(ends[0].at() as u32, ends[1].at() as u32);
    let block = |ends| match &problem.boundary[&key(ends)] {
        Condition::Dirichlet { .. } => Block::Dirichlet,
        Condition::Contact { .. } => Block::Contact,
        Condition::Neumann { .. } | Condition::Robin { .. } => Block::Free,
    };
    let numbered = NumberedMesh::<R, I>::new(vertices, (triangles, quads), block);
    let numbered = numbered.expect("a valid grid");
    let (mesh, edges) = (numbered.mesh().expect("a mesh"), numbered.edges().expect("its edges"));
    let (triangles, quads) = (numbered.triangles.len(), numbered.quads.len());
    let counts = edges.counts();
    let keys: Vec<Edge> = (0..counts.edges()).map(|at| key(edges.endpoints(&mesh, at))).collect();

    let data = Data::<R, I>::new(problem, &keys, &edges);
    let boundary = Boundary::new(&edges, &data.neumann, &data.robin, &data.contact_flux)
        .expect("valid conditions");
    let tensors: Vec<_> = (0..grid.cell_count()).map(|cell| tensor(problem, cell)).collect();
    let (mut k3, mut k4) = (vec![[R::ZERO; 3]; triangles], vec![[R::ZERO; 6]; quads]);
    stiffness::fill(&mesh, Coefficient::PerCell(&tensors), 8, &mut k3, &mut k4).expect("tensors");
    let k = Stiffness { triangles: &k3, quads: &k4 };
    let (t, q) = data.loads.split_at(triangles);
    let loads = CellLoads { triangles: t, quads: q };

    let (mut row_ptr, mut col_idx) =
        (vec![0; counts.unknowns() + 1], vec![I::NONE; edges.nonzeros()]);
    let (mut values, mut load) =
        (vec![R::ZERO; edges.nonzeros()], vec![R::ZERO; counts.unknowns()]);
    assembly::pattern(&edges, &mut row_ptr, &mut col_idx).expect("lengths");
    let diagonal = DiagonalTerms::new(&boundary);
    assembly::values(&edges, k, diagonal, &row_ptr, &mut values).expect("lengths");
    assembly::load(&edges, loads, &boundary, &mut load).expect("lengths");
    let matrix = Csr::new(&row_ptr, &col_idx, &values, counts.edges()).expect("a valid matrix");
    let shifts = Shifts { part: &[], parts: 1, diagonal };
    let system = System::new(matrix, &load, Law::above(&data.gap), counts).expect("finite");
    let system = system.with_shifts(shifts).expect("lengths");

    let mut u = vec![R::ZERO; counts.unknowns()];
    u.extend(&data.dirichlet);
    if quads == 0 {
        rows_agree::<R, I, TRIANGLES>(&edges, k, diagonal, &system, &u);
    }
    rows_agree::<R, I, QUADS>(&edges, k, diagonal, &system, &u);
    let mut low = vec![R::ZERO; u.len()];
    let mut rows = vec![Row::<R, I, QUADS>::EMPTY; counts.unknowns()];
    let rows = Rows::new(&edges, &mut rows).expect("small enough");
    let scratch = &mut vec![R::ZERO; refinement::scratch(counts)];
    let (tolerance, accuracy) =
        if R::EPSILON.wide() < 1e-10 { (1e-13, 1e-10) } else { (0.0, 1e-7) };
    let [tolerance, accuracy] = [tolerance, accuracy].map(R::narrow);
    let settings = Settings { tolerance, accuracy, ..Settings::default() };
    let converged = match method {
        Method::Sweeps => {
            let both = [&mut u[..], &mut low];
            let swept = refinement::run::<R, I, Libm, QUADS>(
                &system, diagonal, settings, 6, both, rows, scratch,
            );
            let status = swept.expect("valid settings").status;
            matches!(status, Status::Converged | Status::RoundingLimit)
        }
        Method::Factor(seed) => {
            let order = shuffled::<I>(&mut Random::new(seed), counts.free);
            let matrix = system.matrix();
            let found =
                factored::solve(matrix, &system, diagonal, &settings, &order, &mut u, &mut low);
            let [first, warm] = found.expect("lengths").expect("a solution");
            assert_eq!(warm.pivots, 0);
            matches!(first.status, Status::Converged | Status::RoundingLimit)
        }
    };
    let mut fluxes = vec![R::ZERO; u.len()];
    flux::recover(&edges, k, loads, &u, &low, &mut fluxes).expect("lengths");
    let force = contact::force(counts, &boundary, Law::above(&data.gap), &u, &fluxes).wide();
    let on_boundary = (0..counts.edges()).filter(|&at| edges.half_edges()[at][1] == I::NONE);
    Answer {
        converged,
        outward: on_boundary.map(|at| (keys[at], fluxes[at].wide())).collect(),
        means: keys.iter().copied().zip(u.iter().map(|u| u.wide())).collect(),
        force,
    }
}

/// All numbers below n once, in random order.
fn shuffled<I: Index>(random: &mut Random, n: usize) -> Vec<I> {
    let mut order: Vec<I> = (0..n).filter_map(I::new).collect();
    for last in (1..n).rev() {
        order.swap(last, random.below(last as u32 + 1) as usize);
    }
    order
}

/// A sweep over rows from CSR, one over rows from the element matrices, bit for bit, and one written
/// out with CSR, up to rounding.
fn rows_agree<R: Number, I: Index, const WIDTH: usize>(
    edges: &Edges<I>,
    stiffness: Stiffness<R>,
    diagonal: DiagonalTerms<R, I>,
    system: &System<R, I>,
    start: &[R],
) {
    let omega = R::narrow(1.7);
    let (counts, matrix) = (system.counts(), system.matrix());
    let mut memory = vec![Row::<R, I, WIDTH>::EMPTY; counts.unknowns()];
    let mut rows = Rows::of_matrix(matrix, counts, &mut memory).expect("small enough");
    rows.set(system, omega).expect("one numbering");
    let mut swept = start.to_vec();
    psor::sweep(&rows, system.law(), &mut swept).expect("lengths");

    let mut memory = vec![Row::<R, I, WIDTH>::EMPTY; counts.unknowns()];
    let mut rows = Rows::new(edges, &mut memory).expect("small enough");
    rows.gather(edges, stiffness, diagonal, system.load(), omega).expect("one numbering");
    let mut gathered = start.to_vec();
    psor::sweep(&rows, system.law(), &mut gathered).expect("lengths");
    assert_eq!(swept, gathered, "rows of either source");

    let mut plain = start.to_vec();
    for (i, (row, &load)) in matrix.iter().zip(system.load()).enumerate() {
        let step = omega * (load - row.dot(&plain)) / row.diagonal();
        plain[i] += step;
        if i >= counts.free && plain[i] < system.law().lower()[i - counts.free] {
            plain[i] = system.law().lower()[i - counts.free];
        }
    }
    let most = plain.iter().fold(1e-30, |most: f64, u| most.max(u.wide().abs()));
    for (swept, plain) in swept.iter().zip(&plain) {
        let epsilon = R::EPSILON.wide() / f64::EPSILON * most;
        ONE_SWEEP.check_over("a sweep", swept.wide() - plain.wide(), epsilon);
    }
}

fn tensor<R: Number>(problem: &Problem, cell: usize) -> Tensor<R> {
    let [xx, xy, yy] = (problem.tensor)(cell, [0.0, 0.0]).map(R::narrow);
    Tensor { xx, xy, yy }
}

/// The scene's integrals, by the twin's quadrature.
struct Data<R, I> {
    neumann: Vec<Neumann<R, I>>,
    robin: Vec<Robin<R, I>>,
    contact_flux: Vec<R>,
    gap: Vec<R>,
    dirichlet: Vec<R>,
    loads: Vec<R>,
}

impl<R: Number, I: Index> Data<R, I> {
    fn new(problem: &Problem, keys: &[Edge], edges: &Edges<I>) -> Self {
        let mut data = Self {
            neumann: Vec::new(),
            robin: Vec::new(),
            contact_flux: Vec::new(),
            gap: Vec::new(),
            dirichlet: Vec::new(),
            // ∫f = Σ_E ∫ f̄ φ_E, since the basis functions add up to 1.
            loads: (0..problem.grid.cell_count())
                .map(|cell| R::narrow(problem.cell_load(cell).iter().sum()))
                .collect(),
        };
        for (at, key) in keys.iter().enumerate() {
            if edges.half_edges()[at][1] == I::NONE {
                data.add(problem, *key, I::new(at).expect("a small grid"));
            }
        }
        data
    }

    fn add(&mut self, problem: &Problem, key: Edge, at: I) {
        let [a, b] = problem.grid.ends(key);
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let mean = |f: &Scalar| edge_mean(f, [a, b], problem.order);
        match &problem.boundary[&key] {
            Condition::Dirichlet { value } => self.dirichlet.push(R::narrow(mean(value))),
            Condition::Neumann { flux } => {
                let flux = R::narrow(length * mean(flux));
                self.neumann.push(Neumann { edge: at, flux });
            }
            Condition::Contact { gap, flux } => {
                self.gap.push(R::narrow(mean(gap)));
                self.contact_flux.push(R::narrow(length * mean(flux)));
            }
            Condition::Robin { coefficient, ambient } => {
                let (h, outside) = (coefficient.clone(), ambient.clone());
                let both: Scalar = Arc::new(move |p| h(p) * outside(p));
                let [coefficient, ambient] =
                    [mean(coefficient), mean(&both)].map(|mean| R::narrow(length * mean));
                self.robin.push(Robin { edge: at, coefficient, ambient });
            }
        }
    }
}

fn by_twin(problem: &Problem) -> Answer {
    let solution = twin_contact::solve(&problem.system()).expect("exactly one solution");
    let normal = twin_flux::normal_flux(problem, &solution);
    let mut outward = BTreeMap::new();
    for (&(cell, key), &flux) in &normal {
        if problem.boundary.contains_key(&key) {
            let local = problem.grid.cell_edges(cell).iter().position(|&other| other == key);
            let [x, y] = Cell::of(&problem.grid, cell).scaled_normal(local.expect("its own edge"));
            outward.insert(key, flux * x.hypot(y));
        }
    }
    Answer {
        converged: true,
        force: twin_flux::contact_force(problem, &solution),
        means: solution.means,
        outward,
    }
}

fn distance(a: &BTreeMap<Edge, f64>, b: &BTreeMap<Edge, f64>) -> f64 {
    assert!(a.keys().eq(b.keys()), "the same edges");
    a.iter().fold(0.0, |most: f64, (key, a)| most.max((a - b[key]).abs()))
}

fn size(values: &BTreeMap<Edge, f64>) -> f64 {
    values.values().fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()))
}

/// Every cell has its own oblique tensor with eigenvalues from 10⁻² to 10²: harder than any region of a
/// real scene.
const SEEDS: u64 = 150;

#[test]
fn random_scenes_in_f64() {
    for (seed, method) in (0..SEEDS).flat_map(|s| [(s, Method::Sweeps), (s, Method::Factor(s))]) {
        let problem = random::problem(&mut Random::new(seed), 5);
        let (kernel, twin) = (by_kernel::<f64, u16>(&problem, method), by_twin(&problem));
        assert!(kernel.converged, "seed {seed}");
        let what = format!("seed {seed}");
        let u = distance(&kernel.means, &twin.means) / size(&twin.means);
        KERNEL_AGREEMENT.check(&what, u);
        let fluxes = size(&twin.outward);
        KERNEL_FLUX.check(&what, distance(&kernel.outward, &twin.outward) / fluxes);
        KERNEL_FLUX.check(&what, (kernel.force - twin.force) / fluxes.max(twin.force.abs()));
    }
}

#[test]
fn random_scenes_in_f32_and_with_wide_indices() {
    let methods = |seed| [(seed, Method::Sweeps), (seed, Method::Factor(seed))];
    for (seed, method) in (0..SEEDS / 2).flat_map(methods) {
        let problem = random::problem(&mut Random::new(seed), 5);
        let (kernel, twin) = (by_kernel::<f32, u32>(&problem, method), by_twin(&problem));
        assert!(kernel.converged, "seed {seed}");
        let u = distance(&kernel.means, &twin.means) / size(&twin.means);
        NARROW_AGREEMENT.check(format_args!("seed {seed}"), u);
    }
}
