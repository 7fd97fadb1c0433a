//! Packing: turns every cell so that its surplus leaves through the last side, and weighs the means.

use super::{Cell, Cells, Quad, Triangle};
use crate::forest::Forest;
use signorini_kernel::element::entry;
use signorini_kernel::error::{Array, Error, same_length, same_length_or_empty};
use signorini_kernel::index::{Index, read, write};
use signorini_kernel::mesh::edges::Edges;
use signorini_kernel::stiffness::Stiffness;
use signorini_kernel::{Mesh, Real};

/// Memory for [`pack`].
#[derive(Debug)]
pub struct CellBuffers<'a, R, I> {
    /// One entry a triangle.
    pub triangles: &'a mut [Triangle<R, I>],
    /// One entry a quad.
    pub quads: &'a mut [Quad<R, I>],
    /// Becomes 1/Σα of the cells at each vertex.
    pub of_vertices: &'a mut [R],
    /// Becomes 1/Σ(1/α) of the cells of each edge, but 0 on N and R.
    pub of_edges: &'a mut [R],
}

/// Packs the cells; `alpha` holds ½ tr A of every cell, triangles first, or nothing where it is the
/// same everywhere, `compliance` 1/(4 det A) of every triangle (of its mean, where A varies).
///
/// # Errors
/// Arrays of the wrong length.
pub fn pack<'a, R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    edges: &Edges<I>,
    stiffness: Stiffness<R>,
    alpha: &[R],
    compliance: &[R],
    forest: &Forest<'a, I>,
    buffers: CellBuffers<'a, R, I>,
) -> Result<Cells<'a, R, I>, Error> {
    let CellBuffers { triangles, quads, of_vertices, of_edges } = buffers;
    let (t, q) = (mesh.triangles().len(), mesh.quads().len());
    same_length(Array::Triangles, edges.of_triangles().len(), t)?;
    same_length(Array::Quads, edges.of_quads().len(), q)?;
    same_length(Array::Triangles, triangles.len(), t)?;
    same_length(Array::Quads, quads.len(), q)?;
    same_length(Array::Stiffness, stiffness.triangles.len(), t)?;
    same_length(Array::Stiffness, stiffness.quads.len(), q)?;
    same_length(Array::Coefficients, compliance.len(), t)?;
    same_length_or_empty(Array::Coefficients, alpha.len(), t + q)?;
    same_length(Array::Vertices, of_vertices.len(), mesh.vertices().len())?;
    same_length(Array::Edges, of_edges.len(), edges.counts().edges())?;
    let alpha = |cell: usize| alpha.get(cell).copied().unwrap_or(R::ONE);
    let (mut to_triangles, mut to_quads) = (triangles.iter_mut(), quads.iter_mut());
    for (number, parent) in forest.from_leaves() {
        if number < t {
            let Some(cell) = to_triangles.next() else { break };
            let half = 3 * number;
            let side = parent.wrapping_sub(half);
            cell.place(edges, half, side, &read(mesh.triangles(), number));
            cell.k = read(stiffness.triangles, number);
            cell.k.rotate_left((side + 1) % 3);
            cell.find_second(edges, number, forest);
            cell.set_material(number, alpha(number));
            cell.set_compliance(read(compliance, number));
        } else {
            // Halves that go sideways cost quads up to 1.4 times more: no second side there.
            let Some(cell) = to_quads.next() else { break };
            let (quad, half) = (number - t, 3 * t + 4 * (number - t));
            let side = parent.wrapping_sub(half);
            cell.place(edges, half, side, &read(mesh.quads(), quad));
            cell.k = turned(&read(stiffness.quads, quad), side + 1);
            cell.set_material(number, alpha(number));
        }
    }
    let cells = Cells { triangles, quads, of_vertices: &[], of_edges: &[], order: forest.order() };
    weigh(&cells, of_vertices, of_edges);
    // What the cells say of the flux through N and R does not count: the conditions decide.
    let free = of_edges.iter_mut().zip(edges.half_edges()).take(edges.counts().free);
    free.filter(|(_, pair)| pair[1] == I::NONE).for_each(|(weight, _)| *weight = R::ZERO);
    Ok(Cells { of_vertices, of_edges, ..cells })
}

