//! A condensed matrix to count on, since counts depend on its size alone: S_ij = −0.3/|i − j|².

use signorini_contact::dense::blocks::{Block, SIDE};
use signorini_kernel::Real;

/// Fills the blocks, padding included.
pub fn fill<R: Real>(blocks: &mut [Block<R>]) {
    let (mut row, mut column) = (0, 0);
    for block in blocks {
        for (r, entries) in block.iter_mut().enumerate() {
            for (c, entry) in entries.iter_mut().enumerate() {
                let far = R::from_count((SIDE * row + r).abs_diff(SIDE * column + c) as u32);
                *entry = match far == R::ZERO {
                    true => R::ONE,
                    false => -R::from_count(3) / R::from_count(10) / (far * far),
                };
            }
        }
        (row, column) = if column < row { (row, column + 1) } else { (row + 1, 0) };
    }
}
