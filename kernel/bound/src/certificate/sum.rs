//! A sum whose rounding error does not grow with its length (Kahan).

use signorini_kernel::Real;

/// The sum so far, and what its last digit could not hold.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Sum<R> {
    sum: R,
    lost: R,
}

impl<R: Real> Sum<R> {
    #[inline(always)]
    pub fn add(&mut self, term: R) {
        let next = term - self.lost;
        let sum = self.sum + next;
        self.lost = (sum - self.sum) - next;
        self.sum = sum;
    }

    pub fn value(&self) -> R {
        self.sum
    }
}
