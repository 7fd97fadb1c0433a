//! Rows straight from element matrices, with the bits that CSR would give them.

use super::Row;
use crate::Real;
use crate::element::{adjacent, copy_row};
use crate::index::{Index, read};
use crate::mesh::edges::{Edges, Side};
use crate::stiffness::Stiffness;

/// Rows of edges of triangles: two entries from each half-edge. The second half-edge of a boundary
/// edge points to no entry. `term` is what K_ii has beyond the element matrices.
#[inline(never)]
pub(super) fn gather_triangles<R: Real, I: Index, const WIDTH: usize>(
    rows: &mut [Row<R, I, WIDTH>],
    half_edges: &[[I; 2]],
    k: &[[R; 3]],
    load: &[R],
    term: R,
    omega: R,
) {
    let (k, opposite) = (k.as_flattened(), -omega);
    for ((row, &[first, second]), &load) in rows.iter_mut().zip(half_edges).zip(load) {
        let Some([a, b]) = adjacent(k, first.at()) else { break };
        let (mut c, mut d, mut sum) = (R::ZERO, R::ZERO, a + b);
        if let Some(others) = adjacent(k, second.at()) {
            [c, d] = others;
            sum += c + d;
        }
        row.put([a, b, c, d], load, opposite / (sum - term));
    }
}

/// Rows of edges of any cells. Not inlined, so that symbols tell whether it is there.
#[inline(never)]
pub(super) fn gather_cells<R: Real, I: Index, const WIDTH: usize>(
    rows: &mut [Row<R, I, WIDTH>],
    half_edges: &[[I; 2]],
    edges: &Edges<I>,
    stiffness: Stiffness<R>,
    load: &[R],
    term: R,
    omega: R,
) {
    for ((row, pair), &load) in rows.iter_mut().zip(half_edges).zip(load) {
        let (mut entries, mut own) = ([R::ZERO; WIDTH], R::ZERO);
        let mut places = entries.iter_mut();
        for half in pair.iter().filter(|&&half| half != I::NONE) {
            own += match edges.side(half.at()) {
                Side::Triangle(at, side) => {
                    copy_row(&read(stiffness.triangles, at), 3, side, &mut places)
                }
                Side::Quad(at, side) => copy_row(&read(stiffness.quads, at), 4, side, &mut places),
            };
        }
        row.put(entries, load, omega / (own + term));
    }
}
