//! A mesh of triangles and quads, mixed freely: borrowed arrays, validated once.
//!
//! Cells of one kind stand together, so that every loop over cells has a fixed shape and a mesh
//! without quads needs no quad code. Where cells have one number, triangles come first.
//!
//! ```text
//!   triangle [a, b, c]        quad [a, b, c, d]
//!            c                    d --side 2-- c
//!    side 2 / \ side 1     side 3 |            | side 1      counterclockwise;
//!          a---b                  a --side 0-- b             side k runs from vertex k to k + 1
//!          side 0
//! ```
//!
//! [`numbering`] and [`edges`] give the unknowns; [`boundary`] says what holds on the boundary, [`diagonal`] what K has
//! beyond the element matrices, [`components`] whether a solution exists.

pub mod boundary;
pub mod components;
pub mod diagonal;
pub mod edges;
pub mod geometry;
pub mod numbering;

use crate::error::{Array, CellId, Error};
use crate::index::{Index, read};
use crate::real::Real;

/// A validated mesh. Every cell is strictly convex and runs counterclockwise.
#[derive(Debug, Clone, Copy)]
pub struct Mesh<'a, R, I> {
    vertices: &'a [[R; 2]],
    triangles: &'a [[I; 3]],
    quads: &'a [[I; 4]],
}

impl<'a, R: Real, I: Index> Mesh<'a, R, I> {
    /// Borrows `vertices` (coordinates in one length unit) and cells (counterclockwise vertices).
    ///
    /// # Errors
    /// Names the first vertex or cell that is not finite, out of range, degenerate, clockwise or
    /// not convex, or the array that the index type cannot number.
    pub fn new(
        vertices: &'a [[R; 2]],
        triangles: &'a [[I; 3]],
        quads: &'a [[I; 4]],
    ) -> Result<Self, Error> {
        let mesh = Self { vertices, triangles, quads };
        mesh.check_capacity()?;
        if let Some(at) = vertices.iter().position(|v| !(v[0].finite() && v[1].finite())) {
            return Err(Error::NotFinite { of: Array::Vertices, at });
        }
        for (at, triangle) in triangles.iter().enumerate() {
            mesh.check_indices(Array::Triangles, at, triangle)?;
            geometry::check_corners(&mesh.triangle(triangle), CellId::Triangle(at))?;
        }
        for (at, quad) in quads.iter().enumerate() {
            mesh.check_indices(Array::Quads, at, quad)?;
            geometry::check_corners(&mesh.quad(quad), CellId::Quad(at))?;
        }
        Ok(mesh)
    }

    /// Takes a mesh that [`Mesh::new`] took on the host, for a `static`.
    pub const fn baked(
        vertices: &'a [[R; 2]],
        triangles: &'a [[I; 3]],
        quads: &'a [[I; 4]],
    ) -> Self {
        Self { vertices, triangles, quads }
    }

    fn check_capacity(&self) -> Result<(), Error> {
        let limit = I::LIMIT;
        let half_edges = self.half_edges();
        let fits = |of, needed| {
            if needed <= limit { Ok(()) } else { Err(Error::Capacity { of, needed, limit }) }
        };
        fits(Array::Vertices, self.vertices.len())?;
        fits(Array::HalfEdges, half_edges)
    }

    fn check_indices(&self, of: Array, at: usize, cell: &[I]) -> Result<(), Error> {
        if cell.iter().any(|vertex| vertex.at() >= self.vertices.len()) {
            return Err(Error::OutOfRange { of, at });
        }
        let id = if of == Array::Quads { CellId::Quad(at) } else { CellId::Triangle(at) };
        let repeated = (1..cell.len()).any(|k| {
            cell.get(..k)
                .is_some_and(|head| cell.get(k).is_some_and(|vertex| head.contains(vertex)))
        });
        if repeated { Err(Error::RepeatedVertex(id)) } else { Ok(()) }
    }

    /// Vertex coordinates.
    pub const fn vertices(&self) -> &'a [[R; 2]] {
        self.vertices
    }

    /// Vertices of the triangles.
    pub fn triangles(&self) -> &'a [[I; 3]] {
        self.triangles
    }

    /// Vertices of the quads.
    pub const fn quads(&self) -> &'a [[I; 4]] {
        self.quads
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.triangles.len() + self.quads.len()
    }

    /// Number of half-edges, the sides of all cells: 3 a triangle, then 4 a quad.
    pub fn half_edges(&self) -> usize {
        self.triangles.len().saturating_mul(3).saturating_add(self.quads.len().saturating_mul(4))
    }

    /// The corners of a triangle.
    pub fn triangle(&self, vertices: &[I; 3]) -> [[R; 2]; 3] {
        self.corners(vertices).unwrap_or_default()
    }

    /// `None` where a vertex is not one of this mesh.
    #[inline(always)]
    pub(crate) fn corners(&self, &[a, b, c]: &[I; 3]) -> Option<[[R; 2]; 3]> {
        let at = |vertex: I| self.vertices.get(vertex.at()).copied();
        Some([at(a)?, at(b)?, at(c)?])
    }

    /// The corners of a quad.
    pub fn quad(&self, vertices: &[I; 4]) -> [[R; 2]; 4] {
        vertices.map(|vertex| read(self.vertices, vertex.at()))
    }
}
