//! Local refinement: marked cells become four, and closure keeps the mesh conforming.
//!
//! ```text
//!   marked ─► marking ─► red ─► closure ─► Mesh
//!               │         │        └ cells with hanging nodes, divided for one mesh only
//!               │         └ four children of a cell's own kind; nodes hang in their neighbours' sides
//!               └ neighbours too: one hanging node a side at most
//! ```
//! Closure is undone before the next round: a marked piece refines the whole that it was cut from. So no
//! cell is ever cut from a piece, and shapes are bounded whatever the number of rounds (`closure`
//! says by what). Time and memory of a round are those of writing its mesh down. There is nothing random:
//! equal marks give equal meshes. [`refined`] is uniform: every side is halved, neighbours share its middle, and nothing is to close.

mod carried;
mod closure;
mod coarsened;
mod forest;
mod marking;
mod red;
mod stage;

use self::carried::Before;
pub use self::carried::Carried;
pub use self::coarsened::coarsened;
use self::red::Grown;
use self::stage::{Stage, curves_of};
use super::Mesh;
use super::check::check_count;
use crate::error::{InputError, Result};

/// A mesh with what refining it again and again needs to know.
///
/// Vertices keep numbers and coordinates from round to round; new ones follow. Cells are numbered anew.
#[derive(Debug, Clone)]
pub struct Hierarchy {
    base: Mesh,
    now: Stage,
}

/// `mesh` with every cell refined: vertices stay, then come the midpoints of edges in their order, then the centres of quads.
/// Cells 4k … 4k + 3 are those of cell k.
///
/// # Errors
/// Cells that don't meet as they may, curves off the edges, or more than [`MOST_CELLS`](super::check::MOST_CELLS).
pub fn refined(mesh: &Mesh) -> Result<Mesh> {
    check_count(4 * mesh.cells(), "refine less often")?;
    let (forest, curves) = Stage::forest(mesh)?;
    let Grown { vertices, forest, parents } = red::all(&mesh.vertices, &forest);
    let curves: Vec<_> = curves.iter().map(|of| forest.edges.halved(of)).collect();
    Ok(Mesh {
        triangles: forest.triangles.iter().map(|cell| cell.corners).collect(),
        quads: forest.quads.iter().map(|cell| cell.corners).collect(),
        surfaces: mesh.inherited(&parents),
        curves: curves_of(mesh, &forest, &curves),
        vertices,
    })
}

impl Hierarchy {
    /// A mesh of which nothing is refined yet.
    ///
    /// # Errors
    /// Cells that don't meet as they may, or curves off the edges.
    pub fn new(base: Mesh) -> Result<Self> {
        Ok(Self { now: Stage::first(&base)?, base })
    }

    /// The mesh as it is refined now; all physical surfaces and curves are those of the base mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.now.mesh
    }

    /// For each cell of the mesh the cell of the base mesh that it lies in.
    pub fn roots(&self) -> Vec<u32> {
        self.now.roots()
    }

    /// Refines at least the marked ones of the mesh's cells, and says where the new mesh lies in the old one.
    ///
    /// Of a piece it refines the whole. One piece is a child of the whole already, the corner of a triangle with
    /// two hanging nodes: it comes back as a cell of its own, which the next round divides if it is marked again.
    ///
    /// # Errors
    /// A mark too few or too many, more than [`MOST_CELLS`](super::check::MOST_CELLS), or cells so small that
    /// rounding hides their shape: the mesh is as before then.
    pub fn refine(&mut self, marked: &[bool]) -> Result<Carried> {
        let now = &self.now;
        let (marks, cells) = (marked.len(), now.mesh.cells());
        if marks != cells {
            let message = format!("{marks} marks, expected one for each of the {cells} cells");
            return Err(InputError::new(message).into());
        }
        let is_marked = |cell| now.places.of(cell).any(|piece| marked[piece as usize]);
        let marked = (0..now.forest.cells() as u32).map(is_marked).collect();
        let refined = marking::with_neighbours(&now.forest, marked);
        let grown = red::grown(&now.mesh.vertices, &now.forest, &refined);
        let (next, families) = now.next(&self.base, grown)?;
        let before = Before { mesh: &now.mesh, places: &now.places };
        let carried = before.carried(&next.mesh, &families);
        self.now = next;
        Ok(carried)
    }
}
