//! A baked quadratic form ‖Fz‖², F upper triangular and kept by columns. The host found F, so that nothing cancels on the target.
//!
//! The form of the bound vanishes to second order next to smooth solutions: summed from its matrix, most
//! of it would cancel. Its factor has entries of one size, so that ‖Fz‖ is right up to a few ε of
//! Σ|z_j| ‖F_j‖, which is small beside the norm itself. Columns whose z is 0 cost nothing.

use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length};

/// Columns that are added at a time: the sum is read and written once for them.
const TOGETHER: usize = 4;

/// F (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Factor<'a, R> {
    /// The columns, one after the other; column j has j + 1 entries.
    pub columns: &'a [R],
    /// ‖F_j‖ of every column, and over 2ε what may be wrong of it beyond the rounding of its entries.
    pub norms: &'a [R],
}

/// ‖Fz‖, and how far rounding may have put it off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Norm<R> {
    /// ‖Fz‖
    pub value: R,
    /// A bound on its rounding error, that of storing F included.
    pub rounding: R,
}

impl<R: Real> Factor<'_, R> {
    /// ‖F_j‖² of column `at`, from its entries.
    pub(super) fn square(&self, at: usize) -> R {
        let entries = self.columns.iter().skip(at * (at + 1) / 2).take(at + 1);
        entries.fold(R::ZERO, |sum, &entry| sum + entry * entry)
    }

    /// ‖Fz‖, with one scratch number a column.
    ///
    /// # Errors
    /// Arrays of the wrong length.
    #[inline(never)]
    pub fn norm(&self, z: &[R], sum: &mut [R]) -> Result<Norm<R>, Error> {
        let order = self.norms.len();
        same_length(Array::MatrixValues, self.columns.len(), order * (order + 1) / 2)?;
        same_length(Array::Unknowns, z.len(), order)?;
        same_length(Array::Scratch, sum.len(), order)?;
        sum.fill(R::ZERO);
        let (mut rest, mut used, mut size) = (self.columns, 0, R::ZERO);
        let mut waiting: [(&[R], R); TOGETHER] = [(&[], R::ZERO); TOGETHER];
        let mut count = 0;
        for (at, (&z, &norm)) in z.iter().zip(self.norms).enumerate() {
            let Some((column, more)) = rest.split_at_checked(at + 1) else { break };
            rest = more;
            if z == R::ZERO {
                continue;
            }
            (used, size) = (used + 1, size + z.magnitude() * norm);
            if let Some(place) = waiting.get_mut(count) {
                *place = (column, z);
            }
            count += 1;
            if count == TOGETHER {
                add_together(&waiting, sum);
                count = 0;
            }
        }
        waiting.iter().take(count).for_each(|&(column, z)| add(column, z, sum));
        let square = sum.iter().fold(R::ZERO, |square, &entry| square + entry * entry);
        // Each entry is a sum of `used` products; the squares lose some ε of the norm, and what underflows.
        let value = square.rounded_sqrt();
        let terms = R::from_count(used + 4) * R::HALF * R::EPSILON;
        let squares = R::from_count(order as u32 + 4) * R::QUARTER * R::EPSILON;
        let lost = (R::from_count(order as u32) * R::TINY).rounded_sqrt();
        Ok(Norm { value, rounding: terms * size + squares * value + lost })
    }
}

/// `sum` += four columns, the first the shortest.
#[inline(always)]
fn add_together<R: Real>(columns: &[(&[R], R); TOGETHER], sum: &mut [R]) {
    let [(a, p), (b, q), (c, r), (d, s)] = *columns;
    let entries = a.iter().zip(b).zip(c).zip(d);
    for (sum, (((&a, &b), &c), &d)) in sum.iter_mut().zip(entries) {
        *sum = *sum + a * p + b * q + c * r + d * s;
    }
    for (column, z) in columns.iter().skip(1) {
        let tail = sum.iter_mut().zip(column.iter()).skip(a.len());
        tail.for_each(|(sum, &entry)| *sum += entry * *z);
    }
}

/// `sum` += a column
#[inline(always)]
fn add<R: Real>(column: &[R], z: R, sum: &mut [R]) {
    sum.iter_mut().zip(column).for_each(|(sum, &entry)| *sum += entry * z);
}
