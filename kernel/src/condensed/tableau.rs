//! The sweep operator: a symmetric matrix with some of its unknowns exchanged for their residuals.
//!
//! Exchanging the set I of S x = w for w_I turns S into the tableau
//! ```text
//!   T = | −S_II⁻¹          S_II⁻¹ S_IA             |        w_I = 0, x_A = 0 and S x − b = w give
//!       |  S_AI S_II⁻¹     S_AA − S_AI S_II⁻¹ S_IA |        x_I = −T_II b_I,  w_A = T_AI b_I − b_A.
//! ```
//! It stays symmetric, so its lower triangle is all of it, and one more index k is exchanged by a
//! correction of rank one, whichever way it goes:
//! ```text
//!   T_ij ← T_ij − T_ik T_jk / T_kk,     T_ik ← T_ik / |T_kk|,     T_kk ← −1 / T_kk.
//! ```
//! The same formulas move the answer z = (−x_I, w_A) along, as one more row of the matrix.
//!
//! The pivots T_kk of a positive definite S never vanish; they fall to the smallest eigenvalue of S
//! at worst, and rounding errors grow with its inverse. Who exchanges for a long time checks the answer
//! against S now and then ([`super::pivoting`]).

use super::panels::{Panels, ROWS};
use crate::error::{Array, Error, same_length};
use crate::real::Real;

/// Memory of a tableau (borrowed): all its numbers mean something only together.
#[derive(Debug)]
pub struct Tableau<'a, R> {
    /// The lower triangle of T row by row, n (n + 1) / 2 numbers.
    entries: &'a mut [R],
    /// Which unknowns are exchanged: the set I.
    exchanged: &'a mut [bool],
    /// One number an unknown.
    column: &'a mut [R],
}

/// Entries of a tableau of n unknowns.
pub const fn entries(order: usize) -> usize {
    order * (order + 1) / 2
}

impl<'a, R: Real> Tableau<'a, R> {
    /// Takes memory that holds a tableau already, or that is about to be [`Tableau::reset`].
    ///
    /// # Errors
    /// Arrays of the wrong length: [`entries`] of them, and twice one an unknown.
    pub fn new(
        entries: &'a mut [R],
        exchanged: &'a mut [bool],
        column: &'a mut [R],
    ) -> Result<Self, Error> {
        let order = exchanged.len();
        same_length(Array::MatrixValues, entries.len(), self::entries(order))?;
        same_length(Array::Scratch, column.len(), order)?;
        Ok(Self { entries, exchanged, column })
    }

    /// Which unknowns are exchanged.
    pub fn exchanged(&self) -> &[bool] {
        self.exchanged
    }

    /// T = S, nothing exchanged.
    ///
    /// # Errors
    /// A matrix of another order.
    pub fn reset(&mut self, matrix: &Panels<R>) -> Result<(), Error> {
        same_length(Array::MatrixValues, matrix.order(), self.exchanged.len())?;
        self.exchanged.fill(false);
        let mut rest = &mut *self.entries;
        for row in 0..self.exchanged.len() {
            let Some((entries, more)) = rest.split_at_mut_checked(row + 1) else { break };
            let columns = entries.iter_mut().enumerate();
            columns.for_each(|(column, entry)| *entry = matrix.at(row, column));
            rest = more;
        }
        Ok(())
    }

    /// The answer z = (−x_I, w_A) for the load b.
    ///
    /// # Errors
    /// Arrays of the wrong length.
    #[inline(never)]
    pub fn answer(&mut self, load: &[R], z: &mut [R]) -> Result<(), Error> {
        self.respond(load, z)?;
        let given = z.iter_mut().zip(load).zip(self.exchanged.iter());
        given.filter(|(_, exchanged)| !**exchanged).for_each(|((z, &b), _)| *z -= b);
        Ok(())
    }

    /// `z` = T b_I: −x_I, and what x_I adds to w_A.
    ///
    /// # Errors
    /// Arrays of the wrong length.
    #[inline(never)]
    pub fn respond(&mut self, load: &[R], z: &mut [R]) -> Result<(), Error> {
        same_length(Array::Load, load.len(), self.exchanged.len())?;
        same_length(Array::Unknowns, z.len(), self.exchanged.len())?;
        let masked = self.column.iter_mut().zip(load).zip(self.exchanged.iter());
        masked.for_each(|((b, &load), &exchanged)| *b = if exchanged { load } else { R::ZERO });
        z.fill(R::ZERO);
        let mut rest = &*self.entries;
        for first in (0..z.len()).step_by(ROWS) {
            let rows = ROWS.min(z.len() - first);
            let Some((block, more)) = rest.split_at_checked(triangle_rows(first, rows)) else { break };
            multiply_block(block, first, rows, self.column, z);
            rest = more;
        }
        Ok(())
    }

