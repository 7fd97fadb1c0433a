//! Edges: which cells they join, and the order that makes them unknowns.
//!
//! A *half-edge* is one side of one cell, numbered 3t + k for side k of triangle t and, behind all of
//! those, 3T + 4q + k for side k of quad q. An edge has one half-edge (boundary) or two, and is
//! directed along its first one: its normal n points out of its first cell.
//!
//! The order is the layout of every array over edges, and of the unknowns:
//! ```text
//!   | free: interior, Neumann, Robin | contact | Dirichlet |
//!   0 ............................ free .... unknowns .... edges
//! ```
//! so that a sweep needs no test of the kind of an edge, contact bounds are an array of their own,
//! and u_D simply stands in u behind the unknowns.

use crate::error::{Array, Error, known, same_length};
use crate::index::{Index, read};
use crate::mesh::geometry::scaled_normal;
use crate::{Math, Mesh, Real, features};

/// Where an edge stands in the order of the unknowns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Block {
    /// Inside the domain, Neumann or Robin: an unknown that no law of contact holds.
    Free,
    /// Contact: an unknown that the law of contact holds at, above or below its gap.
    Contact,
    /// Dirichlet: not an unknown.
    Dirichlet,
}

/// How many edges stand in each block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct EdgeCounts {
    /// Unknowns off contact.
    pub free: usize,
    /// Unknowns on contact.
    pub contact: usize,
    /// Edges with a given value.
    pub dirichlet: usize,
}

impl EdgeCounts {
    /// Edges not on the Dirichlet boundary.
    pub const fn unknowns(&self) -> usize {
        self.free.saturating_add(self.contact)
    }

    /// All edges.
    pub const fn edges(&self) -> usize {
        self.unknowns().saturating_add(self.dirichlet)
    }

    /// Where a block begins.
    pub fn start(&self, block: Block) -> usize {
        match block {
            Block::Free => 0,
            Block::Contact => self.free,
            Block::Dirichlet => self.unknowns(),
        }
    }

    /// The block that an edge stands in.
    pub fn block(&self, edge: usize) -> Block {
        if edge < self.free {
            Block::Free
        } else if edge < self.unknowns() {
            Block::Contact
        } else {
            Block::Dirichlet
        }
    }

    pub(crate) fn of(&mut self, block: Block) -> &mut usize {
        match block {
            Block::Free => &mut self.free,
            Block::Contact => &mut self.contact,
            Block::Dirichlet => &mut self.dirichlet,
        }
    }
}

/// A side of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Side `.1` of triangle `.0`.
    Triangle(usize, usize),
    /// Side `.1` of quad `.0`.
    Quad(usize, usize),
}

/// The numbered edges of a mesh (borrowed, validated).
#[derive(Debug, Clone, Copy)]
pub struct Edges<'a, I> {
    of_triangles: &'a [[I; 3]],
    of_quads: &'a [[I; 4]],
    half_edges: &'a [[I; 2]],
    counts: EdgeCounts,
}

impl<'a, I: Index> Edges<'a, I> {
    /// Takes edges numbered elsewhere: the edge of each side of each cell, the half-edges of each
    /// edge ([`Index::NONE`] in second place on the boundary), and the sizes of the blocks.
    ///
    /// # Errors
    /// Lengths that do not match, any half-edge whose side does not lead back to its edge, and kinds of
    /// cells and edges that this build of the kernel has no code for ([`features`]).
    pub fn new(
        of_triangles: &'a [[I; 3]],
        of_quads: &'a [[I; 4]],
        half_edges: &'a [[I; 2]],
        counts: EdgeCounts,
    ) -> Result<Self, Error> {
        let edges = Self { of_triangles, of_quads, half_edges, counts };
        known(Array::Triangles, features::TRIANGLES, of_triangles.len())?;
        known(Array::Quads, features::QUADS, of_quads.len())?;
        known(Array::Contact, features::CONTACT, counts.contact)?;
        same_length(Array::Edges, half_edges.len(), counts.edges())?;
        let sides = of_triangles.len() * 3 + of_quads.len() * 4;
        let mut seen = 0;
        for (at, pair) in half_edges.iter().enumerate() {
            let inner = pair[1] != I::NONE;
            let leads_back = |half: I| half.at() < sides && edges.edge_of(half.at()) == at;
            if !leads_back(pair[0]) || inner && !(leads_back(pair[1]) && pair[0] != pair[1]) {
                return Err(Error::OutOfRange { of: Array::HalfEdges, at });
            }
            seen += 1 + usize::from(inner);
        }
        // Each half-edge leads to one edge, which knows it: with equal counts none is left over.
        same_length(Array::HalfEdges, seen, sides)?;
        Ok(edges)
    }

    /// Takes edges that [`Edges::new`] took on the host, for a `static`. Other numbers make wrong answers and
    /// nothing worse.
    pub const fn baked(
        of_triangles: &'a [[I; 3]],
        of_quads: &'a [[I; 4]],
        half_edges: &'a [[I; 2]],
        counts: EdgeCounts,
    ) -> Self {
        Self { of_triangles, of_quads, half_edges, counts }
    }

