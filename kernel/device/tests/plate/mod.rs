//! A small plate that several tests share.

pub mod factor;
pub mod foundation;

use signorini_kernel::Error;

use crate::numbering::{Cut, NONE, NumberedMesh, Side, cells, corners};

/// Squares along x and y, of side 1; every other one is cut into two triangles.
const SQUARES: [usize; 2] = [5, 4];

/// The plate with its edges numbered.
pub type Plate = NumberedMesh<f64>;

/// The plate with these sides: bottom, right, top, left.
pub fn plate(sides: [Side; 4]) -> Result<Plate, Error> {
    let vertices: Vec<_> = corners(SQUARES).collect();
    let cells = cells(SQUARES, |i, j| if (i + j) % 2 == 0 { Cut::First } else { Cut::Whole });
    NumberedMesh::new(vertices.clone(), cells, |ends| sides[side(&vertices, ends)].block())
}

/// The free edges on those of the plate's sides that are of this kind.
pub fn free_edges(plate: &Plate, sides: [Side; 4], of: Side) -> Result<Vec<u16>, Error> {
    let (mesh, edges) = (plate.mesh()?, plate.edges()?);
    let outer = (0..plate.counts.free).filter(|&edge| edges.half_edges()[edge][1] == NONE);
    let on = outer.filter(|&edge| sides[side(&plate.vertices, edges.endpoints(&mesh, edge))] == of);
    Ok(on.map(|edge| edge as u16).collect())
}

fn side(vertices: &[[f64; 2]], ends: [u16; 2]) -> usize {
    let [p, q] = ends.map(|vertex| vertices[usize::from(vertex)]);
    let [nx, ny] = SQUARES.map(|n| n as f64);
    let on = [p[1] + q[1] == 0.0, p[0] + q[0] == 2.0 * nx, p[1] + q[1] == 2.0 * ny];
    on.iter().position(|&on| on).unwrap_or(3)
}
