//! Uniform refinement: every edge is halved, every cell becomes four of its kind.
//!
//! ```text
//!         c                 d ───n── c
//!        ╱ ╲                │   │    │       vertices stay; then the midpoints of the edges, in the
//!       n───m               o───z────m       order of `check::edges`; then the centres z of the
//!      ╱ ╲ ╱ ╲              │   │    │       quads. Of cell k become 4k … 4k + 2 or 3 at its
//!     a───l───b             a ──l─── b       corners, in a triangle then the middle one, 4k + 3.
//! ```
//! z is the mean of the corners, where both lines between opposite midpoints meet: the quads remain
//! strictly convex. Neighbours share midpoints, so the mesh remains conforming.

use super::Mesh;
use super::adaptive::uniformly;
pub use super::check::MOST_CELLS;
use super::check::check_count;
use crate::error::Result;

/// `mesh`, refined once.
///
/// # Errors
/// Cells that don't meet as they may, curves off the edges, or more than [`MOST_CELLS`].
pub fn refined(mesh: &Mesh) -> Result<Mesh> {
    check_count(4 * mesh.cells(), "refine less often")?;
    uniformly(mesh)
}
