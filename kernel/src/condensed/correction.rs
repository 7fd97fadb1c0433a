//! Corrections of a tableau in its blocks: rank one, two of them in one pass, and the row and column that an
//! exchange replaces.
//!
//! Of the lower triangle each block is read and written once a pass:
//! ```text
//!   T ← T − c cᵀ/T_kk,     T ← T − a aᵀ/T_ii − b bᵀ/T_kk
//! ```
//! The exchanged unknown's own entry of its column is handed over as 0; its row and column, which follow
//! other formulas, are written afterwards by `store`.

use super::blocks::{Block, SIDE, filled};
use crate::real::Real;

/// T −= Σ c cᵀ · `inverse` over some columns c, each with its own inverse.
#[inline(always)]
pub(super) fn subtract<R: Real, const N: usize>(
    blocks: &mut [Block<R>],
    order: usize,
    columns: [&[[R; SIDE]]; N],
    inverses: [R; N],
) {
    let mut rest = blocks;
    for row in 0..order.div_ceil(SIDE) {
        let Some((blocks, more)) = rest.split_at_mut_checked(row + 1) else { return };
        let mut factors = [[R::ZERO; N]; SIDE];
        for (at, (column, inverse)) in columns.iter().zip(inverses).enumerate() {
            let Some(own) = column.get(row) else { return };
            for (factors, &entry) in factors.iter_mut().zip(own) {
                factors.iter_mut().skip(at).take(1).for_each(|factor| *factor = entry * -inverse);
            }
        }
        add(blocks, columns, filled(&mut factors, row, order));
        rest = more;
    }
}

/// Adds to each row of a row of blocks the columns, each times a factor of that row.
#[cfg_attr(target_arch = "arm", inline(always))]
#[cfg_attr(not(target_arch = "arm"), inline(never))]
fn add<R: Real, const N: usize>(
    blocks: &mut [Block<R>],
    columns: [&[[R; SIDE]]; N],
    factors: &[[R; N]],
) {
    for (place, block) in blocks.iter_mut().enumerate() {
        // Copies, which no write to a block can change, stay in registers.
        let groups = columns.map(|column| column.get(place).copied().unwrap_or([R::ZERO; SIDE]));
        for (row, factors) in block.iter_mut().zip(factors) {
            for (group, &factor) in groups.iter().zip(factors) {
                row.iter_mut().zip(group).for_each(|(entry, &of)| *entry += factor * of);
            }
        }
    }
}

/// Row and column k of T: what `value` makes of each group of `column` and its place, and −1/T_kk more on
/// the diagonal, where columns hold 0.
#[inline(always)]
pub(super) fn store<R: Real>(
    blocks: &mut [Block<R>],
    k: usize,
    column: &[[R; SIDE]],
    inverse: R,
    value: impl Fn(&[R; SIDE], usize) -> [R; SIDE],
) {
    let (own, line) = (k / SIDE, k % SIDE);
    for (place, group) in column.iter().enumerate() {
        let Some(block) = blocks.get_mut(position(place, own)) else { return };
        let entries = value(group, place);
        if place > own {
            let column = block.iter_mut().filter_map(|row| row.get_mut(line));
            column.zip(&entries).for_each(|(place, &entry)| *place = entry);
        } else if let Some(row) = block.get_mut(line) {
            *row = entries;
        }
    }
    let Some(block) = blocks.get_mut(position(own, own)) else { return };
    let diagonal = block.get_mut(line).and_then(|row| row.get_mut(line));
    diagonal.into_iter().for_each(|entry| *entry -= inverse);
    let mirrored = block.get(line).copied().unwrap_or([R::ZERO; SIDE]);
    let column = block.iter_mut().filter_map(|row| row.get_mut(line));
    column.zip(mirrored).for_each(|(place, entry)| *place = entry);
}

/// A group times a number.
#[inline(always)]
pub(super) fn scaled<R: Real>(group: &[R; SIDE], by: R) -> [R; SIDE] {
    let mut scaled = *group;
    scaled.iter_mut().for_each(|entry| *entry *= by);
    scaled
}

/// Where the block of two groups of unknowns stands.
pub(super) const fn position(one: usize, other: usize) -> usize {
    let (row, column) = if one > other { (one, other) } else { (other, one) };
    row * (row + 1) / 2 + column
}
