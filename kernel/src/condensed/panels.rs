//! A dense symmetric matrix in panels of four rows, the layout in which a product costs least.
//!
//! ```text
//!   panel b holds rows 4b … 4b + 3, column by column:
//!
//!     | S[4b][0] S[4b+1][0] S[4b+2][0] S[4b+3][0] | S[4b][1] … | … | S[4b][n−1] … S[4b+3][n−1] |
//! ```
//! A sweep reads x_j once for four rows. By symmetry a panel is four columns as well: a product adds
//! four of them at a time and passes over panels whose x are zero, which on contact edges many are. Rows
//! that the last panel has too many are zeros.

use crate::error::{Array, Error, same_length};
use crate::real::Real;

/// Rows of a panel.
pub const ROWS: usize = 4;

/// A symmetric n × n matrix (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Panels<'a, R> {
    entries: &'a [[R; ROWS]],
    order: usize,
}

impl<'a, R: Real> Panels<'a, R> {
    /// Takes ⌈n/4⌉ panels of n entries each, for n = `order`.
    ///
    /// # Errors
    /// Another number of entries.
    pub fn new(entries: &'a [[R; ROWS]], order: usize) -> Result<Self, Error> {
        same_length(Array::MatrixValues, entries.len(), Self::entries(order))?;
        Ok(Self { entries, order })
    }

    /// How many groups of four a matrix of this order takes.
    pub const fn entries(order: usize) -> usize {
        order.div_ceil(ROWS) * order
    }

    /// n
    pub fn order(&self) -> usize {
        self.order
    }

    /// The panels in order, with n entries each.
    pub(super) fn iter(&self) -> impl Iterator<Item = &'a [[R; ROWS]]> {
        // Without rows there are no entries, and any length of a chunk will do.
        self.entries.chunks_exact(self.order.max(1))
    }

    /// S_ij, and 0 outside.
    pub fn at(&self, row: usize, column: usize) -> R {
        let panel = (row / ROWS) * self.order;
        let group = self.entries.get(panel + column);
        group.and_then(|group| group.get(row % ROWS)).copied().unwrap_or(R::ZERO)
    }

    /// `sum` += S x
    ///
    /// # Errors
    /// Arrays of the wrong length.
    #[inline(never)]
    pub fn multiply_add(&self, x: &[R], sum: &mut [R]) -> Result<(), Error> {
        same_length(Array::Unknowns, x.len(), self.order)?;
        same_length(Array::Scratch, sum.len(), self.order)?;
        for (panel, x) in self.iter().zip(x.chunks(ROWS)) {
            let mut own = [R::ZERO; ROWS];
            own.iter_mut().zip(x).for_each(|(own, &x)| *own = x);
            if own.iter().any(|&x| x != R::ZERO) {
                add_columns(panel, own, sum);
            }
        }
        Ok(())
    }
}

/// `sum` += the four columns times `x`
#[inline(always)]
fn add_columns<R: Real>(panel: &[[R; ROWS]], [a, b, c, d]: [R; ROWS], sum: &mut [R]) {
    for (sum, &[p, q, r, s]) in sum.iter_mut().zip(panel) {
        *sum = *sum + p * a + q * b + r * c + s * d;
    }
}
