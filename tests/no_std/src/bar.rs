//! A bar of two triangles and a quad, pressed on a foundation by a load.
//!
//! ```text
//!   3 ----- 2 ----- 5      −Δu = load,  u = 0 on the left and on the right end,
//!   |     / |       |      u ≥ −1 at the bottom, nothing at the top
//!   |   /   |       |
//!   0 ----- 1 ----- 4
//! ```

use signorini_kernel::assembly::{self, CellLoads};
use signorini_kernel::csr::Csr;
use signorini_kernel::flux_range::Spans;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::boundary::Boundary;
use signorini_kernel::mesh::components::{self, Part};
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::{Block, Edges};
use signorini_kernel::mesh::numbering::{NumberingBuffers, number};
use signorini_kernel::refinement;
use signorini_kernel::rows::{QUADS, Row, Rows};
use signorini_kernel::solver::Settings;
use signorini_kernel::stiffness::{self, Coefficient, Stiffness};
use signorini_kernel::system::System;
use signorini_kernel::{Error, Index, Libm, Real, Tensor, contact, flux};

const VERTICES: usize = 6;
const HALF_EDGES: usize = 10;
const CONTACT: usize = 2;
const UNKNOWNS: usize = 6;
const EDGES: usize = 8;
const NONZEROS: usize = 25;

/// The force on the foundation, by every stage of the kernel in turn.
pub fn force<R: Real, I: Index>(load: R) -> Result<R, Error> {
    let (o, l) = (R::ZERO, R::ONE);
    let vertices: [_; VERTICES] = [[o, o], [l, o], [l, l], [o, l], [R::TWO, o], [R::TWO, l]];
    let (triangles, quads) = ([cell([0, 1, 2]), cell([0, 2, 3])], [cell([1, 4, 5, 2])]);
    let mesh = Mesh::new(&vertices, &triangles, &quads)?;
    let mut half_edges = [[I::NONE; 2]; HALF_EDGES];
    let buffers = NumberingBuffers {
        of_triangles: &mut [[I::NONE; 3]; 2],
        of_quads: &mut [[I::NONE; 4]],
        half_edges: &mut half_edges,
        at_vertex: &mut [[I::NONE; 2]; VERTICES],
        next: &mut [I::NONE; HALF_EDGES],
    };
    let edges = number(&mesh, buffers, |ends| Some(block(ends)))?;
    let (mut of_triangles, mut of_quads) = ([[o; 3]; 2], [[o; 6]]);
    let coefficient = Coefficient::Uniform(Tensor::scalar(l));
    stiffness::fill(&mesh, coefficient, 2, &mut of_triangles, &mut of_quads)?;
    let stiffness = Stiffness { triangles: &of_triangles, quads: &of_quads };
    let loads = CellLoads { triangles: &[load * R::HALF; 2], quads: &[load] };
    let u = solve(&edges, stiffness, loads)?;
    measure(&mesh, &edges, stiffness, loads, &u)
}

fn cell<I: Index, const N: usize>(vertices: [usize; N]) -> [I; N] {
    vertices.map(|vertex| I::new(vertex).unwrap_or(I::NONE))
}

fn block<I: Index>([a, b]: [I; 2]) -> Block {
    match [a.at(), b.at()] {
        [0, 1] | [1, 4] => Block::Contact,
        [3, 0] | [4, 5] => Block::Dirichlet,
        _ => Block::Free,
    }
}

/// u and, in second place, what lies below its last digit.
fn solve<R: Real, I: Index>(
    edges: &Edges<I>,
    stiffness: Stiffness<R>,
    loads: CellLoads<R>,
) -> Result<[[R; EDGES]; 2], Error> {
    let boundary = Boundary::new(edges, &[], &[], &[])?;
    let mut row_ptr = [0; UNKNOWNS + 1];
    let mut col_idx = [I::NONE; NONZEROS];
    let (mut values, mut load) = ([R::ZERO; NONZEROS], [R::ZERO; UNKNOWNS]);
    assembly::pattern(edges, &mut row_ptr, &mut col_idx)?;
    let diagonal = DiagonalTerms::new(&boundary);
    assembly::values(edges, stiffness, diagonal, &row_ptr, &mut values)?;
    assembly::load(edges, loads, &boundary, &mut load)?;
    components::examine(
        edges,
        diagonal,
        (&load, Spans::UNLIMITED),
        R::EPSILON,
        &mut [Part::default(); 3],
    )?;
    let matrix = Csr::new(&row_ptr, &col_idx, &values, EDGES)?;
    let gap = [-R::ONE; CONTACT];
    let system = System::new(matrix, &load, Law::above(&gap), edges.counts())?;
    let (mut u, mut low) = ([R::ZERO; EDGES], [R::ZERO; EDGES]);
    let mut rows = [Row::<R, I, QUADS>::EMPTY; UNKNOWNS];
    let scratch = &mut [R::ZERO; EDGES + 2 * UNKNOWNS + CONTACT];
    refinement::run::<R, I, Libm, QUADS>(
        &system,
        diagonal,
        Settings::default(),
        1,
        [&mut u, &mut low],
        Rows::new(edges, &mut rows)?,
        scratch,
    )?;
    Ok([u, low])
}

/// The force, NaN unless the whole bottom is in contact.
fn measure<R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    edges: &Edges<I>,
    stiffness: Stiffness<R>,
    loads: CellLoads<R>,
    [u, low]: &[[R; EDGES]; 2],
) -> Result<R, Error> {
    let boundary = Boundary::new(edges, &[], &[], &[])?;
    let mut fluxes = [R::ZERO; EDGES];
    flux::recover(edges, stiffness, loads, u, low, &mut fluxes)?;
    let gap = [-R::ONE; CONTACT];
    let length = contact::length::<R, I, Libm>(mesh, edges, Law::above(&gap), u);
    let force = contact::force(edges.counts(), &boundary, Law::above(&gap), u, &fluxes);
    Ok(if length == R::TWO { force } else { R::ZERO / R::ZERO })
}