/// The element matrix of a quad whose side `first` is called 0.
fn turned<R: Real>(k: &[R; 6], first: usize) -> [R; 6] {
    let pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    pairs.map(|(i, j)| read(k, entry(4, (i + first) % 4, (j + first) % 4)))
}

fn weigh<R: Real, I: Index>(cells: &Cells<R, I>, of_vertices: &mut [R], of_edges: &mut [R]) {
    of_vertices.fill(R::ZERO);
    of_edges.fill(R::ZERO);
    let mut add = |vertices: &[I], edges: &[I], alpha: R, softness: R| {
        let of = |place: &I, sums: &mut [R], weight: R| {
            let sum = read(sums, place.at()) + weight;
            write(sums, place.at(), sum);
        };
        vertices.iter().for_each(|vertex| of(vertex, of_vertices, alpha));
        edges.iter().for_each(|edge| of(edge, of_edges, softness));
    };
    cells.triangles.iter().for_each(|c| add(&c.vertices, &c.edges, c.alpha, c.softness));
    cells.quads.iter().for_each(|c| add(&c.vertices, &c.edges, c.alpha, c.softness));
    let sums = of_vertices.iter_mut().chain(of_edges);
    sums.filter(|sum| **sum > R::ZERO).for_each(|sum| *sum = R::ONE / *sum);
}

impl<R: Real, I: Index, const SIDES: usize, const ENTRIES: usize> Cell<R, I, SIDES, ENTRIES> {
    /// Fills in edges, vertices and signs, from the first half-edge and the side of the parent.
    fn place(&mut self, edges: &Edges<I>, half: usize, parent: usize, corners: &[I; SIDES]) {
        (self.parent, self.mirrored, self.spread) = (parent as u8, false, R::ZERO);
        for k in 0..SIDES {
            let side = (parent + 1 + k) % SIDES;
            let edge = edges.edge_of(half + side);
            write(&mut self.edges, k, I::new(edge).unwrap_or(I::NONE));
            write(&mut self.vertices, k, read(corners, side));
            let along = read(edges.half_edges(), edge)[0].at() == half + side;
            write(&mut self.signs, k, if along { R::ONE } else { -R::ONE });
        }
    }

    fn set_material(&mut self, number: usize, alpha: R) {
        self.number = I::new(number).unwrap_or(I::NONE);
        (self.alpha, self.softness) = (alpha, R::ONE / alpha);
    }
}

impl<R: Real, I: Index> Triangle<R, I> {
    /// Mirrors the cell, where needed, so that its middle side leads towards a root, if one does.
    fn find_second(&mut self, edges: &Edges<I>, own: usize, forest: &Forest<I>) {
        let behind = |k: usize| {
            let side = (usize::from(self.parent) + 1 + k) % 3;
            edges.beyond(3 * own + side).map(|(_, cell)| forest.place(cell))
        };
        let nearer = |place: Option<usize>| place.filter(|&place| place < forest.place(own));
        let (first, second) = (nearer(behind(0)), nearer(behind(1)));
        self.mirrored = match (first, second) {
            (Some(first), Some(second)) => first < second,
            (first, _) => first.is_some(),
        };
        self.spread = if first.or(second).is_some() { R::HALF } else { R::ZERO };
        if self.mirrored {
            // Vertex k + 2 stays opposite of side k, and K_ij goes with the sides.
            self.edges.swap(0, 1);
            self.signs.swap(0, 1);
            self.vertices.swap(0, 2);
            self.k.swap(1, 2);
        }
    }

    fn set_compliance(&mut self, compliance: R) {
        let size = self.k.iter().fold(R::ZERO, |sum, entry| sum + entry.magnitude());
        (self.compliance, self.uncertainty) = (compliance, compliance * size);
    }
}
