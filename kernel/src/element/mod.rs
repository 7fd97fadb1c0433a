//! The two nonconforming elements. Degrees of freedom are edge means.
//!
//! An element matrix K_T has zero row sums (the basis functions add up to 1), so its off-diagonal
//! entries are the whole of it, and every product with it can be written with differences,
//! (K_T u)_i = Σ_j K_ij (u_j − u_i): what flows through the sides of a cell then adds up to zero for
//! any u at all. Stored are the entries above the diagonal:
//! ```text
//!   triangle [01, 12, 20]              quad [01, 02, 03, 12, 13, 23]
//! ```
//! On a triangle, what couples side k to the next one stands at k, to the one before at k − 1.

pub mod crouzeix_raviart;
pub mod rannacher_turek;

use crate::index::read;
use crate::real::Real;

/// Where entry (i, j), i ≠ j, of an element matrix with `sides` rows stands.
#[inline(always)]
pub(crate) fn entry(sides: usize, i: usize, j: usize) -> usize {
    let (low, high) = if i < j { (i, j) } else { (j, i) };
    match sides {
        3 if high - low == 1 => low,
        3 => 2,
        _ => low + high - usize::from(low == 0),
    }
}

/// The diagonal entry of row i: minus the sum of the others.
#[inline(always)]
fn diagonal<R: Real>(sides: usize, k: &[R], i: usize) -> R {
    let others = (0..sides).filter(|&j| j != i);
    others.fold(R::ZERO, |sum, j| sum - read(k, entry(sides, i, j)))
}

/// Copies the entries of one side's row counterclockwise; returns the diagonal one.
#[inline(always)]
pub(crate) fn lend<'v, R: Real + 'v>(
    k: &[R],
    sides: usize,
    side: usize,
    places: &mut impl Iterator<Item = &'v mut R>,
) -> R {
    for step in 1..sides {
        if let Some(place) = places.next() {
            *place = read(k, entry(sides, side, (side + step) % sides));
        }
    }
    diagonal(sides, k, side)
}

/// The two entries of a triangle's side in an array of all triangles' entries: towards the next side
/// and the one before. `None` where `half_edge` is beyond them.
#[inline(always)]
pub(crate) fn around<R: Copy>(k: &[R], half_edge: usize) -> Option<[R; 2]> {
    let next = *k.get(half_edge)?;
    // Two reads, not one at a chosen position: one instruction less for each.
    let first = half_edge.is_multiple_of(3);
    let before = if first { *k.get(half_edge + 2)? } else { *k.get(half_edge - 1)? };
    Some([next, before])
}
