//! A small mesh with numbered edges: any arrays that the kernel takes, or a sound grid.

use signorini_kernel::Error;
use signorini_kernel::mesh::edges::Block;

use super::bytes::{Bits, Bytes};
use super::numbering::{Cells, Cut, NumberedMesh, cells, corners};

/// Squares along each side of a grid, at most.
const MOST: usize = 3;

/// Any coordinates and corners.
pub fn arbitrary<R: Bits>(bytes: &mut Bytes) -> Result<NumberedMesh<R>, Error> {
    let [vertices, triangles, quads] = [10, 8, 6].map(|most| bytes.below(most));
    let points = bytes.groups(vertices);
    let mut corner = || match bytes.below(64) {
        0 => bytes.bits() as u16,
        k => (k % (vertices + 1).max(2)) as u16,
    };
    let triangles = (0..triangles).map(|_| [(); 3].map(|()| corner())).collect();
    let quads = (0..quads).map(|_| [(); 4].map(|()| corner())).collect();
    numbered(points, (triangles, quads), bytes)
}

/// A grid of squares, whole or cut, whose vertices `moves` shifts; an edge at least is given.
pub fn grid<R: Bits>(bytes: &mut Bytes, moves: bool) -> Result<NumberedMesh<R>, Error> {
    let squares = [1 + bytes.below(MOST), 1 + bytes.below(MOST)];
    let mut shift = || if moves { f64::from(bytes.byte() as i8) / 512.0 } else { 0.0 };
    let vertices = corners(squares).map(|at| at.map(|x| R::narrow(x + shift()))).collect();
    let cells = cells(squares, |_, _| match bytes.below(3) {
        0 => Cut::First,
        1 => Cut::Second,
        _ => Cut::Whole,
    });
    numbered(vertices, cells, bytes)
}

fn numbered<R: Bits>(
    vertices: Vec<[R; 2]>,
    cells: Cells<u16>,
    bytes: &mut Bytes,
) -> Result<NumberedMesh<R>, Error> {
    // The first one is given, whatever the others are.
    let mut first = true;
    NumberedMesh::new(vertices, cells, |_| match (std::mem::take(&mut first), bytes.below(8)) {
        (true, _) | (_, 0) => Block::Dirichlet,
        (_, 1..=3) => Block::Free,
        _ => Block::Contact,
    })
}
