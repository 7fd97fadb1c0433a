//! The points inside cells at which the reference is known.

use signorini_kernel::Tensor;

use signorini_certify::cell::Cell;
use signorini_problem::quadrature::{Point, gauss};

/// Points a direction: exact to degree 2 on triangles and 5 along both sides of quads, enough for the
/// squares of differences of linear fields where A is constant and the meshes are nested.
const ON_TRIANGLES: usize = 2;
const ON_QUADS: usize = 3;

/// The solution at a point inside.
#[derive(Debug, Clone, Copy)]
pub(super) struct Inside {
    pub(super) x: [f64; 2],
    /// An element of area.
    pub(super) weight: f64,
    pub(super) u: f64,
    pub(super) gradient: [f64; 2],
    pub(super) conductivity: Tensor<f64>,
}

/// The points of a cell.
pub(super) fn points(cell: &Cell) -> Vec<Point> {
    cell.points(&gauss(match cell {
        Cell::Triangle(_) => ON_TRIANGLES,
        Cell::Quad(_) => ON_QUADS,
    }))
}
