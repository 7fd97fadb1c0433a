//! Grids, sides of a mesh, and numbers of its edges.

use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::edges::{Block, EdgeCounts, Edges};
use signorini_kernel::mesh::numbering::{NumberingBuffers, number};
use signorini_kernel::{Error, Index, Real};

/// The condition on a side.
#[derive(Clone, Copy, PartialEq)]
pub enum Side {
    Given,
    Insulated,
    Transfer,
    Contact,
}

impl Side {
    /// The block of its edges.
    pub fn block(self) -> Block {
        match self {
            Self::Given => Block::Dirichlet,
            Self::Contact => Block::Contact,
            Self::Insulated | Self::Transfer => Block::Free,
        }
    }
}

/// One side of each kind.
pub const SIDES: [Side; 4] = [Side::Contact, Side::Transfer, Side::Insulated, Side::Given];

/// No half-edge.
pub const NONE: u16 = u16::MAX;

/// How a square becomes cells: whole, or cut from its first corner or from its second one.
pub enum Cut {
    Whole,
    First,
    #[allow(dead_code, reason = "hostile data have it")]
    Second,
}

/// Triangles and quads.
pub type Cells<I> = (Vec<[I; 3]>, Vec<[I; 4]>);

/// The corners of squares of side 1, line by line.
pub fn corners([columns, lines]: [usize; 2]) -> impl Iterator<Item = [f64; 2]> {
    (0..=lines).flat_map(move |j| (0..=columns).map(move |i| [i as f64, j as f64]))
}

/// The cells of these squares.
pub fn cells([columns, lines]: [usize; 2], mut cut: impl FnMut(usize, usize) -> Cut) -> Cells<u16> {
    let vertex = |i: usize, j: usize| (j * (columns + 1) + i) as u16;
    let (mut triangles, mut quads) = (Vec::new(), Vec::new());
    for (i, j) in (0..lines).flat_map(|j| (0..columns).map(move |i| (i, j))) {
        let [a, b] = [vertex(i, j), vertex(i + 1, j)];
        let [c, d] = [vertex(i + 1, j + 1), vertex(i, j + 1)];
        match cut(i, j) {
            Cut::Whole => quads.push([a, b, c, d]),
            Cut::First => triangles.extend([[a, b, c], [a, c, d]]),
            Cut::Second => triangles.extend([[a, b, d], [b, c, d]]),
        }
    }
    (triangles, quads)
}

/// A mesh, and numbers of its edges.
#[derive(Clone)]
pub struct NumberedMesh<R, I = u16> {
    pub vertices: Vec<[R; 2]>,
    pub triangles: Vec<[I; 3]>,
    pub quads: Vec<[I; 4]>,
    of_cells: Cells<I>,
    half_edges: Vec<[I; 2]>,
    pub counts: EdgeCounts,
}

impl<R: Real, I: Index> NumberedMesh<R, I> {
    pub fn new(
        vertices: Vec<[R; 2]>,
        (triangles, quads): Cells<I>,
        mut block: impl FnMut([I; 2]) -> Block,
    ) -> Result<Self, Error> {
        let mesh = Mesh::new(&vertices, &triangles, &quads)?;
        let mut of_cells = (vec![[I::NONE; 3]; triangles.len()], vec![[I::NONE; 4]; quads.len()]);
        let mut half_edges = vec![[I::NONE; 2]; mesh.half_edges()];
        let buffers = NumberingBuffers {
            of_triangles: &mut of_cells.0,
            of_quads: &mut of_cells.1,
            half_edges: &mut half_edges,
            at_vertex: &mut vec![[I::NONE; 2]; vertices.len()],
            next: &mut vec![I::NONE; mesh.half_edges()],
        };
        let counts = number(&mesh, buffers, |ends| Some(block(ends)))?.counts();
        half_edges.truncate(counts.edges());
        Ok(Self { vertices, triangles, quads, of_cells, half_edges, counts })
    }

    pub fn mesh(&self) -> Result<Mesh<'_, R, I>, Error> {
        Mesh::new(&self.vertices, &self.triangles, &self.quads)
    }

    pub fn edges(&self) -> Result<Edges<'_, I>, Error> {
        Edges::new(&self.of_cells.0, &self.of_cells.1, &self.half_edges, self.counts)
    }
}
