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

use super::blocks::{Block, Blocks, SIDE, count, groups, groups_mut, multiply_add};
use crate::error::{Array, Error, same_length};
use crate::real::Real;

/// Memory of a tableau (borrowed): all its numbers mean something only together.
#[derive(Debug)]
pub struct Tableau<'a, R> {
    blocks: &'a mut [Block<R>],
    exchanged: &'a mut [bool],
    column: &'a mut [R],
}

impl<'a, R: Real> Tableau<'a, R> {
    /// Takes memory that holds a tableau already, or that is about to be [`Tableau::reset`]: T in
    /// [`count`] blocks, which unknowns are exchanged (`padded` entries), and as much scratch.
    ///
    /// # Errors
    /// Arrays of the wrong length.
    pub fn new(
        blocks: &'a mut [Block<R>],
        exchanged: &'a mut [bool],
        column: &'a mut [R],
    ) -> Result<Self, Error> {
        same_length(Array::MatrixValues, blocks.len(), count(exchanged.len()))?;
        same_length(Array::Scratch, column.len(), exchanged.len())?;
        Ok(Self { blocks, exchanged, column })
    }

    /// Which unknowns are exchanged; padding never is.
    pub fn exchanged(&self) -> &[bool] {
        self.exchanged
    }

    /// T = S, nothing exchanged.
    ///
    /// # Errors
    /// A matrix of another order.
    pub fn reset(&mut self, matrix: &Blocks<R>) -> Result<(), Error> {
        same_length(Array::MatrixValues, matrix.blocks().len(), self.blocks.len())?;
        self.exchanged.fill(false);
        self.blocks.iter_mut().zip(matrix.blocks()).for_each(|(own, given)| *own = *given);
        Ok(())
    }

    /// The answer z = (−x_I, w_A) for the load b.
    ///
    /// # Errors
    /// Arrays of the wrong length.
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
    pub fn respond(&mut self, load: &[R], z: &mut [R]) -> Result<(), Error> {
        same_length(Array::Load, load.len(), self.exchanged.len())?;
        let masked = self.column.iter_mut().zip(load).zip(self.exchanged.iter());
        masked.for_each(|((b, &load), &exchanged)| *b = if exchanged { load } else { R::ZERO });
        z.fill(R::ZERO);
        multiply_add(self.blocks, self.column, self.exchanged, z)
    }

    /// Exchanges unknown k, one way or the other, and moves the answer `z` along. Returns whether it
    /// did: a pivot that rounding has eaten leaves everything as it was.
    ///
    /// # Errors
    /// An answer of the wrong length, an unknown that there is not.
    #[inline(never)]
    pub fn exchange(&mut self, k: usize, z: &mut [R]) -> Result<bool, Error> {
        same_length(Array::Unknowns, z.len(), self.exchanged.len())?;
        self.load_column(k);
        let (Some(place), Some(exchanged), Some(answer)) =
            (self.column.get_mut(k), self.exchanged.get_mut(k), z.get_mut(k))
        else {
            return Err(Error::OutOfRange { of: Array::Unknowns, at: k });
        };
        let pivot = core::mem::replace(place, R::ZERO);
        // Positive where k enters, negative where it leaves; S has a diagonal of 1.
        if !((if *exchanged { -pivot } else { pivot }) > R::from_count(16) * R::EPSILON) {
            return Ok(false);
        }
        *exchanged = !*exchanged;
        let (inverse, shrink) = (R::ONE / pivot, R::ONE / pivot.magnitude());
        let moved = *answer * inverse;
        *answer *= shrink;
        z.iter_mut().zip(self.column.iter()).for_each(|(z, &entry)| *z -= entry * moved);
        subtract_rank_one(self.blocks, groups(self.column), inverse);
        self.column.iter_mut().for_each(|entry| *entry *= shrink);
        if let Some(place) = self.column.get_mut(k) {
            *place = -inverse;
        }
        self.store_column(k);
        Ok(true)
    }

    /// `column` = T_·k
    fn load_column(&mut self, k: usize) {
        let (own, line) = (k / SIDE, k % SIDE);
        for (group, place) in groups_mut(self.column).iter_mut().enumerate() {
            let Some(block) = self.blocks.get(position(group, own)) else { return };
            if group <= own {
                *place = block.get(line).copied().unwrap_or(*place);
            } else {
                let entries = block.iter().filter_map(|row| row.get(line));
                place.iter_mut().zip(entries).for_each(|(place, &entry)| *place = entry);
            }
        }
    }

    /// T_·k = `column`
    fn store_column(&mut self, k: usize) {
        let (own, line) = (k / SIDE, k % SIDE);
        for (group, entries) in groups(self.column).iter().enumerate() {
            let Some(block) = self.blocks.get_mut(position(group, own)) else { return };
            if group <= own
                && let Some(row) = block.get_mut(line)
            {
                *row = *entries;
            }
            if group >= own {
                let places = block.iter_mut().filter_map(|row| row.get_mut(line));
                places.zip(entries).for_each(|(place, &entry)| *place = entry);
            }
        }
    }
}

/// Where the block of two groups of unknowns stands.
const fn position(one: usize, other: usize) -> usize {
    let (row, column) = if one > other { (one, other) } else { (other, one) };
    row * (row + 1) / 2 + column
}

/// T −= c cᵀ · `inverse`
#[inline(always)]
fn subtract_rank_one<R: Real>(blocks: &mut [Block<R>], column: &[[R; SIDE]], inverse: R) {
    let mut rest = blocks;
    for (row, own) in column.iter().enumerate() {
        let Some((blocks, more)) = rest.split_at_mut_checked(row + 1) else { return };
        let mut factors = *own;
        factors.iter_mut().for_each(|factor| *factor *= -inverse);
        for (block, other) in blocks.iter_mut().zip(column) {
            // A copy, which no write to a block can change, stays in registers.
            let other = *other;
            for (row, &factor) in block.iter_mut().zip(&factors) {
                row.iter_mut().zip(other).for_each(|(entry, other)| *entry += factor * other);
            }
        }
        rest = more;
    }
}
