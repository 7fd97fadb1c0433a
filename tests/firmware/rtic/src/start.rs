//! Memory of the skin, and what the kernel builds in it before the first tick.

use signorini_kernel::boundary::Boundary;
use signorini_kernel::cells::{CellBuffers, Triangle, pack};
use signorini_kernel::certificate::{Ground, Metric, reach};
use signorini_kernel::edges::Edges;
use signorini_kernel::equilibrium::is_root;
use signorini_kernel::forest::{Forest, ForestBuffers, grow};
use signorini_kernel::numbering::{NumberingBuffers, number};
use signorini_kernel::rows::{self, Row, Rows};
use signorini_kernel::stiffness::{self, Coefficient, Stiffness};
use signorini_kernel::{Error, Mesh, Tensor, tick};

use crate::mesh::{CELLS, COLUMNS, EDGES, NODES, TRIANGLES, UNKNOWNS, VERTICES, block};
use crate::plant::CONDUCTIVITY;

/// What the kernel's arrays hold, for this mesh.
pub struct Memory {
    mesh: Numbered,
    stiffness: [[f32; 3]; TRIANGLES],
    forest: [[u16; TRIANGLES]; 3],
    /// Scratch of the start.
    way: [f32; TRIANGLES],
    cells: Packed,
    tick: Changing,
}

/// The cells in the order of the certificate.
struct Packed {
    triangles: [Triangle<f32, u16>; TRIANGLES],
    of_vertices: [f32; NODES],
    of_edges: [f32; EDGES],
}

/// The edges of the mesh.
struct Numbered {
    of_triangles: [[u16; 3]; TRIANGLES],
    half_edges: [[u16; 2]; EDGES],
    /// Scratch of the start.
    at_vertex: [[u16; 2]; NODES],
    /// Scratch of the start.
    next: [u16; EDGES],
}

/// What changes from tick to tick.
struct Changing {
    rows: [Row<f32, u16, { rows::TRIANGLES }>; UNKNOWNS],
    load: [f32; UNKNOWNS],
    active: [bool; COLUMNS],
    vertices: [f32; NODES],
    tau: [f32; EDGES],
    u: [f32; EDGES],
}

impl Memory {
    /// Zeros.
    pub const fn new() -> Self {
        Self {
            mesh: Numbered {
                of_triangles: [[0; 3]; TRIANGLES],
                half_edges: [[0; 2]; EDGES],
                at_vertex: [[0; 2]; NODES],
                next: [0; EDGES],
            },
            stiffness: [[0.0; 3]; TRIANGLES],
            forest: [[0; TRIANGLES]; 3],
            way: [0.0; TRIANGLES],
            cells: Packed {
                triangles: [Triangle::EMPTY; TRIANGLES],
                of_vertices: [0.0; NODES],
                of_edges: [0.0; EDGES],
            },
            tick: Changing {
                rows: [Row::EMPTY; UNKNOWNS],
                load: [0.0; UNKNOWNS],
                active: [false; COLUMNS],
                vertices: [0.0; NODES],
                tau: [0.0; EDGES],
                u: [0.0; EDGES],
            },
        }
    }
}

type Built = (Ground<'static, f32, u16>, tick::Memory<'static, f32, u16, { rows::TRIANGLES }>);

/// Numbers the edges, fills the element matrices, finds the ways out: what stays, and the memory of
/// what does not.
pub fn build(memory: &'static mut Memory) -> Result<Built, Error> {
    let Memory { mesh: numbered, stiffness, forest, way, cells, tick } = memory;
    let mesh = Mesh::new(&VERTICES, &CELLS, &[])?;
    let edges = numbered.number(&mesh)?;
    let coefficient = Coefficient::Uniform(Tensor::scalar(CONDUCTIVITY));
    stiffness::fill(&mesh, coefficient, 1, stiffness, &mut [])?;
    let stiffness = Stiffness { triangles: stiffness, quads: &[] };
    let forest = ways(&edges, forest, way)?;
    let Packed { triangles, of_vertices, of_edges } = cells;
    let buffers = CellBuffers { triangles, quads: &mut [], of_vertices, of_edges };
    let cells = pack(&mesh, &edges, stiffness, &[], &COMPLIANCE, &forest, buffers)?;
    let metric = Metric::default();
    let boundary = Boundary::<f32, u16>::new(&edges, &[], &[], &[])?;
    let reach = reach(&edges, &cells, metric, &boundary, &forest, way)?;
    let ground = Ground { mesh, edges, stiffness, cells, metric, reach };
    Ok((ground, tick.lend(&edges)?))
}

/// 1 / (4 det A)
static COMPLIANCE: [f32; TRIANGLES] = [0.25 / (CONDUCTIVITY * CONDUCTIVITY); TRIANGLES];

/// The way out of each cell: heat may leave through the structure alone.
fn ways(
    edges: &Edges<u16>,
    forest: &'static mut [[u16; TRIANGLES]; 3],
    distance: &mut [f32],
) -> Result<Forest<'static, u16>, Error> {
    let [order, parent, place] = forest;
    let boundary = Boundary::<f32, u16>::new(edges, &[], &[], &[])?;
    let buffers = ForestBuffers { order, parent, place, distance };
    grow(edges, |_| 1.0, |edge| is_root(edges, &boundary, edge), buffers)?;
    Forest::new(edges, order, parent, place)
}

impl Numbered {
    fn number(&'static mut self, mesh: &Mesh<f32, u16>) -> Result<Edges<'static, u16>, Error> {
        let Self { of_triangles, half_edges, at_vertex, next } = self;
        let buffers =
            NumberingBuffers { of_triangles, of_quads: &mut [], half_edges, at_vertex, next };
        number(mesh, buffers, |ends| Some(block(ends)))
    }
}

impl Changing {
    fn lend(
        &'static mut self,
        edges: &Edges<u16>,
    ) -> Result<tick::Memory<'static, f32, u16, { rows::TRIANGLES }>, Error> {
        let Self { rows, load, active, vertices, tau, u } = self;
        let rows = Rows::new(edges, rows)?;
        Ok(tick::Memory { rows, load, active, vertices, bubbles: &mut [], tau, u })
    }
}
