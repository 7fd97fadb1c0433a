//! Edges by number: the cells that they join, and the kind of each.

use std::iter::successors;

use signorini_kernel::Error as KernelError;
use signorini_kernel::error::CellId;
use signorini_kernel::mesh::Mesh as KernelMesh;
use signorini_kernel::mesh::edges::{Block, EdgeCounts, Edges};
use signorini_kernel::mesh::numbering::{NumberingBuffers, number};

use super::Binding;
use signorini_scene::error::{InputError, Result};
use signorini_scene::mesh::Mesh;
use signorini_scene::scene::{Condition, Scene};

/// Kind of an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeKind {
    /// Between two cells.
    Interior,
    /// Given value.
    Dirichlet,
    /// Given flux.
    Neumann,
    /// Transfer law.
    Robin,
    /// Unilateral contact.
    Contact,
}

impl EdgeKind {
    /// Its name in `edges.csv`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Interior => "interior",
            Self::Dirichlet => "dirichlet",
            Self::Neumann => "neumann",
            Self::Robin => "robin",
            Self::Contact => "contact",
        }
    }

    pub(super) fn of(condition: &Condition) -> Self {
        match condition {
            Condition::Dirichlet { .. } => Self::Dirichlet,
            Condition::Neumann { .. } => Self::Neumann,
            Condition::Robin { .. } => Self::Robin,
            Condition::Contact { .. } => Self::Contact,
        }
    }

    /// Whether its flux is given: that of an answer may be compared with it.
    pub fn has_given_flux(self) -> bool {
        match self {
            Self::Neumann => true,
            Self::Interior | Self::Dirichlet | Self::Robin | Self::Contact => false,
        }
    }

    /// Where its edges stand among all.
    pub fn block(self) -> Block {
        match self {
            Self::Interior | Self::Neumann | Self::Robin => Block::Free,
            Self::Contact => Block::Contact,
            Self::Dirichlet => Block::Dirichlet,
        }
    }
}

/// Edge numbering of a mesh, owned; see [`signorini_kernel::mesh::edges`] for the order.
#[derive(Debug, Clone, Default)]
pub struct Topology {
    /// The edge of each side of each triangle.
    pub of_triangles: Vec<[u32; 3]>,
    /// The edge of each side of each quad.
    pub of_quads: Vec<[u32; 4]>,
    /// The half-edges of each edge.
    pub half_edges: Vec<[u32; 2]>,
    /// Sizes of the blocks.
    pub counts: EdgeCounts,
}

impl Topology {
    /// The kernel's view of it.
    ///
    /// # Errors
    /// Never for a topology that [`super::Problem::new`] made.
    pub fn edges(&self) -> std::result::Result<Edges<'_, u32>, KernelError> {
        Edges::new(&self.of_triangles, &self.of_quads, &self.half_edges, self.counts)
    }

    /// The edges of a cell's sides, triangles first.
    pub fn edges_of(&self, cell: usize) -> &[u32] {
        match self.of_triangles.get(cell) {
            Some(edges) => edges,
            None => &self.of_quads[cell - self.of_triangles.len()],
        }
    }

    /// The cell (triangles first) and the side of it that an edge is directed along; its normal
    /// points out of that cell.
    pub fn first_side(&self, edge: usize) -> (usize, usize) {
        self.side(self.half_edges[edge][0])
    }

    /// The cells (triangles first) and sides of an inner edge.
    pub fn sides_of(&self, edge: usize) -> [(usize, usize); 2] {
        self.half_edges[edge].map(|half| self.side(half))
    }

    /// The cells on both sides of an edge, triangles first; no second one on the boundary.
    pub fn cells_of(&self, edge: usize) -> [Option<usize>; 2] {
        self.half_edges[edge].map(|half| (half != u32::MAX).then(|| self.side(half).0))
    }

    /// Whether an edge has a cell on one side alone.
    pub(super) fn is_outer(&self, edge: usize) -> bool {
        self.half_edges[edge][1] == u32::MAX
    }

    /// The edges of the sector at `vertex` that the boundary edge `edge` is one side of, from there to the other side, each with the
    /// cell behind it; `ends` are the ends of all edges.
    pub(super) fn sector(
        &self,
        ends: &[[u32; 2]],
        vertex: u32,
        edge: usize,
    ) -> impl Iterator<Item = (usize, Option<usize>)> {
        successors(Some((edge, Some(self.first_side(edge).0))), move |&(edge, cell)| {
            let of_cell = self.edges_of(cell?).iter().map(|&of| of as usize);
            let mut others = of_cell.filter(|&of| of != edge && ends[of].contains(&vertex));
            let next = others.next()?;
            Some((next, self.beyond(next, cell?)))
        })
        // A fan that closes would end nowhere.
        .take(ends.len())
    }

    /// The cell (triangles first) on the other side of an edge than `cell`; none beyond the boundary.
    fn beyond(&self, edge: usize, cell: usize) -> Option<usize> {
        self.cells_of(edge).into_iter().flatten().find(|&other| other != cell)
    }

    /// The cell and the side of it that a half-edge is.
    fn side(&self, half: u32) -> (usize, usize) {
        let (triangles, half) = (self.of_triangles.len(), half as usize);
        match half.checked_sub(3 * triangles) {
            None => (half / 3, half % 3),
            Some(rest) => (triangles + rest / 4, rest % 4),
        }
    }

    /// Numbers the edges of `mesh`, which the kernel has seen as `kernel_mesh`; with the boundary edges that no table covers.
    pub(super) fn number(
        scene: &Scene,
        mesh: &Mesh,
        kernel_mesh: &KernelMesh<f64, u32>,
        binding: &Binding,
    ) -> Result<(Self, Vec<[u32; 2]>)> {
        let sides = kernel_mesh.half_edges();
        let mut topology = Self {
            of_triangles: vec![[0; 3]; mesh.triangles.len()],
            of_quads: vec![[0; 4]; mesh.quads.len()],
            half_edges: vec![[0; 2]; sides],
            counts: EdgeCounts::default(),
        };
        let buffers = NumberingBuffers {
            of_triangles: &mut topology.of_triangles,
            of_quads: &mut topology.of_quads,
            half_edges: &mut topology.half_edges,
            at_vertex: &mut vec![[0; 2]; mesh.vertices.len()],
            next: &mut vec![0; sides],
        };
        let mut uncovered = Vec::new();
        let block = |ends| match binding.boundary(ends) {
            Some(boundary) => Some(EdgeKind::of(&scene.boundaries[boundary].condition).block()),
            None => {
                uncovered.push(ends);
                Some(Block::Free)
            }
        };
        let counts = number(kernel_mesh, buffers, block).map(|edges| edges.counts());
        topology.counts = counts.map_err(|error| wrong_mesh(scene, error))?;
        topology.half_edges.truncate(topology.counts.edges());
        Ok((topology, uncovered))
    }
}

/// A mesh that the kernel refuses.
pub(super) fn wrong_mesh(scene: &Scene, error: KernelError) -> InputError {
    let what = match error {
        KernelError::Degenerate(CellId::Triangle(_) | CellId::Quad(_)) => {
            "the mesh has a cell too thin for the scalar type"
        }
        _ => "the mesh is not usable",
    };
    InputError::new(format!("{what}: {error}"))
        .file(&scene.mesh.value)
        .hint("cells are numbered from 0, triangles first, in the order of the file")
}
