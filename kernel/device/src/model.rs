//! One contact problem as plain borrowed arrays: what a host hands to a microcontroller.
//!
//! `signorini export` writes a scene as a `static` of this type, so that the board works on the very
//! numbers of the desk. The arrays are checked where they are used: by [`Mesh::new`], [`Edges::new`]
//! and [`Boundary::new`].

use signorini_kernel::assembly::CellLoads;
use signorini_kernel::mesh::boundary::{Boundary, Neumann, Robin};
use signorini_kernel::mesh::edges::{EdgeCounts, Edges};
use signorini_kernel::stiffness::Stiffness;
use signorini_kernel::{Error, Index, Mesh, Real, Tensor};

/// Mesh, numbering, element matrices and data of one problem. Its parts, where it has several that do not
/// touch, are not told apart: [`signorini_kernel::shift`] then shifts them as one.
#[derive(Debug, Clone, Copy)]
pub struct Model<'a, R, I> {
    /// What to call it.
    pub title: &'a str,
    /// Vertex coordinates, moved into the box \[−1, 1\]².
    pub vertices: &'a [[R; 2]],
    /// Length of one unit of `vertices`, in the length unit of the scene.
    pub unit: R,
    /// Vertices of the triangles.
    pub triangles: &'a [[I; 3]],
    /// Vertices of the quads.
    pub quads: &'a [[I; 4]],
    /// The edge of each side of each triangle.
    pub of_triangles: &'a [[I; 3]],
    /// The edge of each side of each quad.
    pub of_quads: &'a [[I; 4]],
    /// The half-edges of each edge.
    pub half_edges: &'a [[I; 2]],
    /// Sizes of the blocks of edges.
    pub counts: EdgeCounts,
    /// A, one tensor a cell, triangles first; empty where it varies inside a cell.
    pub tensors: &'a [Tensor<R>],
    /// Element matrices.
    pub stiffness: Stiffness<'a, R>,
    /// ∫_T f of every cell.
    pub loads: CellLoads<'a, R>,
    /// Given fluxes.
    pub neumann: &'a [Neumann<R, I>],
    /// Transfer laws.
    pub robin: &'a [Robin<R, I>],
    /// ∫_E q of every contact edge.
    pub contact_flux: &'a [R],
    /// Mean of ψ on every contact edge.
    pub gap: &'a [R],
    /// Where an iteration starts, one value an edge: u_D in its place.
    pub start: &'a [R],
}

impl<'a, R: Real, I: Index> Model<'a, R, I> {
    /// The mesh.
    ///
    /// # Errors
    /// As for [`Mesh::new`].
    pub fn mesh(&self) -> Result<Mesh<'a, R, I>, Error> {
        Mesh::new(self.vertices, self.triangles, self.quads)
    }

    /// The numbered edges.
    ///
    /// # Errors
    /// As for [`Edges::new`].
    pub fn edges(&self) -> Result<Edges<'a, I>, Error> {
        Edges::new(self.of_triangles, self.of_quads, self.half_edges, self.counts)
    }

    /// The conditions on the boundary.
    ///
    /// # Errors
    /// As for [`Boundary::new`].
    pub fn boundary(&self) -> Result<Boundary<'a, R, I>, Error> {
        Boundary::new(&self.edges()?, self.neumann, self.robin, self.contact_flux)
    }
}
