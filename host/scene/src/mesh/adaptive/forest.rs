//! The cells that red refinement has made, with nodes left hanging in their sides.
//!
//! Sides are edges by number, side k from corner k to corner k + 1. A side whose edge is halved has a
//! hanging node.

use super::edges::{Edges, NONE};

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
