//! Ticks whose loads run up from subnormal numbers, each judged against its exact solution in f64.
//!
//! On the mesh of [`crate::grid`] with A = I, contact with ψ = q = 0 below and u = u_D above,
//! ```text
//!   pressed   u_D = −s     f = 0    u = −s y                   ∇u = (0, −s)
//!   open      u_D = s/4    f = s    u = s/4 + s (1 − y²)/2     ∇u = (0, −s y)
//! ```
//! for scales s whose squares, products or very digits are below the smallest normal number. Each load is ticked with
//! few sweeps, where the error is of the size of s, and with many. A line tells whether the answer is certified:
//! the bound holds, and nothing is NaN. Arithmetic that flushes subnormal numbers has other bits, but must
//! have the same lines.

use signorini_bound::cells::{CellBuffers, Triangle, pack};
use signorini_bound::certificate::{Discretization, LoadCase, Metric, stability};
use signorini_bound::conforming::VertexData;
use signorini_bound::equilibrium::is_root;
use signorini_bound::forest::{ForestBuffers, grow};
use signorini_device::tick::{
    CertifiedSweeps, Data, Deadline, IfStoring, Limits, Memory, Report, Tick,
};
use signorini_kernel::assembly::CellLoads;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::boundary::Boundary;
use signorini_kernel::mesh::geometry::{doubled_area, triangle_area};
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::{Row, Rows, TRIANGLES};
use signorini_kernel::stiffness::{self, Coefficient, Stiffness};
use signorini_kernel::{Error, Libm, Tensor};

use crate::grid::{COLUMNS, EDGES, Grid, SQUARES, VERTICES};
use crate::journal::Journal;
use crate::stages::cut;

const CELLS: usize = 2 * SQUARES;
/// Ascending, so that a tick starts from numbers that are nothing beside its own.
const SCALES: [f32; 13] =
    [1e-45, 1e-40, 1e-38, 1e-37, 1e-30, 1e-23, 1e-21, 1e-20, 1e-19, 1e-18, 1e-17, 1e-10, 1.0];
/// Sweeps of a tick that is cut off, and of one that is not.
const SWEEPS: [(u32, &str); 2] = [(3, "3 sweeps"), (1000, "1000 sweeps")];

/// A load.
#[derive(Clone, Copy)]
struct Case {
    scale: f32,
    pressed: bool,
}

impl Case {
    /// ∂u/∂y
    fn slope(self, y: f64) -> f64 {
        -f64::from(self.scale) * if self.pressed { 1.0 } else { y }
    }
}

/// All ticks, a line each.
pub fn ticks(journal: &mut Journal) {
    if run(journal).is_err() {
        journal.text("refused");
    }
}

#[inline(never)]
fn run(journal: &mut Journal) -> Result<(), Error> {
    let mut grid = Grid::<f32, CELLS, 0>::new();
    let (mesh, edges) = grid.number()?;
    let mut triangles = [[0.0; 3]; CELLS];
    let coefficient = Coefficient::Uniform(Tensor::scalar(1.0));
    stiffness::fill(&mesh, coefficient, 1, &mut triangles, &mut [])?;
    let stiffness = Stiffness { triangles: &triangles, quads: &[] };
    let boundary = Boundary::<f32, u16>::new(&edges, &[], &[], &[])?;
    let [mut order, mut parent, mut place] = [[0; CELLS]; 3];
    let (order, parent, place) = (&mut order, &mut parent, &mut place);
    let buffers = ForestBuffers { order, parent, place, distance: &mut [0.0; CELLS] };
    let forest = grow(&edges, |_| 1.0, |edge| is_root(&edges, &boundary, edge), buffers)?;
    let mut packed = ([Triangle::EMPTY; CELLS], [0.0; VERTICES], [0.0; EDGES]);
    let buffers = CellBuffers {
        triangles: &mut packed.0,
        quads: &mut [],
        of_vertices: &mut packed.1,
        of_edges: cut(&mut packed.2, edges.counts().edges())?,
    };
    // 1 / (4 det A)
    let cells = pack(&mesh, &edges, stiffness, &[], &[0.25; CELLS], &forest, buffers)?;
    let metric = Metric::default();
    let stability = stability(&edges, &cells, metric, &boundary, &forest, &mut [0.0; CELLS])?;
    played(&Discretization { mesh, edges, stiffness, cells, metric, stability }, journal)
}

#[inline(never)]
fn played(discretization: &Discretization<f32, u16>, journal: &mut Journal) -> Result<(), Error> {
    let counts = discretization.edges.counts();
    let mut rows = [Row::EMPTY; EDGES];
    let (mut load, mut tau, mut u) = ([0.0; EDGES], [0.0; EDGES], [0.0; EDGES]);
    let memory = Memory {
        rows: Rows::<_, _, TRIANGLES>::new(
            &discretization.edges,
            cut(&mut rows, counts.unknowns())?,
        )?,
        load: cut(&mut load, counts.unknowns())?,
        active: &mut [false; COLUMNS],
        vertices: &mut [0.0; VERTICES],
        bubbles: &mut [],
        tau: cut(&mut tau, counts.edges())?,
        u: cut(&mut u, counts.edges())?,
    };
    let mut tick = Tick::new(*discretization, memory, Relaxation::Fixed(1.8))?;
    for scale in SCALES {
        journal.scalar("s", scale);
        for (load, pressed) in [("pressed, ", true), ("open, ", false)] {
            for (sweeps, words) in SWEEPS {
                let case = Case { scale, pressed };
                let report = answer(&mut tick, discretization, case, sweeps)?;
                let verdict = judged(&tick, discretization, case, &report);
                [load, words, ": ", verdict, "\n"].into_iter().for_each(|part| (journal.0)(part));
            }
        }
    }
    Ok(())
}

