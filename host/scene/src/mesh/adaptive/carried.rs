//! Where the cells and sides of a refined mesh lie in the mesh before.
//!
//! A solution goes from one mesh to the next by it, as a start: the old u_h in the middle of a new edge, seen from the old cell
//! that holds it.
//!
//! A new cell lies in one old cell, but where closure was undone: there the old pieces of the same red
//! cell are looked through. No search ever leaves it, so nothing crosses a slit.

use super::stage::Places;
use crate::mesh::Mesh;
use crate::mesh::shape::{direction, mean};

/// For every part of the new mesh the part of the old one that it came from.
#[derive(Debug, Clone, PartialEq)]
pub struct Carried {
    /// For each cell the old cell in which its corners' mean lies. All of the cell lies there, unless the
    /// old cell was a piece of a closure.
    pub cells: Vec<u32>,
    /// For each triangle and each side, from corner k to corner k + 1, the old cell that holds the side's middle.
    /// Where several do it is one on this side of all edges, never one across a slit.
    pub triangle_sides: Vec<[u32; 3]>,
    /// The carried values of each quad.
    pub quad_sides: Vec<[u32; 4]>,
}

/// The old mesh, and which of its cells each cell of the old forest consists of.
pub(super) struct Before<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) places: &'a Places,
}

impl Before<'_> {
    /// For each cell, triangle's side and quad's side of `mesh` the old cell; `families` has for each
    /// cell the one of the old forest that it lies in.
    pub(super) fn carried(&self, mesh: &Mesh, families: &[u32]) -> Carried {
        let vertices = &mesh.vertices;
        let (of_triangles, of_quads) = families.split_at(mesh.triangles.len());
        let triangles = mesh.triangles.iter().zip(of_triangles);
        let quads = mesh.quads.iter().zip(of_quads);
        let cells = mesh.corners().zip(families);
        Carried {
            cells: cells.map(|(cell, &of)| self.holder(of, mean(vertices, cell))).collect(),
            triangle_sides: triangles.map(|(&cell, &of)| self.sides(of, vertices, cell)).collect(),
            quad_sides: quads.map(|(&cell, &of)| self.sides(of, vertices, cell)).collect(),
        }
    }

    fn sides<const N: usize>(
        &self,
        family: u32,
        vertices: &[[f64; 2]],
        cell: [u32; N],
    ) -> [u32; N] {
        std::array::from_fn(|k| self.holder(family, mean(vertices, &[cell[k], cell[(k + 1) % N]])))
    }

    /// The conforming cell, among those of one cell of the forest, in which a point lies deepest.
    fn holder(&self, family: u32, point: [f64; 2]) -> u32 {
        let mut places = self.places.of(family);
        let (first, second) = (places.next().unwrap_or_default(), places.next());
        let Some(second) = second else { return first };
        let deeper = |(best, depth), cell| {
            let own = self.depth(cell, point);
            if own > depth { (cell, own) } else { (best, depth) }
        };
        let rest = std::iter::once(second).chain(places);
        rest.fold((first, self.depth(first, point)), deeper).0
    }

    /// The distance of a point to the nearest line along a side, negative outside.
    fn depth(&self, cell: u32, point: [f64; 2]) -> f64 {
        let corners = self.mesh.corners_of(cell as usize);
        let at = |vertex: u32| self.mesh.vertices[vertex as usize];
        let after = corners.iter().cycle().skip(1);
        let distance = |(&from, &to): (&u32, &u32)| {
            let ([x, y], [dx, dy]) = (at(from), direction(at(from), at(to)));
            dx * (point[1] - y) - dy * (point[0] - x)
        };
        corners.iter().zip(after).map(distance).fold(f64::INFINITY, f64::min)
    }
}
