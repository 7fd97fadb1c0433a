//! The cells that red refinement has made, with nodes left hanging in their sides.
//!
//! Sides are edges by number, side k from corner k to corner k + 1. A side whose edge is halved has a
//! hanging node. Edges are a binary forest: one that is halved stays, with two halves that meet in its midpoint.
//!
//! ```text
//!   whole    a ─────────── b        ends [a, b], a < b
//!   halves   a ─── m  m ── b        ends [a, m] and [b, m]: the midpoint is younger than both
//! ```
//! Edges are told apart by their numbers: the two sides of a slit have midpoints of their own.

/// Stands for no edge and no vertex.
pub(super) const NONE: u32 = u32::MAX;

#[derive(Debug, Clone, Copy)]
struct Edge {
    ends: [u32; 2],
    /// The edge that this is a half of.
    whole: u32,
    /// The first of its halves; the other one follows it.
    halves: u32,
}

/// All edges that there ever were.
#[derive(Debug, Clone)]
pub(super) struct Edges {
    all: Vec<Edge>,
}

impl Edges {
    /// Edges of which none is halved.
    pub(super) fn of(ends: &[[u32; 2]]) -> Self {
        let whole = |&ends: &[u32; 2]| Edge { ends, whole: NONE, halves: NONE };
        Self { all: ends.iter().map(whole).collect() }
    }

    pub(super) fn len(&self) -> usize {
        self.all.len()
    }

    /// The vertices of an edge, the older one first.
    pub(super) fn ends(&self, edge: u32) -> [u32; 2] {
        self.all[edge as usize].ends
    }

    /// The edge that this one is a half of.
    pub(super) fn whole(&self, edge: u32) -> Option<u32> {
        Some(self.all[edge as usize].whole).filter(|&whole| whole != NONE)
    }

    /// The halves of an edge.
    pub(super) fn halves(&self, edge: u32) -> Option<[u32; 2]> {
        let first = self.all[edge as usize].halves;
        (first != NONE).then(|| [first, first + 1])
    }

    /// Where the halves of an edge meet.
    pub(super) fn midpoint(&self, edge: u32) -> Option<u32> {
        self.halves(edge).map(|[half, _]| self.ends(half)[1])
    }

    /// The whole ones of `edges`, and the halves of the others.
    pub(super) fn halved(&self, edges: &[u32]) -> Vec<u32> {
        let mut parts = Vec::with_capacity(edges.len());
        for &edge in edges {
            match self.halves(edge) {
                None => parts.push(edge),
                Some(halves) => parts.extend(halves),
            }
        }
        parts
    }

    /// Adds an edge between two vertices.
    pub(super) fn add(&mut self, [a, b]: [u32; 2]) -> u32 {
        self.push([a.min(b), a.max(b)], NONE)
    }

    /// Halves an edge at a vertex younger than its ends.
    pub(super) fn halve(&mut self, edge: u32, midpoint: u32) -> [u32; 2] {
        let halves = self.ends(edge).map(|end| self.push([end, midpoint], edge));
        self.all[edge as usize].halves = halves[0];
        halves
    }

    fn push(&mut self, ends: [u32; 2], whole: u32) -> u32 {
        self.all.push(Edge { ends, whole, halves: NONE });
        self.all.len() as u32 - 1
    }
}

/// A triangle (N = 3) or a quad (N = 4).
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell<const N: usize> {
    /// Its vertices, counterclockwise.
    pub(super) corners: [u32; N],
    /// Its edges.
    pub(super) sides: [u32; N],
    /// The cell of the base mesh that it lies in.
    pub(super) root: u32,
}

/// Cells by kind, numbered triangles first.
#[derive(Debug, Clone)]
pub(super) struct Forest {
    pub(super) edges: Edges,
    pub(super) triangles: Vec<Cell<3>>,
    pub(super) quads: Vec<Cell<4>>,
}

impl Forest {
    /// Number of cells.
    pub(super) fn cells(&self) -> usize {
        self.triangles.len() + self.quads.len()
    }

    /// The edges of a cell.
    pub(super) fn sides(&self, cell: u32) -> &[u32] {
        match (cell as usize).checked_sub(self.triangles.len()) {
            None => &self.triangles[cell as usize].sides,
            Some(quad) => &self.quads[quad].sides,
        }
    }

    /// The one or two cells that have an edge as a side, for each edge.
    pub(super) fn sharing(&self) -> Vec<[u32; 2]> {
        let mut sharing = vec![[NONE; 2]; self.edges.len()];
        for cell in 0..self.cells() as u32 {
            for &side in self.sides(cell) {
                let [first, second] = &mut sharing[side as usize];
                *if *first == NONE { first } else { second } = cell;
            }
        }
        sharing
    }
}
