//! Operations: their values, and their derivatives with respect to each operand.

use std::f64::consts::FRAC_2_SQRT_PI;

/// Operations on one operand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Unary {
    Negate,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Erf,
    Erfc,
    Ln,
    Sqrt,
    Abs,
    Sign,
}

/// Operations on two operands a, b, in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    /// The angle of the point (b, a).
    Atan2,
    Min,
    Max,
}

/// Values that the machine computes with, such as numbers, or numbers with their gradient.
pub(super) trait Numbers {
    type Number: Copy;
    fn constant(&self, value: f64) -> Self::Number;
    fn unary(&self, operation: Unary, a: Self::Number) -> Self::Number;
    fn binary(&self, operation: Binary, a: Self::Number, b: Self::Number) -> Self::Number;
}

/// The operation behind a function name; `Fold` joins two or more arguments pairwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Function {
    One(Unary),
    Two(Binary),
    Fold(Binary),
}

/// The functions by name.
pub(super) const FUNCTIONS: [(&str, Function); 19] = [
    ("sin", Function::One(Unary::Sin)),
    ("cos", Function::One(Unary::Cos)),
    ("tan", Function::One(Unary::Tan)),
    ("asin", Function::One(Unary::Asin)),
    ("acos", Function::One(Unary::Acos)),
    ("atan", Function::One(Unary::Atan)),
    ("atan2", Function::Two(Binary::Atan2)),
    ("sinh", Function::One(Unary::Sinh)),
    ("cosh", Function::One(Unary::Cosh)),
    ("tanh", Function::One(Unary::Tanh)),
    ("exp", Function::One(Unary::Exp)),
    ("erf", Function::One(Unary::Erf)),
    ("erfc", Function::One(Unary::Erfc)),
    ("ln", Function::One(Unary::Ln)),
    ("sqrt", Function::One(Unary::Sqrt)),
    ("abs", Function::One(Unary::Abs)),
    ("min", Function::Fold(Binary::Min)),
    ("max", Function::Fold(Binary::Max)),
    ("sign", Function::One(Unary::Sign)),
];

impl Unary {
    /// Whether it has derivatives of all orders wherever it has a value.
    pub fn is_smooth(self) -> bool {
        match self {
            Self::Negate
            | Self::Sin
            | Self::Cos
            | Self::Atan
            | Self::Sinh
            | Self::Cosh
            | Self::Tanh
            | Self::Exp
            | Self::Erf
            | Self::Erfc => true,
            Self::Tan
            | Self::Asin
            | Self::Acos
            | Self::Ln
            | Self::Sqrt
            | Self::Abs
            | Self::Sign => false,
        }
    }

    /// The value at `a`.
    pub fn apply(self, a: f64) -> f64 {
        match self {
            Self::Negate => -a,
            Self::Sin => a.sin(),
            Self::Cos => a.cos(),
            Self::Tan => a.tan(),
            Self::Asin => a.asin(),
            Self::Acos => a.acos(),
            Self::Atan => a.atan(),
            Self::Sinh => a.sinh(),
            Self::Cosh => a.cosh(),
            Self::Tanh => a.tanh(),
            Self::Exp => a.exp(),
            Self::Erf => libm::erf(a),
            Self::Erfc => libm::erfc(a),
            Self::Ln => a.ln(),
            Self::Sqrt => a.sqrt(),
            Self::Abs => a.abs(),
            Self::Sign => sign(a),
        }
    }

