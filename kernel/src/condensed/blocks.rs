//! A dense symmetric matrix as the lower triangle of its 8 × 8 blocks, row by row.
//!
//! ```text
//!   | 0       |       block (I, J) stands at I (I + 1) / 2 + J,   J ≤ I,
//!   | 1 2     |       and holds S[8I + r][8J + c] at [r][c]
//!   | 3 4 5   |
//! ```
//! Blocks on the diagonal are held whole. A block serves twice, as itself and transposed, so half of
//! the matrix is all that is stored and read; eight numbers of the sum stay in registers for
//! 64 products, and of fixed length nothing needs a bounds check. An order that is no multiple of
//! eight is filled up with zeros, and so are vectors: [`padded`] is the length that all arrays have.

use crate::error::{Array, Error, same_length};
use crate::real::Real;

/// Rows and columns of a block.
pub const SIDE: usize = 8;

/// Its entries, by rows.
pub type Block<R> = [[R; SIDE]; SIDE];

/// The length of vectors for a matrix of this order.
pub const fn padded(order: usize) -> usize {
    order.next_multiple_of(SIDE)
}

/// How many blocks a matrix of this order has.
pub const fn count(order: usize) -> usize {
    let rows = order.div_ceil(SIDE);
    rows * (rows + 1) / 2
}

/// A symmetric matrix (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Blocks<'a, R> {
    blocks: &'a [Block<R>],
    order: usize,
}

impl<'a, R: Real> Blocks<'a, R> {
    /// Takes [`count`] blocks of a matrix of `order` rows.
    ///
    /// # Errors
    /// Another number of blocks.
    pub fn new(blocks: &'a [Block<R>], order: usize) -> Result<Self, Error> {
        same_length(Array::MatrixValues, blocks.len(), count(order))?;
        Ok(Self { blocks, order })
    }

    /// How many rows there are, padding left out.
    pub fn order(&self) -> usize {
        self.order
    }

    /// All blocks in order.
    pub fn blocks(&self) -> &'a [Block<R>] {
        self.blocks
    }
}

/// `sum` += S x, for an x that is 0 where `used` is not set: such groups of eight cost nothing.
///
/// # Errors
/// Arrays of the wrong length: all have [`padded`] entries.
#[inline(never)]
pub fn multiply_add<R: Real>(
    blocks: &[Block<R>],
    x: &[R],
    used: &[bool],
    sum: &mut [R],
) -> Result<(), Error> {
    same_length(Array::Unknowns, x.len(), used.len())?;
    same_length(Array::Scratch, sum.len(), used.len())?;
    same_length(Array::MatrixValues, blocks.len(), count(used.len()))?;
    let (x, used, sums) = (groups(x), groups(used), groups_mut(sum));
    let mut rest = blocks;
    for (row, (own, is_used)) in x.iter().zip(used).enumerate() {
        let Some(Row { left, diagonal, below }) = Row::split(rest, row) else { break };
        let Some((above, [sum, ..])) = sums.split_at_mut_checked(row) else { break };
        // Copies, which no write to a sum can change, stay in registers.
        let (own, mut total) = (*own, *sum);
        let others = left.iter().zip(x).zip(above).zip(used);
        if *is_used == [false; SIDE] {
            for (((block, x), _), used) in others {
                if *used != [false; SIDE] {
                    add_product(block, x, &mut total);
                }
            }
        } else {
            for (((block, x), sum), used) in others {
                if *used != [false; SIDE] {
                    add_product(block, x, &mut total);
                }
                add_transposed(block, &own, sum);
            }
            add_product(diagonal, &own, &mut total);
        }
        *sum = total;
        rest = below;
    }
    Ok(())
}

/// One row of blocks.
pub(super) struct Row<'a, R> {
    /// Left of the diagonal.
    pub left: &'a [Block<R>],
    /// On it.
    pub diagonal: &'a Block<R>,
    /// All rows that follow.
    pub below: &'a [Block<R>],
}

impl<'a, R> Row<'a, R> {
    /// Row `row` of the blocks that begin with it.
    #[inline(always)]
    pub fn split(blocks: &'a [Block<R>], row: usize) -> Option<Self> {
        let (left, rest) = blocks.split_at_checked(row)?;
        let (diagonal, below) = rest.split_first()?;
        Some(Self { left, diagonal, below })
    }
}

/// `sum` += B x
#[inline(always)]
pub(super) fn add_product<R: Real>(block: &Block<R>, x: &[R; SIDE], sum: &mut [R; SIDE]) {
    for (sum, row) in sum.iter_mut().zip(block) {
        row.iter().zip(x).for_each(|(&entry, &x)| *sum += entry * x);
    }
}

/// `sum` += Bᵀ x
#[inline(always)]
pub(super) fn add_transposed<R: Real>(block: &Block<R>, x: &[R; SIDE], sum: &mut [R; SIDE]) {
    let mut total = *sum;
    for (row, &x) in block.iter().zip(x) {
        total.iter_mut().zip(row).for_each(|(sum, &entry)| *sum += entry * x);
    }
    *sum = total;
}

/// A vector by groups of eight; what its length leaves over is left out.
#[inline(always)]
pub(super) fn groups<T>(vector: &[T]) -> &[[T; SIDE]] {
    vector.as_chunks().0
}

/// The same, to be written.
#[inline(always)]
pub(super) fn groups_mut<T>(vector: &mut [T]) -> &mut [[T; SIDE]] {
    vector.as_chunks_mut().0
}
