//! Dual numbers a + a′·ε, ε² = 0: arithmetic on them carries the gradient along by the chain rule.

use super::operation::{Binary, Unary};
use super::program::Number;

/// A value and its gradient with respect to (x, y).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Dual {
    pub value: f64,
    pub gradient: [f64; 2],
}

impl Number for Dual {
    fn constant(value: f64) -> Self {
        Self { value, gradient: [0.0, 0.0] }
    }

    fn unary(self, operation: Unary) -> Self {
        let slope = operation.derivative(self.value);
        Self {
            value: operation.apply(self.value),
            gradient: self.gradient.map(|change| along(slope, change)),
        }
    }

    fn binary(self, operation: Binary, other: Self) -> Self {
        let [left, right] = operation.partials(self.value, other.value);
        let total =
            |axis: usize| along(left, self.gradient[axis]) + along(right, other.gradient[axis]);
        Self { value: operation.apply(self.value, other.value), gradient: [total(0), total(1)] }
    }
}

/// slope · change, where what does not change contributes nothing: the exponent's share of x^2,
/// x² ln x, is undefined for x < 0, and no one asked for it.
fn along(slope: f64, change: f64) -> f64 {
    if change == 0.0 { 0.0 } else { slope * change }
}
