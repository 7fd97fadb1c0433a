//! Edges as a binary forest: an edge that is halved stays, with two halves that meet in its midpoint.
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
