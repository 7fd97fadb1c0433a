//! How cells may meet: an edge belongs to one cell, or to two that lie on its two sides.
//!
//! Cells run counterclockwise, so two neighbours run through their common edge in opposite
//! directions; the same direction means that both lie on the same side and overlap. Edges are
//! found by sorting, in O(n log n) whatever the mesh: a fan around one vertex costs no more than
//! a grid.

use super::{Curve, Mesh};
use crate::error::{InputError, Result};

/// Numbers of cells above are refused: a slip of the pen, or a job for another machine.
pub const MOST_CELLS: usize = 8_000_000;

/// Cells that meet in a way no plane mesh has: three at one edge, or two on the same side of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// The vertices of the edge.
    pub edge: [u32; 2],
    /// The first three of its cells, or the two on the same side.
    pub cells: Vec<u32>,
}

impl Fault {
    /// The fault in words, with cells and vertices called as the caller knows them.
    pub fn describe(&self, cell: impl Fn(u32) -> String, vertex: impl Fn(u32) -> String) -> String {
        let [from, to] = self.edge.map(vertex);
        let cells: Vec<_> = self.cells.iter().map(|&at| cell(at)).collect();
        match &cells[..] {
            [a, b, c] => {
                format!("{a}, {b} and {c} share the edge from {from} to {to}, expected two at most")
            }
            both => {
                let both = both.join(" and ");
                format!("{both} overlap: both lie on the same side of the edge from {from} to {to}")
            }
        }
    }
}

/// One side of a cell; the order sorts by edge, then by cell.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct CellSide {
    /// The vertices of its edge, the lower one first.
    pub(super) edge: [u32; 2],
    pub(super) cell: u32,
    /// The corner that it begins at.
    pub(super) side: usize,
    upward: bool,
}

/// The sides of all cells, those of one edge next to each other.
pub(super) fn sides(mesh: &Mesh) -> Vec<CellSide> {
    let mut sides = Vec::with_capacity(3 * mesh.triangles.len() + 4 * mesh.quads.len());
    for (cell, corners) in (0..).zip(mesh.corners()) {
        let following = corners.iter().cycle().skip(1);
        let ends = corners.iter().zip(following).enumerate();
        sides.extend(ends.map(|(side, (&from, &to))| {
            let edge = [from.min(to), from.max(to)];
            CellSide { edge, cell, side, upward: from < to }
        }));
    }
    sides.sort_unstable();
    sides
}

/// The edges of the mesh, lower vertex first, ascending, if its cells meet as they may.
///
/// Cells must be counterclockwise and without a repeated vertex.
pub fn edges(mesh: &Mesh) -> std::result::Result<Vec<[u32; 2]>, Fault> {
    sides(mesh).chunk_by(|a, b| a.edge == b.edge).map(edge_of).collect()
}

/// The edges of a mesh that no file names: errors call cells and vertices by number.
///
/// # Errors
/// Cells that don't meet as they may.
pub(super) fn numbered_edges(mesh: &Mesh) -> Result<Vec<[u32; 2]>> {
    edges(mesh).map_err(|fault| {
        let described = fault.describe(|cell| format!("cell {cell}"), |at| format!("vertex {at}"));
        InputError::new(described).into()
    })
}

/// Which of the edges an edge of a curve is.
///
/// # Errors
/// None: no cell has it.
pub(super) fn edge_number(edges: &[[u32; 2]], curve: &Curve, [a, b]: [u32; 2]) -> Result<u32> {
    edges.binary_search(&[a.min(b), a.max(b)]).map(|edge| edge as u32).map_err(|_| {
        let name = &curve.name;
        let message = format!("curve `{name}`: no cell has the edge from {a} to {b}");
        InputError::new(message).into()
    })
}

/// The edge that these sides have in common.
fn edge_of(sides: &[CellSide]) -> std::result::Result<[u32; 2], Fault> {
    let edge = sides[0].edge;
    match sides {
        [a, b, c, ..] => Err(Fault { edge, cells: vec![a.cell, b.cell, c.cell] }),
        [a, b] if a.upward == b.upward => Err(Fault { edge, cells: vec![a.cell, b.cell] }),
        _ => Ok(edge),
    }
}

/// Refuses to make so many cells.
pub(super) fn check_count(cells: usize, hint: &str) -> Result<()> {
    let message =
        format!("the refined mesh would have {cells} cells, expected at most {MOST_CELLS}");
    let error = || InputError::new(message).hint(hint).into();
    if cells > MOST_CELLS { Err(error()) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_of_a_triangle_on_a_quad() {
        let (triangles, quads) = (vec![[3, 2, 4]], vec![[0, 1, 2, 3]]);
        let expected = vec![[0, 1], [0, 3], [1, 2], [2, 3], [2, 4], [3, 4]];
        assert_eq!(edges(&Mesh { triangles, quads, ..Mesh::default() }), Ok(expected));
    }
}