    /// The derivative at `a`; 0 at the kink of `abs` and the jump of `sign`.
    pub fn derivative(self, a: f64) -> f64 {
        match self {
            Self::Negate => -1.0,
            Self::Sin => a.cos(),
            Self::Cos => -a.sin(),
            Self::Tan => 1.0 / a.cos().powi(2),
            Self::Asin => 1.0 / ((1.0 - a) * (1.0 + a)).sqrt(),
            Self::Acos => -1.0 / ((1.0 - a) * (1.0 + a)).sqrt(),
            Self::Atan => 1.0 / (1.0 + a * a),
            Self::Sinh => a.cosh(),
            Self::Cosh => a.sinh(),
            Self::Tanh => 1.0 / a.cosh().powi(2),
            Self::Exp => a.exp(),
            Self::Erf => FRAC_2_SQRT_PI * (-a * a).exp(),
            Self::Erfc => -FRAC_2_SQRT_PI * (-a * a).exp(),
            Self::Ln => 1.0 / a,
            Self::Sqrt => 0.5 / a.sqrt(),
            Self::Abs => sign(a),
            Self::Sign => 0.0,
        }
    }
}

impl Binary {
    /// Whether it has derivatives of all orders whatever its operands are.
    pub fn is_smooth(self) -> bool {
        match self {
            Self::Add | Self::Subtract | Self::Multiply => true,
            Self::Divide | Self::Power | Self::Atan2 | Self::Min | Self::Max => false,
        }
    }

    /// The value at `a`, `b`.
    pub fn apply(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply => a * b,
            Self::Divide => a / b,
            Self::Power => a.powf(b),
            Self::Atan2 => a.atan2(b),
            Self::Min if a <= b || a.is_nan() => a,
            Self::Max if a >= b || a.is_nan() => a,
            Self::Min | Self::Max => b,
        }
    }

    /// The derivative with respect to `a`.
    pub fn by_first(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Add | Self::Subtract => 1.0,
            Self::Multiply => b,
            Self::Divide => 1.0 / b,
            Self::Power if b == 0.0 => 0.0,
            // What a¹ rounds to.
            Self::Power if b == 2.0 => b * a,
            Self::Power => b * a.powf(b - 1.0),
            Self::Atan2 => {
                let radius = a.hypot(b);
                b / radius / radius
            }
            Self::Min => f64::from(a <= b),
            Self::Max => f64::from(a >= b),
        }
    }

    /// The derivative with respect to `b`.
    pub fn by_second(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Add => 1.0,
            Self::Subtract => -1.0,
            Self::Multiply => a,
            Self::Divide => -a / b / b,
            Self::Power if b == 0.0 => a.ln(),
            Self::Power if a == 0.0 => 0.0,
            Self::Power => a.powf(b) * a.ln(),
            Self::Atan2 => {
                let radius = a.hypot(b);
                -a / radius / radius
            }
            Self::Min => 1.0 - f64::from(a <= b),
            Self::Max => 1.0 - f64::from(a >= b),
        }
    }
}

/// −1, 0 or 1; NaN stays NaN.
pub(super) fn sign(a: f64) -> f64 {
    if a == 0.0 { 0.0 } else { a.signum() }
}

#[cfg(test)]
mod tests {
    use super::Unary::{Erf, Erfc};

    #[test]
    fn error_functions_are_symmetric_and_sum_up_to_one() {
        for x in (0..400).map(|k| 0.02 * f64::from(k)) {
            assert_eq!(Erf.apply(-x), -Erf.apply(x), "{x}");
            for x in [-x, x] {
                let sums = [Erf.apply(x) + Erfc.apply(x), 0.5 * (Erfc.apply(-x) + Erfc.apply(x))];
                assert!(sums.into_iter().all(|sum| (sum - 1.0).abs() < 1e-15), "{x}: {sums:?}");
            }
        }
    }

    #[test]
    fn error_functions_have_their_limits() {
        for far in [30.0, f64::MAX, f64::INFINITY] {
            assert_eq!([-far, far].map(|x| Erf.apply(x)), [-1.0, 1.0]);
            assert_eq!([-far, far].map(|x| Erfc.apply(x)), [2.0, 0.0]);
            assert_eq!([Erf, Erfc].map(|of| of.derivative(far)), [0.0; 2]);
        }
        assert!([Erf, Erfc].into_iter().all(|of| of.apply(f64::NAN).is_nan()));
    }
}
