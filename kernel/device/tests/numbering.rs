//! Sides of a mesh, and numbers of its edges.

use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::edges::{Block, EdgeCounts, Edges};
use signorini_kernel::mesh::numbering::{NumberingBuffers, number};
use signorini_kernel::{Error, Real};

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

/// Numbers of the edges of a mesh.
#[derive(Clone)]
pub struct Numbering {
    of_triangles: Vec<[u16; 3]>,
    of_quads: Vec<[u16; 4]>,
    half_edges: Vec<[u16; 2]>,
    pub counts: EdgeCounts,
}

impl Numbering {
    pub fn new<R: Real>(
        mesh: &Mesh<R, u16>,
        mut block: impl FnMut([u16; 2]) -> Block,
    ) -> Result<Self, Error> {
        let mut of_triangles = vec![[NONE; 3]; mesh.triangles().len()];
        let mut of_quads = vec![[NONE; 4]; mesh.quads().len()];
        let mut half_edges = vec![[NONE; 2]; mesh.half_edges()];
        let buffers = NumberingBuffers {
            of_triangles: &mut of_triangles,
            of_quads: &mut of_quads,
            half_edges: &mut half_edges,
            at_vertex: &mut vec![[NONE; 2]; mesh.vertices().len()],
            next: &mut vec![NONE; mesh.half_edges()],
        };
        let counts = number(mesh, buffers, |ends| Some(block(ends)))?.counts();
        half_edges.truncate(counts.edges());
        Ok(Self { of_triangles, of_quads, half_edges, counts })
    }

    pub fn edges(&self) -> Result<Edges<'_, u16>, Error> {
        Edges::new(&self.of_triangles, &self.of_quads, &self.half_edges, self.counts)
    }
}
