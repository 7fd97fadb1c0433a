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
//! The same formulas move the answer z = (−x_I, w_A) along, as one more row of the matrix. To know
//! z and the next pivot takes column k alone, so a correction waits for a second one: two of
//! them in one pass over T cost two thirds of two passes (`correction`).
//!
//! The pivots T_kk of a positive definite S never vanish; they fall to the smallest eigenvalue of S
//! at worst, and rounding errors grow with its inverse. Who exchanges for a long time checks the answer
//! against S now and then ([`super::pivoting`]).

use super::blocks::{Block, Blocks, SIDE, count, groups, groups_mut, multiply_add, padded};
use super::correction::{position, scaled, store, subtract_two};
use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length, same_length_or_empty};

/// Memory of a tableau (borrowed): all its numbers mean something only together.
#[derive(Debug)]
pub struct Tableau<'a, R> {
    order: usize,
    blocks: &'a mut [Block<R>],
    exchanged: &'a mut [bool],
    /// The column of the correction that waits.
    column: &'a mut [R],
    next: &'a mut [R],
    waiting: Option<Pivot<R>>,
}

/// Where a tableau begins (borrowed): S with nothing exchanged, or what the host has prepared.
#[derive(Debug, Clone, Copy)]
pub struct InitialTableau<'a, R> {
    /// T, in [`count`] blocks.
    pub blocks: &'a [Block<R>],
    /// Which unknowns are exchanged in it, `padded` entries; empty where none is.
    pub exchanged: &'a [bool],
}

impl<'a, R: Real> InitialTableau<'a, R> {
    /// S itself, nothing exchanged.
    pub fn untouched(matrix: &Blocks<'a, R>) -> Self {
        Self { blocks: matrix.blocks(), exchanged: &[] }
    }
}

/// An exchange of unknown k: 1/T_kk and 1/|T_kk|.
#[derive(Debug, Clone, Copy)]
struct Pivot<R> {
    at: usize,
    inverse: R,
    shrink: R,
}

