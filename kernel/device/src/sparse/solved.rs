//! What an exact solve did, and what its corrections tell of the factor.

use signorini_kernel::Real;

/// Rounds at most, exchanges and corrections together.
pub(super) const ROUNDS: u32 = 16;

/// A start that is so many times as far from the answer as that is large leaves its rounding errors in the choice of
/// edges that touch: it is made once more, from where it has led.
pub(super) const FAR: u32 = 16;

/// What a solve did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solved<R> {
    /// Exchanges.
    pub pivots: u32,
    /// Substitutions with the factor.
    pub rounds: u32,
    /// The last correction that was made, relative to u; infinite where none made it better, or where one has closed
    /// an edge that exchanges had opened.
    pub change: R,
    /// The first step, relative to u.
    pub first: R,
}

impl<R: Real> Solved<R> {
    /// Whether rounding leaves three digits of u at least.
    pub fn has_digits(&self) -> bool {
        R::from_count(1024) * self.change <= R::ONE
    }

    /// Whether corrections have shrunk as only those by a factor of this very matrix do. From a start next to the
    /// answer they may be too small to tell: who needs to know then measures what is left. Nor do they tell where
    /// rounds ran out.
    pub fn contracts(&self) -> bool {
        self.rounds < ROUNDS
            && self.first <= R::from_count(FAR)
            && R::from_count(64) * self.change <= self.first
    }
}
