//! The conforming cells of a forest: its own, and the pieces of those with hanging nodes.

use super::closure::Pieces;
use super::forest::Forest;
use crate::error::{InputError, Result};
use crate::mesh::Mesh;
use crate::mesh::refine::{MOST_CELLS, mean};
use crate::mesh::shape::{Orientation, orientation};

/// Which conforming cells each cell of the forest consists of.
#[derive(Debug, Clone)]
pub(super) struct Places {
    /// Where the triangles of each begin, then where the last ones end.
    triangles: Vec<u32>,
    /// The quads' pieces, all triangles counted before them.
    quads: Vec<u32>,
}

impl Places {
    /// The conforming cells that a cell of the forest consists of.
    pub(super) fn of(&self, cell: u32) -> impl Iterator<Item = u32> + use<> {
        let cell = cell as usize;
        let triangles = self.triangles[cell]..self.triangles[cell + 1];
        triangles.chain(self.quads[cell]..self.quads[cell + 1])
    }
}

/// The cells of a forest closed, in the order of the forest.
pub(super) fn closed(vertices: &[[f64; 2]], forest: &Forest) -> (Pieces, Places) {
    let mut pieces = Pieces::default();
    let mut ends = vec![(0, 0)];
    let midpoint = |side: u32| forest.edges.midpoint(side);
    for cell in &forest.triangles {
        pieces.add_triangle(vertices, cell.corners, cell.sides.map(midpoint));
        ends.push((pieces.triangles.len() as u32, pieces.quads.len() as u32));
    }
    for cell in &forest.quads {
        pieces.add_quad(vertices, cell.corners, cell.sides.map(midpoint));
        ends.push((pieces.triangles.len() as u32, pieces.quads.len() as u32));
    }
    let before = pieces.triangles.len() as u32;
    let (triangles, quads) = ends.into_iter().map(|(t, q)| (t, before + q)).unzip();
    (pieces, Places { triangles, quads })
}

/// Whether the mesh keeps its contract still: not too many cells, each strictly convex within rounding.
///
/// # Errors
/// One that is not, with its place.
pub(super) fn check(mesh: &Mesh) -> Result<()> {
    if mesh.cells() > MOST_CELLS {
        let cells = mesh.cells();
        let message =
            format!("the refined mesh would have {cells} cells, expected at most {MOST_CELLS}");
        return Err(InputError::new(message).hint("refine fewer cells").into());
    }
    mesh.triangles.iter().try_for_each(|&cell| convex(&mesh.vertices, cell))?;
    mesh.quads.iter().try_for_each(|&cell| convex(&mesh.vertices, cell))
}

fn convex<const N: usize>(vertices: &[[f64; 2]], cell: [u32; N]) -> Result<()> {
    let points = cell.map(|vertex| vertices[vertex as usize]);
    if orientation(&points) == Ok(Orientation::Counterclockwise) {
        return Ok(());
    }
    let [x, y] = mean(vertices, cell);
    let message =
        format!("a cell at ({x}, {y}) is too small to be refined: rounding hides its shape");
    Err(InputError::new(message).hint("refine less often, or move the origin nearer").into())
}