impl<'a, R: Real> Tableau<'a, R> {
    /// Takes memory that holds a tableau already, or that is about to be [`Tableau::reset`]: T of `order` rows in
    /// [`count`] blocks, which unknowns are exchanged (`padded` entries), and twice as much scratch.
    ///
    /// # Errors
    /// Arrays of the wrong length.
    pub fn new(
        order: usize,
        blocks: &'a mut [Block<R>],
        exchanged: &'a mut [bool],
        [column, next]: [&'a mut [R]; 2],
    ) -> Result<Self, Error> {
        same_length(Array::MatrixValues, blocks.len(), count(order))?;
        same_length(Array::Contact, exchanged.len(), padded(order))?;
        same_length(Array::Scratch, column.len(), exchanged.len())?;
        same_length(Array::Scratch, next.len(), exchanged.len())?;
        Ok(Self { order, blocks, exchanged, column, next, waiting: None })
    }

    /// Which unknowns are exchanged; padding never is.
    pub fn exchanged(&self) -> &[bool] {
        self.exchanged
    }

    /// Writes `view` of each entry of an answer, given whether it is exchanged, into scratch; returns that and the flags.
    pub(super) fn viewed(
        &mut self,
        z: &[R],
        view: impl Fn(usize, R, bool) -> R,
    ) -> (&[R], &[bool]) {
        let given = z.iter().zip(self.exchanged.iter()).enumerate();
        for (place, (at, (&z, &within))) in self.next.iter_mut().zip(given) {
            *place = view(at, z, within);
        }
        (self.next, self.exchanged)
    }

    /// Begins with `start`.
    ///
    /// # Errors
    /// A tableau of another order.
    #[inline(never)]
    pub fn reset(&mut self, start: &InitialTableau<R>) -> Result<(), Error> {
        same_length(Array::MatrixValues, start.blocks.len(), self.blocks.len())?;
        same_length_or_empty(Array::Contact, start.exchanged.len(), self.exchanged.len())?;
        self.waiting = None;
        self.exchanged.fill(false);
        self.exchanged.iter_mut().zip(start.exchanged).for_each(|(own, &given)| *own = given);
        self.blocks.copy_from_slice(start.blocks);
        Ok(())
    }

    /// T, all exchanges carried out.
    pub fn blocks(&mut self) -> &[Block<R>] {
        self.finish();
        self.blocks
    }

    /// The answer z = (−x_I, w_A) for the load b: T b_I, less b_A outside.
    ///
    /// # Errors
    /// Arrays of the wrong length.
    #[inline(never)]
    pub fn answer(&mut self, load: &[R], z: &mut [R]) -> Result<(), Error> {
        same_length(Array::Load, load.len(), self.exchanged.len())?;
        self.finish();
        let given = self.next.iter_mut().zip(&mut *z).zip(load).zip(self.exchanged.iter());
        for (((within, z), &load), &exchanged) in given {
            (*within, *z) = if exchanged { (load, R::ZERO) } else { (R::ZERO, -load) };
        }
        multiply_add(&Blocks::new(self.blocks, self.order)?, self.next, self.exchanged, z)
    }

    /// Exchanges unknown k, one way or the other, and moves the answer `z` along. Returns whether it
    /// did: a pivot that rounding has eaten leaves everything as it was.
    ///
    /// # Errors
    /// An answer of the wrong length, an unknown that there is not.
    #[inline(never)]
    pub fn exchange(&mut self, k: usize, z: &mut [R]) -> Result<bool, Error> {
        same_length(Array::Unknowns, z.len(), self.exchanged.len())?;
        self.load_next(k);
        let (Some(place), Some(exchanged), Some(answer)) =
            (self.next.get_mut(k), self.exchanged.get_mut(k), z.get_mut(k))
        else {
            return Err(Error::OutOfRange { of: Array::Unknowns, at: k });
        };
        let pivot = core::mem::replace(place, R::ZERO);
        // Positive where k enters, negative where it leaves; S has a diagonal of 1.
        if !((if *exchanged { -pivot } else { pivot }) > R::from_count(16) * R::EPSILON) {
            return Ok(false);
        }
        *exchanged = !*exchanged;
        let new = Pivot { at: k, inverse: R::ONE / pivot, shrink: R::ONE / pivot.magnitude() };
        let moved = *answer * new.inverse;
        *answer *= new.shrink;
        z.iter_mut().zip(self.next.iter()).for_each(|(z, &entry)| *z -= entry * moved);
        match self.waiting.take() {
            None => {
                core::mem::swap(&mut self.column, &mut self.next);
                self.waiting = Some(new);
            }
            Some(first) => self.correct(first, Some(new)),
        }
        Ok(true)
    }

    /// T_·k in scratch, and which unknowns are exchanged.
    pub(super) fn column(&mut self, k: usize) -> (&[R], &[bool]) {
        self.load_next(k);
        (self.next, self.exchanged)
    }

    /// Carries out the correction that waits.
    pub(super) fn finish(&mut self) {
        if let Some(first) = self.waiting.take() {
            self.next.fill(R::ZERO);
            self.correct(first, None);
        }
    }

    /// `next` = T_·k, with the correction that waits.
    fn load_next(&mut self, k: usize) {
        let (own, line) = (k / SIDE, k % SIDE);
        for (group, place) in groups_mut(self.next).iter_mut().enumerate() {
            let Some(block) = self.blocks.get(position(group, own)) else { return };
            if group <= own {
                *place = block.get(line).copied().unwrap_or(*place);
            } else {
                let entries = block.iter().filter_map(|row| row.get(line));
                place.iter_mut().zip(entries).for_each(|(place, &entry)| *place = entry);
            }
        }
        let Some(Pivot { at, inverse, shrink }) = self.waiting else { return };
        let here = self.column.get(k).copied().unwrap_or_default();
        let factor = here * inverse;
        let entries = self.next.iter_mut().zip(self.column.iter());
        entries.for_each(|(next, &entry)| *next -= entry * factor);
        // Row `at` is no difference but a quotient; exchanged back, k = `at` is its own column.
        if let Some(place) = self.next.get_mut(at) {
            *place = here * shrink;
        }
        if k == at {
            let turned = self.next.iter_mut().zip(self.column.iter());
            turned.for_each(|(next, &entry)| *next = entry * shrink);
            self.next.iter_mut().skip(at).take(1).for_each(|place| *place = -inverse);
        }
    }

    /// Corrections in one pass: `first` with `column`, and `second` with `next`, which is 0 where there is none.
    #[inline(never)]
    fn correct(&mut self, first: Pivot<R>, second: Option<Pivot<R>>) {
        let (column, next) = (groups(self.column), groups(self.next));
        let of_second = second.map_or(R::ZERO, |second| second.inverse);
        subtract_two(self.blocks, self.order, [column, next], [first.inverse, of_second]);
        if second.is_none_or(|second| second.at != first.at) {
            // What the first leaves in its own row and column, the second still corrects.
            let own = self.next.get(first.at).copied().unwrap_or_default() * of_second;
            store(self.blocks, first.at, column, first.inverse, |group, place| {
                let mut entries = scaled(group, first.shrink);
                let corrections = next.get(place).into_iter().flatten();
                let corrected = entries.iter_mut().zip(corrections);
                corrected.for_each(|(entry, &next)| *entry -= next * own);
                entries
            });
        }
        if let Some(Pivot { at, inverse, shrink }) = second {
            store(self.blocks, at, next, inverse, |group, _| scaled(group, shrink));
        }
    }
}
