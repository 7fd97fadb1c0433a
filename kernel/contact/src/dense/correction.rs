//! Corrections of a tableau in its blocks: rank one, two of them in one pass, and the row and column that an
//! exchange replaces.
//!
//! Of the lower triangle each block is read and written once a pass:
//! ```text
//!   T ← T − c cᵀ/T_kk,     T ← T − a aᵀ/T_ii − b bᵀ/T_kk
//! ```
//! The exchanged unknown's own entry of its column is handed over as 0; its row and column, which follow
//! other formulas, are written afterwards by `store`.

use super::blocks::{Block, SIDE};
use signorini_kernel::Real;

/// T −= a aᵀ · `inverses[0]` + b bᵀ · `inverses[1]`
#[inline(always)]
pub(super) fn subtract_two<R: Real>(
    blocks: &mut [Block<R>],
    order: usize,
    [a, b]: [&[[R; SIDE]]; 2],
    [of_a, of_b]: [R; 2],
) {
    let mut rest = blocks;
    for (row, (own_a, own_b)) in a.iter().zip(b).enumerate() {
        let Some((blocks, more)) = rest.split_at_mut_checked(row + 1) else { return };
        let mut factors = [[R::ZERO; 2]; SIDE];
        for (pair, (&entry_a, &entry_b)) in factors.iter_mut().zip(own_a.iter().zip(own_b)) {
            *pair = [entry_a * -of_a, entry_b * -of_b];
        }
        add_two(blocks, [a, b], filled(&mut factors, row, order));
        rest = more;
    }
}

/// Entries of a group that are no padding. Where registers hold one number each it is all of it: eight rows, and the
/// compiler knows it, stay in registers, which gains more than padding takes. Where they hold several, a number
/// of rows that it does not know keeps the compiler from taking rows together, and turning their numbers about.
#[inline(always)]
fn filled<T>(group: &mut [T; SIDE], number: usize, order: usize) -> &mut [T] {
    if cfg!(target_arch = "arm") {
        return group;
    }
    group.get_mut(..SIDE.min(order.saturating_sub(number * SIDE))).unwrap_or_default()
}

/// Adds to each row of a row of blocks two columns, times a pair of factors of that row.
#[cfg_attr(target_arch = "arm", inline(always))]
#[cfg_attr(not(target_arch = "arm"), inline(never))]
fn add_two<R: Real>(blocks: &mut [Block<R>], [a, b]: [&[[R; SIDE]]; 2], factors: &[[R; 2]]) {
    for (block, (other_a, other_b)) in blocks.iter_mut().zip(a.iter().zip(b)) {
        let (other_a, other_b) = (*other_a, *other_b);
        for (row, &[factor_a, factor_b]) in block.iter_mut().zip(factors) {
            let others = other_a.into_iter().zip(other_b);
            for (entry, (a, b)) in row.iter_mut().zip(others) {
                *entry = *entry + factor_a * a + factor_b * b;
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
