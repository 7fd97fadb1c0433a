//! The arithmetic of expressions: f64, the numbers of a device without f64, or dual numbers for gradients.
//!
//! A controller whose loads move in time evaluates them itself, in f32, with the functions of libm or
//! with those of micromath, which are shorter and wrong by up to some percent. [`Arithmetic`] says
//! which, and leaves the expression as it is. Constants stay those of f64: what has no variable in it is
//! computed before a device sees it.

use micromath::{F32, F32Ext};

use super::elementary::Elementary;
use super::operation::{Binary, Unary};
use super::program::Numbers;

/// The numbers and functions that an expression is evaluated with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Arithmetic {
    /// f64 throughout.
    #[default]
    Double,
    /// f32 throughout, each operation correctly rounded; libm is one unit in the last place away from it.
    Single,
    /// f64 throughout but for this function, which is micromath's.
    Fast(Elementary),
}

impl Unary {
    /// The function that a device calls for it, if it calls one of micromath's: that has no erf.
    pub fn elementary(self) -> Option<Elementary> {
        match self {
            Self::Negate | Self::Abs | Self::Sign | Self::Erf | Self::Erfc => None,
            Self::Sin => Some(Elementary::Sin),
            Self::Cos => Some(Elementary::Cos),
            Self::Tan => Some(Elementary::Tan),
            Self::Asin => Some(Elementary::Asin),
            Self::Acos => Some(Elementary::Acos),
            Self::Atan => Some(Elementary::Atan),
            Self::Sinh | Self::Cosh | Self::Tanh | Self::Exp => Some(Elementary::Exp),
            Self::Ln => Some(Elementary::Ln),
            Self::Sqrt => Some(Elementary::Sqrt),
        }
    }

    /// The value at `a` with micromath's function.
    fn fast(self, a: F32) -> F32 {
        match self {
            Self::Negate => -a,
            Self::Sin => a.sin(),
            Self::Cos => a.cos(),
            Self::Tan => a.tan(),
            Self::Asin => asin(a),
            Self::Acos => F32(F32Ext::acos(a.0)),
            Self::Atan => a.atan(),
            Self::Sinh => (exp(a) - exp(-a)) / F32(2.0),
            Self::Cosh => (exp(a) + exp(-a)) / F32(2.0),
            Self::Tanh => F32::ONE - F32(2.0) / (exp(a + a) + F32::ONE),
            Self::Exp => exp(a),
            Self::Ln => ln(a),
            Self::Sqrt => a.sqrt(),
            Self::Abs => a.abs(),
            Self::Sign | Self::Erf | Self::Erfc => F32(self.apply(f64::from(a.0)) as f32),
        }
    }
}

impl Binary {
    /// The function that a device calls for it, if it calls one.
    pub fn elementary(self) -> Option<Elementary> {
        match self {
            Self::Power => Some(Elementary::Power),
            Self::Atan2 => Some(Elementary::Atan2),
            _ => None,
        }
    }

    /// The value at `a`, `b` with micromath's function.
    fn fast(self, a: F32, b: F32) -> F32 {
        match self {
            Self::Power => power(a, b),
            Self::Atan2 => a.atan2(b),
            _ => F32(self.apply(f64::from(a.0), f64::from(b.0)) as f32),
        }
    }
}

// micromath's integers overflow outside these ranges, which panics where overflow is checked and yields
// arbitrary bits where it is not. The exact value stands there instead.

/// e^±RANGE is a normal number.
const RANGE: f32 = 87.0;

fn exp(a: F32) -> F32 {
    if a.0.abs() < RANGE { a.exp() } else { F32(a.0.exp()) }
}

fn asin(a: F32) -> F32 {
    if a.0.abs() <= 1.0 { a.asin() } else { F32(a.0.asin()) }
}

fn ln(a: F32) -> F32 {
    if a.0 > 0.0 { a.ln() } else { F32(a.0.ln()) }
}

fn power(a: F32, b: F32) -> F32 {
    // Not −0.
    let base = a + F32::ZERO;
    let within = base.0 != 0.0 && (b.0 * ln(base.abs()).0).abs() < RANGE;
    if within { base.powf(b) } else { F32(base.0.powf(b.0)) }
}

/// f64, as [`Arithmetic::Double`], known while compiling: vector units take several at once.
pub(super) struct Doubles;

impl Numbers for Doubles {
    type Number = f64;

    fn constant(&self, value: f64) -> f64 {
        value
    }

    fn unary(&self, operation: Unary, a: f64) -> f64 {
        operation.apply(a)
    }

    fn binary(&self, operation: Binary, a: f64, b: f64) -> f64 {
        operation.apply(a, b)
    }
}

/// Any arithmetic. In f32 each result is rounded: what f64 gives rounds sums, products and quotients correctly.
impl Numbers for Arithmetic {
    type Number = f64;

    fn constant(&self, value: f64) -> f64 {
        if *self == Self::Single { f64::from(value as f32) } else { value }
    }

    fn unary(&self, operation: Unary, a: f64) -> f64 {
        match *self {
            Self::Fast(function) if operation.elementary() == Some(function) => {
                f64::from(operation.fast(F32(a as f32)).0)
            }
            _ => self.constant(operation.apply(a)),
        }
    }

    fn binary(&self, operation: Binary, a: f64, b: f64) -> f64 {
        match *self {
            Self::Fast(function) if operation.elementary() == Some(function) => {
                f64::from(operation.fast(F32(a as f32), F32(b as f32)).0)
            }
            _ => self.constant(operation.apply(a, b)),
        }
    }
}

/// A dual number a + a′·ε, ε² = 0: a value and its gradient with respect to (x, y), carried along by the chain rule.
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
        let gradient = change(a.gradient, || operation.derivative(a.value));
        Dual { value: operation.apply(a.value), gradient }
    }

    fn binary(&self, operation: Binary, a: Dual, b: Dual) -> Dual {
        let left = change(a.gradient, || operation.by_first(a.value, b.value));
        let right = change(b.gradient, || operation.by_second(a.value, b.value));
        let gradient = [0, 1].map(|axis| left[axis] + right[axis]);
        Dual { value: operation.apply(a.value, b.value), gradient }
    }
}

/// slope · gradient, where what does not change contributes nothing, and nobody asks for the slope of a constant: the exponent's
/// share of x^2, x² ln x, is undefined for x < 0.
fn change(gradient: [f64; 2], slope: impl Fn() -> f64) -> [f64; 2] {
    if gradient == [0.0; 2] {
        return [0.0; 2];
    }
    let slope = slope();
    gradient.map(|change| if change == 0.0 { 0.0 } else { slope * change })
}