type Ticking<'a> = Tick<'a, f32, u16, TRIANGLES>;

#[inline(never)]
fn answer(
    tick: &mut Ticking,
    discretization: &Discretization<f32, u16>,
    case: Case,
    sweeps: u32,
) -> Result<Report<f32>, Error> {
    let Case { scale, pressed } = case;
    let (above, f) = if pressed { (-scale, 0.0) } else { (0.25 * scale, scale) };
    let mut loads = [0.0; CELLS];
    for (load, cell) in loads.iter_mut().zip(discretization.mesh.triangles()) {
        *load = f * triangle_area(discretization.mesh.triangle(cell));
    }
    let (gap, given) = ([[0.0; 2]; COLUMNS], [[above; 2]; COLUMNS]);
    let given = LoadCase {
        loads: CellLoads { triangles: &loads, quads: &[] },
        boundary: Boundary::new(&discretization.edges, &[], &[], &[])?,
        ends: VertexData { gap: &gap, given: &given },
        curved: &[],
        transfer: &[],
        forms: &[],
        oscillation: 0.0,
    };
    let data = Data {
        given,
        law: Law::above(&[0.0; COLUMNS]),
        dirichlet: &[above; COLUMNS],
        step: IfStoring::NOTHING,
    };
    let limits = Limits { error: 0.0, share: 0.0, sweeps };
    tick.begin(data)?.advance(CertifiedSweeps(Libm), limits, &mut Deadline::never())
}

/// What the answer is worth.
fn judged(
    tick: &Ticking,
    discretization: &Discretization<f32, u16>,
    case: Case,
    report: &Report<f32>,
) -> &'static str {
    let numbers = tick.u().iter().chain(tick.vertices()).chain(tick.tau());
    let figures = [report.figures.residual, report.figures.force, report.figures.omega];
    if !numbers.chain(&figures).all(|number| number.is_finite()) {
        return "not finite";
    }
    let Some(certificate) = report.verdict.certificate() else { return "no bound" };
    let bound = f64::from(certificate.total);
    match squared_error(tick, discretization, case) <= bound * bound {
        true => "certified",
        false => "above its bound",
    }
}

/// ‖∇(u − s)‖² + ‖∇u − τ‖² in f64: a square of degree 2 in each cell, so that the middles of its sides are enough.
#[inline(never)]
fn squared_error(tick: &Ticking, discretization: &Discretization<f32, u16>, case: Case) -> f64 {
    let mut sum = 0.0;
    for (at, cell) in discretization.mesh.triangles().iter().enumerate() {
        let corners = discretization.mesh.triangle(cell).map(|corner| corner.map(f64::from));
        let s = cell.map(|vertex| number(tick.vertices(), vertex.into()));
        let out = [0, 1, 2].map(|side| outward(tick, discretization, 3 * at + side));
        sum += in_cell(corners, s, out, case);
    }
    sum
}

fn number(numbers: &[f32], at: usize) -> f64 {
    numbers.get(at).copied().map_or(f64::NAN, f64::from)
}

/// ∫τ·n over a half-edge, with the normal out of its cell.
fn outward(tick: &Ticking, discretization: &Discretization<f32, u16>, half_edge: usize) -> f64 {
    let edge = discretization.edges.edge_of(half_edge);
    let first = discretization.edges.half_edges().get(edge).map(|halves| usize::from(halves[0]));
    let flux = number(tick.tau(), edge);
    if first == Some(half_edge) { flux } else { -flux }
}

/// The share of a cell with these vertex values and outward fluxes: τ = Σ out_k (x − a_k)/(2|T|), with a_k opposite
/// of side k.
fn in_cell(corners: [[f64; 2]; 3], s: [f64; 3], out: [f64; 3], case: Case) -> f64 {
    let [a, b, c] = corners;
    let doubled = doubled_area(a, b, c);
    let opposite = [c, a, b];
    // ∇λ_k is the normal of the opposite side, turned inwards, over 2|T|.
    let across = |[p, q]: [[f64; 2]; 2]| [(p[1] - q[1]) / doubled, (q[0] - p[0]) / doubled];
    let gradients = [[b, c], [c, a], [a, b]].map(across);
    let slope = |axis: usize| s.iter().zip(&gradients).map(|(s, g)| s * g[axis]).sum::<f64>();
    let gradient = [slope(0), slope(1)];
    let at_middle = |[p, q]: [[f64; 2]; 2]| {
        let middle = [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
        let exact = [0.0, case.slope(middle[1])];
        let mut square = 0.0;
        for axis in 0..2 {
            let terms = out.iter().zip(&opposite).map(|(f, o)| f * (middle[axis] - o[axis]));
            let tau = terms.sum::<f64>() / doubled;
            let (error, flux_error) = (exact[axis] - gradient[axis], exact[axis] - tau);
            square += error * error + flux_error * flux_error;
        }
        square
    };
    [[a, b], [b, c], [c, a]].map(at_middle).iter().sum::<f64>() * doubled / 6.0
}
