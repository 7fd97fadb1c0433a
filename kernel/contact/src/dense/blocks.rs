//! A dense symmetric matrix as the lower triangle of its 8 × 8 blocks, row by row.
//!
//! ```text
//!   | 0       |       block (I, J) stands at I (I + 1) / 2 + J,   J ≤ I,
//!   | 1 2     |       and holds S[8I + r][8J + c] at [r][c]
//!   | 3 4 5   |
//! ```
//! Blocks on the diagonal are held whole. A block serves twice, as itself and transposed, so half of
//! the matrix is all that is stored and read; the sums of eight rows stay in registers through a row of
//! blocks, and of fixed length nothing needs a bounds check. An order that is no multiple of
//! eight is filled up with zeros, and so are vectors: [`padded`] is the length that all arrays have.

use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length};

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
    matrix: &Blocks<R>,
    x: &[R],
    used: &[bool],
    sum: &mut [R],
) -> Result<(), Error> {
    for length in [x.len(), used.len(), sum.len()] {
        same_length(Array::Unknowns, length, padded(matrix.order()))?;
    }
    let (x, used, sums) = (groups(x), groups(used), groups_mut(sum));
    let mut rest = matrix.blocks();
    let is_any = |used: &[bool; SIDE]| *used != [false; SIDE];
    for (row, (own, is_used)) in x.iter().zip(used).enumerate() {
        let Some((own_row, below)) = rest.split_at_checked(row + 1) else { break };
        let Some((left, _)) = own_row.split_at_checked(row) else { break };
        let Some((above, [sum, ..])) = sums.split_at_mut_checked(row) else { break };
        let mut pairs = sum.map(|sum| [sum, R::ZERO]);
        // The diagonal block is the last.
        add_products(own_row.iter().zip(x).zip(used.iter().map(is_any)), &mut pairs);
        if is_any(is_used) {
            // A copy, which no write to a sum can change, stays in registers.
            let own = *own;
            left.iter().zip(above).for_each(|(block, sum)| add_transposed(block, &own, sum));
        }
        *sum = pairs.map(|[even, odd]| even + odd);
        rest = below;
    }
    Ok(())
}

/// `pairs` += Σ B x over the terms in use, a sum of the even columns and one of the odd ones for each row.
///
/// Within the loop over rows of blocks, and with a number of rows that the compiler knows: the sums stay in registers.
#[inline(always)]
pub(super) fn add_products<'a, R: Real>(
    terms: impl Iterator<Item = ((&'a Block<R>, &'a [R; SIDE]), bool)>,
    pairs: &mut [[R; 2]; SIDE],
) {
    for ((block, x), is_used) in terms {
        if !is_used {
            continue;
        }
        // Copies, which no write to a sum can change, stay in registers.
        let x = *x;
        for (pair, row) in pairs.iter_mut().zip(block) {
            *pair = add_in_twos(*pair, row, &x);
        }
    }
}

/// A row times x, even and odd columns apart.
#[inline(always)]
fn add_in_twos<R: Real>(pair: [R; 2], row: &[R; SIDE], x: &[R; SIDE]) -> [R; 2] {
    let (row, x) = (row.as_chunks().0, x.as_chunks().0);
    let terms = row.iter().zip(x);
    terms.fold(pair, |[even, odd], (&[a, b], &[x, y])| [even + a * x, odd + b * y])
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

/// Groups of a vector, to be written.
#[inline(always)]
pub(super) fn groups_mut<T>(vector: &mut [T]) -> &mut [[T; SIDE]] {
    vector.as_chunks_mut().0
}
