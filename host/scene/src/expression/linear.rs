//! Expressions that are stated as numbers plus numbers times one product: c + k·e.

use super::Expression;
use super::operation::{Binary, Unary};
use super::step::Step;

/// Part of two constants up to which they are the same.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// c + k·e, e being a product of steps and of reciprocals of steps; 1 where there are none.
#[derive(Debug, Clone, PartialEq)]
struct Linear<'a> {
    constant: f64,
    factor: f64,
    of: Vec<(&'a [Step], bool)>,
}

impl Expression {
    /// c and k, where this is c + k times `to`, and both are stated as numbers and numbers times the same product.
    pub fn linear_in(&self, to: &Self) -> Option<[f64; 2]> {
        if let Some(value) = self.is_constant() {
            return Some([value, 0.0]);
        }
        let [own, to] = [self, to].map(|expression| Linear::new(&expression.program.steps));
        let slope = own.factor / to.factor;
        let (beside, of_to) = (own.constant, slope * to.constant);
        let is_rounding = (beside - of_to).abs() <= ROUNDING * (beside.abs() + of_to.abs());
        let constant = if is_rounding { 0.0 } else { beside - of_to };
        (own.of == to.of && slope.is_finite()).then_some([constant, slope])
    }
}

impl<'a> Linear<'a> {
    fn new(steps: &'a [Step]) -> Self {
        match steps {
            [Step::Constant(value)] => Self::number(*value),
            [rest @ .., Step::Unary(Unary::Negate)] => Self::new(rest).scaled(-1.0),
            [rest @ .., Step::Binary(operation)] => {
                let (left, right) = operands(rest);
                let [a, b] = [left, right].map(Self::new);
                match operation {
                    Binary::Add => a.plus(b),
                    Binary::Subtract => a.plus(b.scaled(-1.0)),
                    Binary::Multiply if a.of.is_empty() => Some(b.scaled(a.constant)),
                    Binary::Multiply if b.of.is_empty() => Some(a.scaled(b.constant)),
                    Binary::Divide if b.of.is_empty() => Some(a.scaled(1.0 / b.constant)),
                    Binary::Multiply => Some(a.product(left).times(b.product(right))),
                    Binary::Divide => Some(a.product(left).times(b.product(right).inverse())),
                    Binary::Power | Binary::Atan2 | Binary::Min | Binary::Max => None,
                }
                .unwrap_or_else(|| Self::opaque(steps))
            }
            _ => Self::opaque(steps),
        }
    }

    fn number(value: f64) -> Self {
        Self { constant: value, factor: 0.0, of: Vec::new() }
    }

    fn opaque(steps: &'a [Step]) -> Self {
        Self { constant: 0.0, factor: 1.0, of: vec![(steps, false)] }
    }

    /// Without a constant beside the product: `steps` as a whole, where there is one.
    fn product(self, steps: &'a [Step]) -> Self {
        match self.of.is_empty() {
            true => Self { factor: self.constant, constant: 0.0, ..self },
            false if self.constant == 0.0 => self,
            false => Self::opaque(steps),
        }
    }

    fn scaled(self, by: f64) -> Self {
        Self { constant: by * self.constant, factor: by * self.factor, ..self }
    }

    fn plus(self, other: Self) -> Option<Self> {
        let constant = self.constant + other.constant;
        let factor = self.factor + other.factor;
        match (self.of.is_empty(), other.of.is_empty()) {
            (true, _) => Some(Self { constant, ..other }),
            (_, true) => Some(Self { constant, ..self }),
            _ => {
                (self.of == other.of && factor != 0.0).then_some(Self { constant, factor, ..self })
            }
        }
    }

    fn times(self, other: Self) -> Self {
        let of = [self.of, other.of].concat();
        Self { constant: 0.0, factor: self.factor * other.factor, of }
    }

    fn inverse(self) -> Self {
        let of = self.of.into_iter().map(|(steps, is_below)| (steps, !is_below)).collect();
        Self { factor: 1.0 / self.factor, of, ..self }
    }
}

/// The steps of both operands of an operation that follows.
fn operands(steps: &[Step]) -> (&[Step], &[Step]) {
    let mut open = 1;
    let mut at = steps.len();
    while open > 0 && at > 0 {
        at -= 1;
        open -= match steps[at] {
            Step::Constant(_) | Step::Variable(_) => 1,
            Step::Unary(_) => 0,
            Step::Binary(_) => -1,
        };
    }
    steps.split_at(at)
}

#[cfg(test)]
mod tests {
    use super::super::tests::expression;

    #[test]
    fn numbers_and_one_product_are_told_apart() {
        let of = |a: &str, b: &str| expression(a).linear_in(&expression(b));
        let step = "sign(x - 0.3)";
        assert_eq!(of("3", step), Some([3.0, 0.0]));
        assert_eq!(of(&format!("2 + 4*{step}"), step), Some([2.0, 4.0]));
        assert_eq!(of(&format!("(1 - {step}*2)/4"), &format!("1 + {step}")), Some([0.75, -0.5]));
        assert_eq!(of(&format!("6/(1 + {step})"), &format!("2/(1 + {step})")), Some([0.0, 3.0]));
        assert_eq!(of("6*x*exp(y)", "x*exp(y)*2"), Some([0.0, 3.0]));
        assert_eq!(of("3*x/exp(y) + 1", "x/(exp(y)*2)"), Some([1.0, 6.0]));
        assert_eq!(of("-(x*y)", "x*y"), Some([0.0, -1.0]));
        assert_eq!(of("x*y", "y"), None);
        assert_eq!(of("1 + x", "1 + y"), None);
        assert_eq!(of("x/exp(y)", "exp(y)*x"), None);
    }
}
