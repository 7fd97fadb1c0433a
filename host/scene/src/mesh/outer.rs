//! The boundary of a mesh and the sizes of its groups, before any scene gives them a meaning.

use super::Mesh;
use super::check::sides;
use super::shape::edge_length;

impl Mesh {
    /// The edges with a cell on one side alone: lower vertex first, ascending.
    pub fn outer_edges(&self) -> Vec<[u32; 2]> {
        let sides = sides(self);
        let edges = sides.chunk_by(|a, b| a.edge == b.edge);
        edges.filter(|sides| sides.len() == 1).map(|sides| sides[0].edge).collect()
    }

    /// Coordinates of the ends of an edge.
    pub fn segment(&self, edge: [u32; 2]) -> [[f64; 2]; 2] {
        edge.map(|vertex| self.vertices[vertex as usize])
    }

    /// The length of these edges.
    pub fn length(&self, edges: &[[u32; 2]]) -> f64 {
        edges.iter().map(|&edge| edge_length(self.segment(edge))).sum()
    }

    /// The area of these cells, triangles first.
    pub fn area(&self, cells: impl IntoIterator<Item = u32>) -> f64 {
        let area = |cell: u32| {
            let corners = self.corners_of(cell as usize).iter();
            let points: Vec<_> = corners.map(|&at| self.vertices[at as usize]).collect();
            let turns = points.windows(2).map(|pair| cross(points[0], pair[0], pair[1]));
            0.5 * turns.sum::<f64>()
        };
        cells.into_iter().map(area).sum()
    }

    /// The vertices of cell `at`, triangles first.
    pub fn corners_of(&self, at: usize) -> &[u32] {
        match self.triangles.get(at) {
            Some(corners) => corners,
            None => &self.quads[at - self.triangles.len()],
        }
    }
}

/// (a − o) × (b − o)
fn cross(o: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
}
