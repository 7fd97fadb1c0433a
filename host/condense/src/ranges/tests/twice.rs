//! Sums of products in twice the digits of f64: next to it, rounding of f64 is plain to see.

/// The value high + low.
#[derive(Debug, Clone, Copy, Default)]
pub struct Twice {
    high: f64,
    low: f64,
}

impl Twice {
    /// Σ a_i b_i
    pub fn dot(a: &[f64], b: &[f64]) -> Self {
        a.iter().zip(b).fold(Self::default(), |sum, (a, b)| sum.plus(*a, *b))
    }

    /// The sum with a·b.
    pub fn plus(self, a: f64, b: f64) -> Self {
        let product = a * b;
        let (sum, lost) = sum(self.high, product);
        let low = self.low + (lost + a.mul_add(b, -product));
        let (high, low) = (sum + low, (sum - (sum + low)) + low);
        Self { high, low }
    }

    /// The difference to a number of f64.
    pub fn less(self, b: f64) -> f64 {
        let (difference, lost) = sum(self.high, -b);
        difference + (self.low + lost)
    }
}

/// a + b and what rounding takes from it.
fn sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}
