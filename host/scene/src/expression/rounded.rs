//! How far a value may be off: rounding of coordinates, constants and operations, carried from step to step.
//!
//! ```text
//!   off(f(a)) = max |f(a ± off a) − f(a)| + 4ε |f(a)|,   likewise for two operands
//! ```
//! to first order. Jumps are none of it: `sign` carries nothing on, and `atan2` goes by its derivative.

use super::operation::{Binary, Numbers, Unary};

/// Rounding of an operation: functions of libm are up to 4 units in the last place off.
const OPERATION: f64 = 4.0 * f64::EPSILON;

/// A value, and how far it may be off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rounded {
    pub value: f64,
    pub off: f64,
}

/// The arithmetic of such values. Constants are off by the number at least: those that were folded from others.
pub(super) struct Roundings(pub f64);

impl Numbers for Roundings {
    type Number = Rounded;

    fn constant(&self, value: f64) -> Rounded {
        Rounded { value, off: self.0.max(f64::EPSILON * value.abs()) }
    }

    fn unary(&self, operation: Unary, a: Rounded) -> Rounded {
        let nearby = [a.value - a.off, a.value + a.off].map(|a| operation.apply(a));
        match operation {
            Unary::Sign => Rounded { value: operation.apply(a.value), off: 0.0 },
            _ => around(operation.apply(a.value), &nearby),
        }
    }

    fn binary(&self, operation: Binary, a: Rounded, b: Rounded) -> Rounded {
        let value = operation.apply(a.value, b.value);
        if operation == Binary::Atan2 {
            let left = operation.by_first(a.value, b.value);
            let right = operation.by_second(a.value, b.value);
            let off = left.abs() * a.off + right.abs() * b.off;
            return Rounded {
                value,
                off: if off.is_finite() { off } else { 0.0 } + OPERATION * value.abs(),
            };
        }
        let [low, high] = [-1.0, 1.0].map(|sign| a.value + sign * a.off);
        let nearby =
            [low, high].map(|a| [-1.0, 1.0].map(|sign| operation.apply(a, b.value + sign * b.off)));
        around(value, nearby.as_flattened())
    }
}

/// A value with those that operands nearby have; what is not finite there tells nothing.
fn around(value: f64, nearby: &[f64]) -> Rounded {
    let distances = nearby.iter().map(|other| (other - value).abs()).filter(|by| by.is_finite());
    Rounded { value, off: distances.fold(0.0, f64::max) + OPERATION * value.abs() }
}

#[cfg(test)]
mod tests {
    use super::super::tests::expression;

    fn rounding(text: &str, x: f64, y: f64) -> f64 {
        expression(text).rounding([x, y], 2e-12, 0.0)
    }

    #[test]
    fn two_expressions_for_one_value_differ_by_less() {
        let beside = 1.999999999998744;
        for (one, other, x, y) in [
            ("sin(pi)", "0", 0.0, 0.0),
            ("cos(1.5*pi)*1e6", "0", 0.0, 0.0),
            ("1e3*(x - 0.1 - 0.2)", "0", 0.3, 0.0),
            ("min(-y, -2)", "-y", 0.0, beside),
            ("-2", "-y", 1.0, beside),
            ("x^2", "(x - 1)*(x + 1) + 1", 0.7, 0.0),
            ("sqrt(y)", "sqrt(2)", 0.0, beside),
        ] {
            let off = (expression(one).eval(x, y, 0.0) - expression(other).eval(x, y, 0.0)).abs();
            let explained = rounding(one, x, y) + rounding(other, x, y);
            assert!(off > 0.0 || one == "x^2", "{one}: no difference is tried");
            assert!(off <= explained && explained < 1e-8, "{one}, {other}: {off} {explained}");
        }
    }

    #[test]
    fn a_jump_is_no_rounding() {
        for text in ["sign(x - 1)", "atan2(y, -x)", "1/(x - 2)"] {
            assert!(rounding(text, 1.0, 0.0) < 1e-11, "{text}");
        }
    }
}
