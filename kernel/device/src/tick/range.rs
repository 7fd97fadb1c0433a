//! Data that the scalar has room for, and iterates that are of no use to them.
//!
//! With m = max(|ψ|, |u_D|, |b_i|/K_ii), the size of the data in the unit of u,
//! ```text
//!   m ≤ ε² · the largest number        or a tick is refused before it changes anything,
//!   |u| ≤ 2¹⁰ m / ε                    or the tick begins with zeros.
//! ```
//! u is larger than m by the condition of D⁻¹K at most. Where that is more than 1/ε sweeps move nothing, and 1/ε²
//! leaves room for squares of it. An iterate above the second line was left by data of another size: its slow parts
//! would hide in what rounding makes of the others.

use super::{Data, Memory};
use signorini_kernel::error::{Array, Error, all_moderate};
use signorini_kernel::{Index, Real};

/// An iterate more than this many times m/ε is not worth going on from.
const WORTH: u32 = 1024;

/// m, once load and rows are those of `data`.
///
/// # Errors
/// [`Error::NotFinite`] where the answer may overflow.
pub(super) fn size<R: Real, I: Index, const WIDTH: usize>(
    data: &Data<R, I>,
    memory: &Memory<R, I, WIDTH>,
) -> Result<R, Error> {
    all_moderate(Array::Load, memory.load.iter().copied())?;
    let load = all_moderate(Array::Load, memory.rows.loads())?;
    let lower = all_moderate(Array::LowerBounds, data.law.lower().iter().copied())?;
    let dirichlet = all_moderate(Array::Dirichlet, data.dirichlet.iter().copied())?;
    Ok(load.or_larger(lower).or_larger(dirichlet))
}

/// The largest |u| that a tick still starts from; above it u is zeroed.
pub(super) fn largest_useful<R: Real>(size: R) -> R {
    R::from_count(WORTH) * size / R::EPSILON
}

impl<R: Real, I, const WIDTH: usize> Memory<'_, R, I, WIDTH> {
    /// Zeros the first `unknowns` of u where they are no start for data of this `size`.
    pub(super) fn forget_another_size(&mut self, unknowns: usize, size: R) {
        let u = self.u.get_mut(..unknowns).unwrap_or(&mut []);
        let most = u.iter().fold(R::ZERO, |most, u| most.or_larger(u.magnitude()));
        if !(most <= largest_useful(size)) {
            u.fill(R::ZERO);
        }
    }
}