    /// Exchanges unknown k, one way or the other, and moves the answer `z` along. Returns whether it
    /// did: a pivot that rounding has eaten leaves everything as it was.
    ///
    /// # Errors
    /// An answer of the wrong length, an unknown that there is not.
    #[inline(never)]
    pub fn exchange(&mut self, k: usize, z: &mut [R]) -> Result<bool, Error> {
        same_length(Array::Unknowns, z.len(), self.exchanged.len())?;
        self.load_column(k)?;
        let (Some(pivot_place), Some(exchanged), Some(answer)) =
            (self.column.get_mut(k), self.exchanged.get_mut(k), z.get_mut(k))
        else {
            return Err(Error::OutOfRange { of: Array::Unknowns, at: k });
        };
        let pivot = core::mem::replace(pivot_place, R::ZERO);
        // Positive where k enters, negative where it leaves; S has a diagonal of 1.
        if !((if *exchanged { -pivot } else { pivot }) > R::from_count(16) * R::EPSILON) {
            return Ok(false);
        }
        *exchanged = !*exchanged;
        let (inverse, shrink) = (R::ONE / pivot, R::ONE / pivot.magnitude());
        let moved = *answer * inverse;
        *answer *= shrink;
        z.iter_mut().zip(self.column.iter()).for_each(|(z, &entry)| *z -= entry * moved);
        self.subtract_rank_one(inverse);
        self.store_column(k, shrink, -inverse);
        Ok(true)
    }

    /// `column` = T_·k
    fn load_column(&mut self, k: usize) -> Result<(), Error> {
        let stray = Error::OutOfRange { of: Array::Unknowns, at: k };
        let row = self.entries.get(entries(k)..entries(k + 1)).ok_or(stray)?;
        self.column.iter_mut().zip(row).for_each(|(place, &entry)| *place = entry);
        for (row, place) in self.column.iter_mut().enumerate().skip(k + 1) {
            *place = self.entries.get(entries(row) + k).copied().unwrap_or(R::ZERO);
        }
        Ok(())
    }

    /// T_·k = `column` · `scale`, T_kk = `diagonal`
    fn store_column(&mut self, k: usize, scale: R, diagonal: R) {
        if let Some(row) = self.entries.get_mut(entries(k)..entries(k + 1)) {
            row.iter_mut().zip(self.column.iter()).for_each(|(place, &entry)| *place = entry * scale);
            row.iter_mut().skip(k).for_each(|place| *place = diagonal);
        }
        for (row, &entry) in self.column.iter().enumerate().skip(k + 1) {
            if let Some(place) = self.entries.get_mut(entries(row) + k) {
                *place = entry * scale;
            }
        }
    }

    /// T −= `column` `column`ᵀ · `inverse`
    fn subtract_rank_one(&mut self, inverse: R) {
        let order = self.exchanged.len();
        let mut rest = &mut *self.entries;
        for first in (0..order).step_by(ROWS) {
            let rows = ROWS.min(order - first);
            let Some((block, more)) = rest.split_at_mut_checked(triangle_rows(first, rows)) else {
                break;
            };
            subtract_block(block, first, rows, self.column, inverse);
            rest = more;
        }
    }
}

/// Numbers in `rows` rows of a lower triangle from row `first` on.
const fn triangle_rows(first: usize, rows: usize) -> usize {
    entries(first + rows) - entries(first)
}

/// z += the rows `first` … of T times b, and their transpose as far as it lies above the diagonal.
#[inline(always)]
fn multiply_block<R: Real>(block: &[R], first: usize, rows: usize, b: &[R], z: &mut [R]) {
    let mut start = 0;
    for row in first..first + rows {
        let Some((entries, own)) = block.get(start..start + row).zip(block.get(start + row)) else {
            return;
        };
        let Some(&factor) = b.get(row) else { return };
        let mut sum = *own * factor;
        if factor == R::ZERO {
            for (&entry, &b) in entries.iter().zip(b) {
                sum += entry * b;
            }
        } else {
            for ((&entry, &b), z) in entries.iter().zip(b).zip(z.iter_mut()) {
                sum += entry * b;
                *z += entry * factor;
            }
        }
        if let Some(z) = z.get_mut(row) {
            *z += sum;
        }
        start += row + 1;
    }
}

/// The rows `first` … of T −= `column` `column`ᵀ · `inverse`
#[inline(always)]
fn subtract_block<R: Real>(block: &mut [R], first: usize, rows: usize, column: &[R], inverse: R) {
    let mut rest = block;
    for row in first..first + rows {
        let Some((entries, more)) = rest.split_at_mut_checked(row + 1) else { return };
        let factor = column.get(row).copied().unwrap_or(R::ZERO) * inverse;
        entries.iter_mut().zip(column).for_each(|(entry, &other)| *entry -= factor * other);
        rest = more;
    }
}
