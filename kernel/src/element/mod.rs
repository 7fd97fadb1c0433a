//! The two nonconforming elements. Degrees of freedom are edge means.
//!
//! An element matrix K_T has zero row sums (the basis functions add up to 1), so its off-diagonal
//! entries are the whole of it, and every product with it can be written with differences,
//! (K_T u)_i = Σ_j K_ij (u_j − u_i): what flows through the sides of a cell then adds up to zero for
//! any u at all. Stored are the entries above the diagonal, row by row:
//! ```text
//!   triangle [01, 02, 12]              quad [01, 02, 03, 12, 13, 23]
//! ```

pub mod crouzeix_raviart;
pub mod rannacher_turek;

use crate::index::read;
use crate::real::Real;

/// Where entry (i, j), i ≠ j, of an element matrix with `sides` rows stands.
#[inline(always)]
pub(crate) fn entry(sides: usize, i: usize, j: usize) -> usize {
    let (low, high) = if i < j { (i, j) } else { (j, i) };
    if sides == 3 { low + high - 1 } else { low + high - usize::from(low == 0) }
}

/// (K_T u)_i for each side i: N = 3 or 4 sides, M = 3 or 6 stored entries.
#[inline(always)]
pub fn product<R: Real, const N: usize, const M: usize>(k: &[R; M], u: &[R; N]) -> [R; N] {
    let mut flow = [R::ZERO; N];
    for i in 0..N {
        for j in i + 1..N {
            let through = read(k, entry(N, i, j)) * (read(u, j) - read(u, i));
            if let Some(out) = flow.get_mut(i) {
                *out += through;
            }
            if let Some(out) = flow.get_mut(j) {
                *out -= through;
            }
        }
    }
    flow
}

/// The diagonal entry of row i: minus the sum of the others.
#[inline(always)]
pub(crate) fn diagonal<R: Real>(sides: usize, k: &[R], i: usize) -> R {
    let others = (0..sides).filter(|&j| j != i);
    others.fold(R::ZERO, |sum, j| sum - read(k, entry(sides, i, j)))
}
