//! The degree of an expression that is a polynomial in x and y.

use super::super::operation::{Binary, Unary};
use super::super::program::Numbers;

/// Degree of a polynomial, infinite where it may be none; and its value where the degree is 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Degree {
    pub degree: f64,
    pub value: f64,
}

/// Degrees.
pub(super) struct Degrees;

fn of(degree: f64) -> Degree {
    Degree { degree, value: f64::NAN }
}

impl Numbers for Degrees {
    type Number = Degree;

    fn constant(&self, value: f64) -> Degree {
        Degree { degree: 0.0, value }
    }

    fn unary(&self, operation: Unary, a: Degree) -> Degree {
        match operation {
            _ if a.degree == 0.0 => self.constant(operation.apply(a.value)),
            Unary::Negate => of(a.degree),
            _ => of(f64::INFINITY),
        }
    }

    fn binary(&self, operation: Binary, a: Degree, b: Degree) -> Degree {
        let is_number = b.degree == 0.0;
        match operation {
            _ if a.degree == 0.0 && is_number => self.constant(operation.apply(a.value, b.value)),
            Binary::Add | Binary::Subtract => of(a.degree.max(b.degree)),
            Binary::Multiply => of(a.degree + b.degree),
            Binary::Divide if is_number && b.value != 0.0 => of(a.degree),
            Binary::Power if is_number && b.value > 0.0 && b.value.fract() == 0.0 => {
                of(a.degree * b.value)
            }
            _ => of(f64::INFINITY),
        }
    }
}
