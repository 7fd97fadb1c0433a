//! Projected successive over-relaxation on the condensed problem, eight rows at a time.
//!
//! ```text
//!   x_i ← max(0, x_i + ω (b_i − Σ_j S_ij x_j)),      S_ii = 1
//! ```
//! or, where w has a range of its own ([`super::ranges`]), the proximal step: up to where w = lo asks for if that is above 0,
//! down to where w = hi asks for if that is below 0, and 0 elsewhere.
//!
//! The products of eight rows are formed with the x there is; then these eight are relaxed one after the
//! other, each change being brought to the rows below it. That is Gauss–Seidel, exactly, in another
//! order of the sums.

use core::iter;

use super::blocks::{
    Block, Blocks, SIDE, add_products, add_transposed, groups, groups_mut, padded,
};
use super::ranges::{Given, Ranges};
use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length};

/// One sweep; vectors are [`padded`]. Returns the sum of all changes, |min(x_i, ω r_i)| with
/// r = Sx − b: how far from complementarity each x was when its turn came. NaN where anything is.
///
/// # Errors
/// Arrays of the wrong length.
#[inline(never)]
pub fn sweep<R: Real>(
    matrix: &Blocks<R>,
    given: Given<R>,
    omega: R,
    x: &mut [R],
) -> Result<R, Error> {
    let Given { load, ranges } = given;
    same_length(Array::Load, load.len(), padded(matrix.order()))?;
    same_length(Array::Unknowns, x.len(), padded(matrix.order()))?;
    let mut moved = R::ZERO;
    let (mut rest, x) = (matrix.blocks(), groups_mut(x));
    for (row, load) in groups(load).iter().enumerate() {
        let Some((left, [diagonal, below @ ..])) = rest.split_at_checked(row) else { break };
        let Some((before, [own, after @ ..])) = x.split_at_mut_checked(row) else { break };
        let mut pairs = [[R::ZERO; 2]; SIDE];
        add_products(left.iter().zip(&*before).zip(iter::repeat(true)), &mut pairs);
        let mut sums = pairs.map(|[even, odd]| even + odd);
        // Column `row` of the rows that follow: each is one block longer than the one before.
        let mut column = below.get(row..).unwrap_or_default();
        for (step, x) in (row + 2..).zip(after) {
            let [block, ..] = column else { break };
            add_transposed(block, x, &mut sums);
            column = column.get(step..).unwrap_or_default();
        }
        moved += relax(diagonal, load, &sums, omega, (ranges, row * SIDE), own);
        rest = below;
    }
    Ok(moved)
}

/// The unknowns of a block on the diagonal, `sums` being all other columns' part of their rows. Returns
/// the sum of their changes.
#[inline(always)]
fn relax<R: Real>(
    diagonal: &Block<R>,
    load: &[R; SIDE],
    sums: &[R; SIDE],
    omega: R,
    (ranges, first): (Ranges<R>, usize),
    x: &mut [R; SIDE],
) -> R {
    let (mut now, mut moved) = (*x, R::ZERO);
    // Two loops of constant length: each is short enough to be unrolled, and x stays in registers.
    for row in 0..SIDE / 2 {
        moved += relax_row(row, diagonal, load, sums, omega, (ranges, first + row), &mut now);
    }
    for row in SIDE / 2..SIDE {
        moved += relax_row(row, diagonal, load, sums, omega, (ranges, first + row), &mut now);
    }
    *x = now;
    moved
}

#[inline(always)]
fn relax_row<R: Real>(
    row: usize,
    diagonal: &Block<R>,
    load: &[R; SIDE],
    sums: &[R; SIDE],
    omega: R,
    (ranges, at): (Ranges<R>, usize),
    x: &mut [R; SIDE],
) -> R {
    let (Some(entries), Some(&load), Some(&sum)) =
        (diagonal.get(row), load.get(row), sums.get(row))
    else {
        return R::ZERO;
    };
    let inner = entries.iter().zip(&*x);
    let residual = inner.fold(sum - load, |sum, (&entry, &x)| sum + entry * x);
    let Some(x) = x.get_mut(row) else { return R::ZERO };
    let relaxed = *x - omega * residual;
    let next = match ranges.are_limited() {
        true => proximal(relaxed, omega, ranges.ends(at)),
        false if relaxed > R::ZERO => relaxed,
        false => R::ZERO,
    };
    let moved = (next - *x).magnitude();
    *x = next;
    moved
}

/// Where x goes from `relaxed`, its value for w = 0 of the load.
#[inline(always)]
fn proximal<R: Real>(relaxed: R, omega: R, [least, most]: [R; 2]) -> R {
    let (above, below) = (relaxed + omega * least, relaxed + omega * most);
    if above > R::ZERO {
        above
    } else if below < R::ZERO {
        below
    } else {
        R::ZERO
    }
}