    /// The edge of each side of each triangle.
    pub fn of_triangles(&self) -> &'a [[I; 3]] {
        self.of_triangles
    }

    /// The edge of each side of each quad.
    pub fn of_quads(&self) -> &'a [[I; 4]] {
        self.of_quads
    }

    /// The one or two half-edges of each edge.
    pub fn half_edges(&self) -> &'a [[I; 2]] {
        self.half_edges
    }

    /// Sizes of the blocks.
    pub const fn counts(&self) -> EdgeCounts {
        self.counts
    }

    /// Number of entries of the matrix: each unknown's own, and the other sides of its cells.
    pub fn nonzeros(&self) -> usize {
        let triangles = self.of_triangles.len() * 3;
        let others = |half: &I| match *half {
            half if half == I::NONE => 0,
            half if half.at() < triangles => 2,
            _ => 3,
        };
        let unknowns = self.half_edges.iter().take(self.counts.unknowns());
        unknowns.map(|pair| 1 + pair.iter().map(others).sum::<usize>()).sum()
    }

    /// The cell and side that a half-edge stands for.
    pub fn side(&self, half_edge: usize) -> Side {
        side(self.of_triangles.len(), half_edge)
    }

    /// Number of cells: triangles, then quads.
    pub fn cells(&self) -> usize {
        self.of_triangles.len() + self.of_quads.len()
    }

    /// The cell that a half-edge is a side of, triangles first.
    pub fn cell_of(&self, half_edge: usize) -> Option<usize> {
        let cell = match self.side(half_edge) {
            Side::Triangle(at, _) => at,
            Side::Quad(at, _) => self.of_triangles.len() + at,
        };
        (cell < self.cells()).then_some(cell)
    }

    /// The half-edges of a cell.
    pub fn sides_of(&self, cell: usize) -> core::ops::Range<usize> {
        let triangles = self.of_triangles.len();
        match cell.checked_sub(triangles) {
            None => 3 * cell..3 * cell + 3,
            Some(quad) => 3 * triangles + 4 * quad..3 * triangles + 4 * quad + 4,
        }
    }

    /// The other half-edge of a half-edge's edge, and its cell; `None` on the boundary.
    pub fn beyond(&self, half_edge: usize) -> Option<(I, usize)> {
        let [first, second] = read(self.half_edges, self.edge_of(half_edge));
        let other = if first.at() == half_edge { second } else { first };
        if other == I::NONE { None } else { Some((other, self.cell_of(other.at())?)) }
    }

    /// The first side of an edge: its normal points out of that cell.
    pub fn first_side(&self, edge: usize) -> Side {
        self.side(read(self.half_edges, edge)[0].at())
    }

    /// The other sides of an edge's cells: those of its first cell, then those of its second, each
    /// counterclockwise from the edge. A row of the matrix has this order.
    pub fn neighbours(&self, edge: usize) -> impl Iterator<Item = I> + use<'a, I> {
        let edges = *self;
        let halves = read(self.half_edges, edge).into_iter().filter(|&half| half != I::NONE);
        halves.flat_map(move |half| edges.others(half.at()).into_iter().filter(|&i| i != I::NONE))
    }

    /// The edges of the other sides of a half-edge's cell, counterclockwise.
    fn others(&self, half_edge: usize) -> [I; 3] {
        match self.side(half_edge) {
            Side::Triangle(at, side) => {
                let sides = read(self.of_triangles, at);
                [read(&sides, (side + 1) % 3), read(&sides, (side + 2) % 3), I::NONE]
            }
            Side::Quad(at, side) => {
                let sides = read(self.of_quads, at);
                [1, 2, 3].map(|k| read(&sides, (side + k) % 4))
            }
        }
    }

    /// Start and end vertex of an edge, counterclockwise around its first cell.
    pub fn endpoints<R: Real>(&self, mesh: &Mesh<R, I>, edge: usize) -> [I; 2] {
        endpoints(mesh, read(self.half_edges, edge)[0].at())
    }

    /// Length of an edge, in the length unit of the mesh.
    pub fn length<R: Real, M: Math<R>>(&self, mesh: &Mesh<R, I>, edge: usize) -> R {
        let ends = self.endpoints(mesh, edge);
        let [a, b] = ends.map(|vertex| read(mesh.vertices(), vertex.at()));
        M::sqrt(scaled_normal(a, b).norm_squared())
    }

    /// The edge that a half-edge is one side of.
    pub fn edge_of(&self, half_edge: usize) -> usize {
        match self.side(half_edge) {
            Side::Triangle(at, side) => read(&read(self.of_triangles, at), side).at(),
            Side::Quad(at, side) => read(&read(self.of_quads, at), side).at(),
        }
    }
}

fn side(triangles: usize, half_edge: usize) -> Side {
    if !features::QUADS {
        return Side::Triangle(half_edge / 3, half_edge % 3);
    }
    if !features::TRIANGLES {
        return Side::Quad(half_edge / 4, half_edge % 4);
    }
    match half_edge.checked_sub(3 * triangles) {
        None => Side::Triangle(half_edge / 3, half_edge % 3),
        Some(rest) => Side::Quad(rest / 4, rest % 4),
    }
}

/// Start and end vertex of a half-edge.
pub(crate) fn endpoints<R: Real, I: Index>(mesh: &Mesh<R, I>, half_edge: usize) -> [I; 2] {
    match side(mesh.triangles().len(), half_edge) {
        // Vertices of all triangles one after the other are numbered as half-edges are.
        Side::Triangle(_, k) => {
            let next = if k == 2 { half_edge - 2 } else { half_edge + 1 };
            [half_edge, next].map(|at| read(mesh.triangles().as_flattened(), at))
        }
        Side::Quad(at, k) => {
            let vertices = read(mesh.quads(), at);
            [read(&vertices, k), read(&vertices, (k + 1) % 4)]
        }
    }
}
