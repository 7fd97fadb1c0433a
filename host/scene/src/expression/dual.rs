//! Dual numbers a + a′·ε, ε² = 0: arithmetic on them carries the gradient along by the chain rule.

use super::operation::{Binary, Unary};
use super::program::Numbers;

/// A value and its gradient with respect to (x, y).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Dual {
    pub value: f64,
    pub gradient: [f64; 2],
}

/// Dual numbers over f64.
pub(super) struct Duals;

impl Numbers for Duals {
    type Number = Dual;

    fn constant(&self, value: f64) -> Dual {
        Dual { value, gradient: [0.0, 0.0] }
    }

    fn unary(&self, operation: Unary, a: Dual) -> Dual {
        let slope = operation.derivative(a.value);
        Dual {
            value: operation.apply(a.value),
            gradient: a.gradient.map(|change| along(slope, change)),
        }
    }

    fn binary(&self, operation: Binary, a: Dual, b: Dual) -> Dual {
        let [left, right] = operation.partials(a.value, b.value);
        let total = |axis: usize| along(left, a.gradient[axis]) + along(right, b.gradient[axis]);
        Dual { value: operation.apply(a.value, b.value), gradient: [total(0), total(1)] }
    }
}

/// slope · change, where what does not change contributes nothing: the exponent's share of x^2,
/// x² ln x, is undefined for x < 0, and no one asked for it.
fn along(slope: f64, change: f64) -> f64 {
    if change == 0.0 { 0.0 } else { slope * change }
}
