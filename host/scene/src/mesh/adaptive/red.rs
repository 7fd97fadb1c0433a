//! Red refinement: a cell becomes four of its kind, with midpoints shared across edges.
//!
//! ```text
//!         c                 d ──n── c
//!        ╱ ╲                │   │   │       children in the order of their corners a, b, c, d;
//!       n───m               o───z───m       in a triangle then the middle one
//!      ╱ ╲ ╱ ╲              │   │   │
//!     a───l───b             a ──l── b
//! ```
//! z is the mean of the corners, where both lines between opposite midpoints meet: quads remain strictly convex. The children of a
//! triangle are similar to it. Those of a quad are images of quarters of the unit square under the map of the whole, so that no
//! Jacobian of theirs is less than a quarter of its least.

use super::forest::{Cell, Edges, Forest, NONE};
use crate::mesh::shape::mean;

/// Vertices and edges while cells are refined.
struct Growth {
    vertices: Vec<[f64; 2]>,
    edges: Edges,
}

/// A forest grown, and where its cells come from.
pub(super) struct Grown {
    pub(super) vertices: Vec<[f64; 2]>,
    pub(super) forest: Forest,
    /// For each cell the one of the old forest that it is, or is a child of.
    pub(super) parents: Vec<u32>,
}

/// The forest with all of its cells refined; midpoints are numbered as the edges are.
pub(super) fn all(vertices: &[[f64; 2]], forest: &Forest) -> Grown {
    let mut growth = Growth::new(vertices, forest);
    for edge in 0..forest.edges.len() as u32 {
        growth.midpoint(edge);
    }
    growth.of(forest, &vec![true; forest.cells()])
}

/// The forest with some of its cells refined; children stand where their parent stood.
pub(super) fn grown(vertices: &[[f64; 2]], forest: &Forest, refined: &[bool]) -> Grown {
    Growth::new(vertices, forest).of(forest, refined)
}

/// Cells with the refined ones replaced by their children, and the parent of each.
fn replaced<const N: usize>(
    cells: &[Cell<N>],
    refined: &[bool],
    mut children: impl FnMut(&Cell<N>) -> [Cell<N>; 4],
) -> (Vec<u32>, Vec<Cell<N>>) {
    let mut all = (Vec::with_capacity(cells.len()), Vec::with_capacity(cells.len()));
    for ((parent, cell), &refined) in (0..).zip(cells).zip(refined) {
        if refined {
            all.extend(children(cell).map(|child| (parent, child)));
        } else {
            all.extend([(parent, *cell)]);
        }
    }
    all
}

impl Growth {
    fn new(vertices: &[[f64; 2]], forest: &Forest) -> Self {
        Self { vertices: vertices.to_vec(), edges: forest.edges.clone() }
    }

    fn of(mut self, forest: &Forest, refined: &[bool]) -> Grown {
        let (of_triangles, of_quads) = refined.split_at(forest.triangles.len());
        let (mut parents, triangles) =
            replaced(&forest.triangles, of_triangles, |cell| self.triangle(cell));
        let (of_quads, quads) = replaced(&forest.quads, of_quads, |cell| self.quad(cell));
        parents.extend(of_quads.into_iter().map(|quad| forest.triangles.len() as u32 + quad));
        let Self { vertices, edges } = self;
        Grown { vertices, forest: Forest { edges, triangles, quads }, parents }
    }

    fn triangle(&mut self, cell: &Cell<3>) -> [Cell<3>; 4] {
        let Cell { corners: [a, b, c], sides, root } = *cell;
        let [l, m, n] = sides.map(|side| self.midpoint(side));
        let [nl, lm, mn] = [[n, l], [l, m], [m, n]].map(|ends| self.edges.add(ends));
        let [[al, bl], [bm, cm], [cn, an]] = self.halves([[a, b], [b, c], [c, a]], sides);
        let child = |corners, sides| Cell { corners, sides, root };
        [
            child([a, l, n], [al, nl, an]),
            child([l, b, m], [bl, bm, lm]),
            child([n, m, c], [mn, cm, cn]),
            child([m, n, l], [mn, nl, lm]),
        ]
    }

    fn quad(&mut self, cell: &Cell<4>) -> [Cell<4>; 4] {
        let Cell { corners: [a, b, c, d], sides, root } = *cell;
        let [l, m, n, o] = sides.map(|side| self.midpoint(side));
        let z = self.vertex(mean(&self.vertices, &cell.corners));
        let [lz, mz, nz, oz] = [l, m, n, o].map(|middle| self.edges.add([middle, z]));
        let ends = [[a, b], [b, c], [c, d], [d, a]];
        let [[al, bl], [bm, cm], [cn, dn], [d_o, ao]] = self.halves(ends, sides);
        let child = |corners, sides| Cell { corners, sides, root };
        [
            child([a, l, z, o], [al, lz, oz, ao]),
            child([l, b, m, z], [bl, bm, mz, lz]),
            child([z, m, c, n], [mz, cm, cn, nz]),
            child([o, z, n, d], [oz, nz, dn, d_o]),
        ]
    }

    /// The midpoint of an edge, made where there was none.
    fn midpoint(&mut self, edge: u32) -> u32 {
        self.edges.midpoint(edge).unwrap_or_else(|| {
            let midpoint = self.vertex(mean(&self.vertices, &self.edges.ends(edge)));
            self.edges.halve(edge, midpoint);
            midpoint
        })
    }

    fn vertex(&mut self, point: [f64; 2]) -> u32 {
        self.vertices.push(point);
        self.vertices.len() as u32 - 1
    }

    /// The halves of sides, in the order in which the sides run through their ends.
    fn halves<const N: usize>(&self, ends: [[u32; 2]; N], sides: [u32; N]) -> [[u32; 2]; N] {
        std::array::from_fn(|k| {
            // All sides have midpoints by now.
            let [first, second] = self.edges.halves(sides[k]).unwrap_or([NONE; 2]);
            let forwards = self.edges.ends(sides[k])[0] == ends[k][0];
            if forwards { [first, second] } else { [second, first] }
        })
    }
}
