//! Enclosures hold what they promise: every operation, random trees, random regions and points; and a planted error is found.

mod exact;
mod powers;
mod random;
mod rules;

use super::super::operation::{Binary, Unary};
use super::super::program::Numbers;
use super::form::Form;
use super::numbers::Forms;
use random::Random;

const TREES: usize = 10_000;
const POINTS: usize = 1_000;
const T: f64 = 0.5;

/// Whether a value at reference coordinates is as `form` says: outside if it is not.
fn is_outside(form: &Form, at: [f64; 2], value: f64) -> bool {
    match value.is_finite() {
        true => !(form.at(at).holds(value) && form.range().holds(value)),
        false => form.is_finite(),
    }
}

#[test]
fn no_value_of_random_trees_lies_outside() {
    let mut random = Random(0x5eed);
    for _ in 0..TREES {
        let (expression, region) = (random.expression(), random.region());
        let form = expression.enclose(&region, T);
        for _ in 0..POINTS {
            let at = random.point(&region);
            let [x, y] = region.place(at);
            let value = expression.eval(x, y, T);
            let is_outside = is_outside(&form, at, value);
            assert!(!is_outside, "{expression} at {x}, {y}: {value} in {region:?}, {form:?}");
        }
    }
}

/// Derivatives of values that are moved by an ulp of x move more than those: they get 1e−9 of their terms.
#[test]
fn no_derivative_of_random_trees_lies_outside() {
    let mut random = Random(0xd0a1);
    for _ in 0..TREES / 4 {
        let (expression, region) = (random.expression(), random.region());
        let [value, slope] = expression.enclose_slope(&region, T, [0.6, 0.8]);
        for _ in 0..POINTS / 20 {
            let at = random.point(&region);
            let [x, y] = region.place(at);
            assert!(!is_outside(&value, at, expression.eval(x, y, T)), "{expression} at {x}, {y}");
            let found = expression.slope(x, y, T, [0.6, 0.8]);
            let all = slope.range().widened(1e-9 * (1.0 + slope.range().size().min(1e300)));
            let is_held = !found.is_finite() || all.holds(found);
            assert!(is_held, "{expression} at {x}, {y}: {found} in {slope:?}");
        }
    }
}

/// Forms that forget Lagrange's remainder of functions.
struct Planted(Forms);

impl Numbers for Planted {
    type Number = Form;

    fn constant(&self, value: f64) -> Form {
        self.0.constant(value)
    }

    fn unary(&self, operation: Unary, a: Form) -> Form {
        let mut form = self.0.unary(operation, a);
        form.remainder = a.remainder;
        form
    }

    fn binary(&self, operation: Binary, a: Form, b: Form) -> Form {
        self.0.binary(operation, a, b)
    }
}

#[test]
fn forms_without_their_third_derivative_are_found() {
    let mut random = Random(0xbad);
    let mut found = 0;
    for _ in 0..200 {
        let (expression, region) = (random.expression(), random.region());
        let numbers = Planted(Forms(region.shape()));
        let form = expression.program.at(&numbers, region.coordinates(), T);
        let mut outside = || {
            let at = random.point(&region);
            let [x, y] = region.place(at);
            is_outside(&form, at, expression.eval(x, y, T))
        };
        found += usize::from((0..50).any(|_| outside()));
    }
    assert!(found > 20, "{found} of 200");
}
