//! Functions of the plane written as text: loads, gaps, coefficients, exact solutions.
//!
//! ```text
//! sum      = product { (+|-) product }
//! product  = signed { (*|/) signed }
//! signed   = (+|-) signed | power
//! power    = operand [ ^ signed ]              -x^2 = -(x^2),  2^3^2 = 2^9,  2^-x
//! operand  = number | pi | x | y | t | ( sum ) | function ( sum {, sum} )
//! ```
//!
//! text ─► `lexer` ─► `parser` ─► `program` (postfix, constants folded) ─► a value, those of many points, or by
//! dual numbers a value and its gradient. What each operation is stands in `operation`, and
//! what a device would make of it in `arithmetic`.
//!
//! Evaluation follows IEEE: outside its domain an expression is NaN or infinite, and whoever asked
//! decides what that means there. Hence `min` and `max` pass a NaN on instead of dropping it.

mod arithmetic;
mod elementary;
pub mod enclosure;
mod lexer;
mod linear;
mod operation;
mod parser;
mod program;
mod rounded;
mod sharing;
mod stated;
mod step;
#[cfg(test)]
mod tests;

use std::fmt;
use std::ops::Range;

use program::{Numbers, Program};
use rounded::{Rounded, Roundings};
use thiserror::Error;

pub use arithmetic::Arithmetic;
use arithmetic::{Doubles, Dual, Duals};
pub use elementary::Elementary;

/// A parsed expression: evaluates without allocation, cannot fail.
#[derive(Debug, Clone, PartialEq)]
pub struct Expression {
    text: String,
    program: Program,
    arithmetic: Arithmetic,
}

/// The variables that an expression may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variables {
    /// x and y.
    Space,
    /// x, y and the time t.
    SpaceTime,
}

impl Variables {
    fn names(self) -> &'static [&'static str] {
        match self {
            Self::Space => &["x", "y"],
            Self::SpaceTime => &["x", "y", "t"],
        }
    }
}

/// The parts of expressions, for help texts.
pub fn vocabulary() -> String {
    let functions = operation::FUNCTIONS.map(|(name, _)| name).join(", ");
    format!(
        "Expressions in scenes are made of + - * / ^, parentheses, numbers, pi, x, y, in loads, gaps and boundary values \
         also t, and {functions}. As in mathematics -x^2 is -(x^2) and 2^3^2 is 2^9; min and max take two arguments or \
         more, atan2 two, the others one."
    )
}

/// Why a text is not an expression.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{message}")]
pub struct ParseError {
    /// The message: what was found and what was expected.
    pub message: String,
    /// The culprit: bytes of the text, on character boundaries; empty at the end of the text.
    pub span: Range<usize>,
    /// A hint: what to write instead.
    pub hint: Option<String>,
}

impl Expression {
    /// Reads `text`; a name outside `variables`, `pi` and the functions is an error, and so is a
    /// constant expression without a finite value.
    pub fn parse(text: &str, variables: Variables) -> Result<Self, ParseError> {
        let program = parser::parse(text, variables)?;
        Ok(Self { text: text.to_owned(), program, arithmetic: Arithmetic::default() })
    }

    /// The expression whose value is `value` everywhere.
    pub fn constant(value: f64) -> Self {
        let program = Program::constant(value);
        Self { text: format!("{value:?}"), program, arithmetic: Arithmetic::default() }
    }

    /// This expression, evaluated with other numbers and functions.
    #[must_use]
    pub fn with_arithmetic(&self, arithmetic: Arithmetic) -> Self {
        Self { arithmetic, ..self.clone() }
    }

    /// The value at the point (x, y) and the time t; a coordinate −0.0 is read as 0.0.
    pub fn eval(&self, x: f64, y: f64, t: f64) -> f64 {
        if let Some(value) = self.program.value() {
            return value;
        }
        let at = [x + 0.0, y + 0.0, t];
        match self.arithmetic {
            Arithmetic::Double => self.program.run(&Doubles, at),
            other => self.program.run(&other, at.map(|x| other.constant(x))),
        }
    }

    /// The values at many points, the same as [`Expression::eval`] has, in a part of the time.
    pub fn eval_all(&self, points: &[[f64; 2]], t: f64) -> Vec<f64> {
        if let Some(value) = self.program.value() {
            return vec![value; points.len()];
        }
        match self.arithmetic {
            Arithmetic::Double => self.program.run_all(&Doubles, points, t),
            other => self.program.run_all(&other, points, t),
        }
    }

    /// The value and its gradient (∂/∂x, ∂/∂y) at (x, y) and t, in f64 whatever the arithmetic.
    ///
    /// At a kink: the derivative of `abs` and `sign` at 0 is 0, `min` and `max` take the argument
    /// that they return.
    pub fn gradient(&self, x: f64, y: f64, t: f64) -> (f64, [f64; 2]) {
        let Dual { value, gradient } = self.dual([x, y, t], [[1.0, 0.0], [0.0, 1.0]]);
        (value, gradient)
    }

    /// The derivative along `direction`; what does not change along it contributes nothing, however steep it is across.
    pub fn slope(&self, x: f64, y: f64, t: f64, [dx, dy]: [f64; 2]) -> f64 {
        self.dual([x, y, t], [[dx, 0.0], [dy, 0.0]]).gradient[0]
    }

    /// How far the value at a point and t may be off where its coordinates are by `off`, through that and the rounding of constants
    /// and operations; what jumps there is none of it.
    pub fn rounding(&self, point: [f64; 2], off: f64, t: f64) -> f64 {
        let [x, y] = point.map(|value| Rounded { value: value + 0.0, off });
        let t = Rounded { value: t, off: f64::EPSILON * t.abs() };
        self.program.run(&Roundings(self.program.folded), [x, y, t]).off
    }

    /// The value and its derivatives along two ways, on which x and y change so fast.
    fn dual(&self, [x, y, t]: [f64; 3], [dx, dy]: [[f64; 2]; 2]) -> Dual {
        let at = [(x + 0.0, dx), (y + 0.0, dy), (t, [0.0, 0.0])];
        self.program.run(&Duals, at.map(|(value, gradient)| Dual { value, gradient }))
    }

    /// The value, if no variable occurs.
    pub fn is_constant(&self) -> Option<f64> {
        self.program.value()
    }

    /// Whether this is the constant 0, as a missing load is.
    pub fn is_zero(&self) -> bool {
        self.is_constant() == Some(0.0)
    }
}

impl fmt::Display for Expression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}
