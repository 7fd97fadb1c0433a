//! Forms with the form of their derivative along a way: dual numbers over forms.

use super::super::operation::{Binary, Unary};
use super::super::program::Numbers;
use super::derivatives::two_by_root_pi;
use super::form::Form;
use super::interval::Interval;
use super::numbers::Forms;

/// A value and its derivative.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slope {
    pub value: Form,
    pub slope: Form,
}

/// Dual numbers over forms.
pub(super) struct Slopes(pub Forms);

impl Numbers for Slopes {
    type Number = Slope;

    fn constant(&self, value: f64) -> Slope {
        Slope { value: self.0.constant(value), slope: self.0.constant(0.0) }
    }

    fn unary(&self, operation: Unary, a: Slope) -> Slope {
        let value = self.0.unary(operation, a.value);
        Slope { value, slope: self.along(a.slope, || self.derivative(operation, a.value, value)) }
    }

    fn binary(&self, operation: Binary, a: Slope, b: Slope) -> Slope {
        let value = self.0.binary(operation, a.value, b.value);
        Slope { value, slope: self.total(operation, a, b, value) }
    }
}

impl Slopes {
    fn number(&self, value: f64) -> Form {
        self.0.constant(value)
    }

    fn of(&self, operation: Unary, a: Form) -> Form {
        self.0.unary(operation, a)
    }

    fn join(&self, operation: Binary, a: Form, b: Form) -> Form {
        self.0.binary(operation, a, b)
    }

    /// rate · change, where what does not change contributes nothing.
    fn along(&self, change: Form, rate: impl Fn() -> Form) -> Form {
        if change.range() == Interval::ZERO {
            change
        } else {
            self.join(Binary::Multiply, rate(), change)
        }
    }

    /// f′(a), with f(a) known.
    fn derivative(&self, operation: Unary, a: Form, value: Form) -> Form {
        let over = |above: f64, below: Form| self.join(Binary::Divide, self.number(above), below);
        let square = |a: Form| self.join(Binary::Power, a, self.number(2.0));
        let arcsine = |way: f64| {
            let rest = [-1.0, 1.0].map(|way| a.scaled(way).shifted(1.0));
            over(way, self.of(Unary::Sqrt, self.join(Binary::Multiply, rest[0], rest[1])))
        };
        match operation {
            Unary::Negate => self.number(-1.0),
            Unary::Sin => self.of(Unary::Cos, a),
            Unary::Cos => self.of(Unary::Sin, a).scaled(-1.0),
            Unary::Tan => square(value).shifted(1.0),
            Unary::Asin => arcsine(1.0),
            Unary::Acos => arcsine(-1.0),
            Unary::Atan => over(1.0, square(a).shifted(1.0)),
            Unary::Sinh => self.of(Unary::Cosh, a),
            Unary::Cosh => self.of(Unary::Sinh, a),
            Unary::Tanh => over(1.0, square(self.of(Unary::Cosh, a))),
            Unary::Exp => value,
            Unary::Erf | Unary::Erfc => {
                let bell = self.of(Unary::Exp, square(a).scaled(-1.0));
                let factor = Form::flat(a.shape(), two_by_root_pi(), true);
                let way = if operation == Unary::Erf { 1.0 } else { -1.0 };
                self.join(Binary::Multiply, bell, factor).scaled(way)
            }
            Unary::Ln => over(1.0, a),
            Unary::Sqrt => over(0.5, value),
            Unary::Abs => self.chosen(self.number(1.0), self.number(-1.0), a),
            Unary::Sign if a.range().low < 0.0 && a.range().high > 0.0 => {
                Form::flat(a.shape(), Interval::ALL, a.is_defined())
            }
            Unary::Sign => self.number(0.0),
        }
    }

    /// The derivative of an operation on two.
    fn total(&self, operation: Binary, a: Slope, b: Slope, value: Form) -> Form {
        let [left, right] = match operation {
            Binary::Add => [a.slope, b.slope],
            Binary::Subtract => [a.slope, b.slope.scaled(-1.0)],
            Binary::Multiply => [self.along(a.slope, || b.value), self.along(b.slope, || a.value)],
            Binary::Divide => {
                // a′/b − (a/b) b′/b
                let by = |form: Form| self.join(Binary::Divide, form, b.value);
                [
                    self.along(a.slope, || by(self.number(1.0))),
                    self.along(b.slope, || by(value).scaled(-1.0)),
                ]
            }
            Binary::Power => {
                let of_base = || {
                    let below = self.join(Binary::Power, a.value, b.value.shifted(-1.0));
                    self.join(Binary::Multiply, b.value, below)
                };
                let of_exponent =
                    || self.join(Binary::Multiply, value, self.of(Unary::Ln, a.value));
                [self.along(a.slope, of_base), self.along(b.slope, of_exponent)]
            }
            Binary::Atan2 => {
                let square = |a: Form| self.join(Binary::Power, a, self.number(2.0));
                let radius = square(a.value).combined(1.0, &square(b.value), 1.0);
                let by = |form: Form| self.join(Binary::Divide, form, radius);
                [
                    self.along(a.slope, || by(b.value)),
                    self.along(b.slope, || by(a.value.scaled(-1.0))),
                ]
            }
            Binary::Min => {
                return self.chosen(a.slope, b.slope, b.value.combined(1.0, &a.value, -1.0));
            }
            Binary::Max => {
                return self.chosen(a.slope, b.slope, a.value.combined(1.0, &b.value, -1.0));
            }
        };
        left.combined(1.0, &right, 1.0)
    }

    /// `a` where `first` is positive, `b` where it is negative, the hull of both where it may be either: it may be 0 all along a segment,
    /// and change across it.
    fn chosen(&self, a: Form, b: Form, first: Form) -> Form {
        match first.range() {
            Interval { low, high } if low >= 0.0 && high > 0.0 => a,
            Interval { low, high } if high <= 0.0 && low < 0.0 => b,
            _ => Form::flat(a.shape(), a.range().join(b.range()), a.is_defined() && b.is_defined()),
        }
    }
}
