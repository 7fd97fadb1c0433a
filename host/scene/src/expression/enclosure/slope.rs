//! Forms with the form of their derivative along a way: dual numbers over forms.

use super::super::operation::{Binary, Unary};
use super::super::program::Numbers;
use super::derivatives::two_by_root_pi;
use super::form::Form;
use super::interval::Interval;
use super::numbers::{Forms, root};

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
    /// rate · change, where what does not change contributes nothing.
    fn along(&self, change: Form, rate: impl Fn() -> Form) -> Form {
        if change.range() == Interval::ZERO {
            change
        } else {
            self.0.binary(Binary::Multiply, rate(), change)
        }
    }

    /// f′(a), with f(a) known.
    fn derivative(&self, operation: Unary, a: Form, value: Form) -> Form {
        let Self(forms) = self;
        let over = |above: f64, below: Form| forms.constant(above).over(&below);
        let arcsine = |way: f64| {
            let [right, left] = [-1.0, 1.0].map(|way| a.scaled(way).shifted(1.0));
            over(way, root(&forms.binary(Binary::Multiply, right, left)))
        };
        match operation {
            Unary::Negate => forms.constant(-1.0),
            Unary::Sin => forms.unary(Unary::Cos, a),
            Unary::Cos => forms.unary(Unary::Sin, a).scaled(-1.0),
            Unary::Tan => value.to(2.0).shifted(1.0),
            Unary::Asin => arcsine(1.0),
            Unary::Acos => arcsine(-1.0),
            Unary::Atan => over(1.0, a.to(2.0).shifted(1.0)),
            Unary::Sinh => forms.unary(Unary::Cosh, a),
            Unary::Cosh => forms.unary(Unary::Sinh, a),
            Unary::Tanh => over(1.0, forms.unary(Unary::Cosh, a).to(2.0)),
            Unary::Exp => value,
            Unary::Erf | Unary::Erfc => {
                let bell = forms.unary(Unary::Exp, a.to(2.0).scaled(-1.0));
                let factor = Form::flat(a.shape(), two_by_root_pi(), true);
                let way = if operation == Unary::Erf { 1.0 } else { -1.0 };
                forms.binary(Binary::Multiply, bell, factor).scaled(way)
            }
            Unary::Ln => over(1.0, a),
            Unary::Sqrt => over(0.5, value),
            Unary::Abs => chosen(forms.constant(1.0), forms.constant(-1.0), a),
            Unary::Sign if a.range().low < 0.0 && a.range().high > 0.0 => {
                Form::flat(a.shape(), Interval::ALL, a.is_defined())
            }
            Unary::Sign => forms.constant(0.0),
        }
    }

    /// The derivative of an operation on two.
    fn total(&self, operation: Binary, a: Slope, b: Slope, value: Form) -> Form {
        let Self(forms) = self;
        let [left, right] = match operation {
            Binary::Add => [a.slope, b.slope],
            Binary::Subtract => [a.slope, b.slope.scaled(-1.0)],
            Binary::Multiply => [self.along(a.slope, || b.value), self.along(b.slope, || a.value)],
            Binary::Divide => {
                // a′/b − (a/b) b′/b
                [
                    self.along(a.slope, || forms.constant(1.0).over(&b.value)),
                    self.along(b.slope, || value.over(&b.value).scaled(-1.0)),
                ]
            }
            Binary::Power => {
                let of_base = || {
                    let below = forms.binary(Binary::Power, a.value, b.value.shifted(-1.0));
                    forms.binary(Binary::Multiply, b.value, below)
                };
                let of_exponent =
                    || forms.binary(Binary::Multiply, value, forms.unary(Unary::Ln, a.value));
                [self.along(a.slope, of_base), self.along(b.slope, of_exponent)]
            }
            Binary::Atan2 => {
                let radius = a.value.to(2.0).combined(1.0, &b.value.to(2.0), 1.0);
                [
                    self.along(a.slope, || b.value.over(&radius)),
                    self.along(b.slope, || a.value.scaled(-1.0).over(&radius)),
                ]
            }
            Binary::Min => return chosen(a.slope, b.slope, b.value.minus(&a.value)),
            Binary::Max => return chosen(a.slope, b.slope, a.value.minus(&b.value)),
        };
        left.combined(1.0, &right, 1.0)
    }
}

/// `a` where `first` is positive, `b` where it is negative, the hull of both where it may be either: it may be 0 all along a segment,
/// and change across it.
fn chosen(a: Form, b: Form, first: Form) -> Form {
    match first.range() {
        Interval { low, high } if low >= 0.0 && high > 0.0 => a,
        Interval { low, high } if high <= 0.0 && low < 0.0 => b,
        _ => Form::flat(a.shape(), a.range().join(b.range()), a.is_defined() && b.is_defined()),
    }
}
