//! Enclosures hold what they promise: every operation, random trees, random regions and points; and a planted error is found.

use super::super::operation::{Binary, FUNCTIONS, Function, Unary};
use super::super::program::Numbers;
use super::super::{Expression, Variables};
use super::form::Form;
use super::numbers::Forms;
use super::{Interval, Region};
use signorini_tolerances::scene::ENCLOSED;

const TREES: usize = 10_000;
const POINTS: usize = 1_000;
const T: f64 = 0.5;

/// xorshift
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// A tree of all operations.
    fn tree(&mut self, depth: u32) -> String {
        if depth == 0 || self.next() < 0.15 {
            let number = format!("{:.2}", self.between(-3.0, 3.0));
            let leaves = ["x", "y", "x", "y", "t", "2", "3", "0.5", &number];
            return format!("({})", leaves[self.below(leaves.len())]);
        }
        let a = self.tree(depth - 1);
        if self.next() < 0.5 {
            let symbol = ["+", "-", "*", "/", "^", "^2", "^3", "^-1"][self.below(8)];
            let b = if symbol.len() == 1 { self.tree(depth - 1) } else { String::new() };
            return format!("({a}{symbol}{b})");
        }
        match FUNCTIONS[self.below(FUNCTIONS.len())] {
            (name, Function::One(_)) => format!("{name}({a})"),
            (name, _) => format!("{name}({a}, {})", self.tree(depth - 1)),
        }
    }

    fn expression(&mut self) -> Expression {
        loop {
            let text = self.tree(4);
            if let Ok(found) = Expression::parse(&text, Variables::SpaceTime) {
                return found;
            }
        }
    }

    /// A region of any kind; half of them have a corner on a grid, where data like to have their kinks.
    fn region(&mut self) -> Region {
        let size = 10.0_f64.powf(self.between(-3.0, 0.5));
        let [mut x, mut y] = [self.between(-2.0, 2.0), self.between(-2.0, 2.0)];
        if self.next() < 0.5 {
            [x, y] = [0.5 * (2.0 * x).round(), 0.5 * (2.0 * y).round()];
        }
        let mut off = || if self.next() < 0.3 { 0.0 } else { 0.4 * size * (self.next() - 0.5) };
        let corner = |p: f64, q: f64, off: &mut dyn FnMut() -> f64| {
            [x + p * size + off(), y + q * size + off()]
        };
        let a = [x, y];
        let [b, c, d] = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[p, q]| corner(p, q, &mut off));
        let whole = match self.below(3) {
            0 => Region::segment([a, b]),
            1 => Region::triangle([a, b, c]),
            _ => Region::quad([a, b, c, d]),
        };
        let parts = whole.parts();
        if self.next() < 0.5 { whole } else { parts[self.below(parts.len())] }
    }

    /// Reference coordinates inside a region.
    fn point(&mut self, region: &Region) -> [f64; 2] {
        let [a, b] = [self.next(), self.next()];
        match region.corners().len() {
            2 => [2.0 * a - 1.0, 0.0],
            3 if a + b > 1.0 => [2.0 / 3.0 - a, 2.0 / 3.0 - b],
            3 => [a - 1.0 / 3.0, b - 1.0 / 3.0],
            _ => [2.0 * a - 1.0, 2.0 * b - 1.0],
        }
    }
}

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
            assert!(
                !is_outside(&form, at, value),
                "{expression} at {x}, {y}: {value} in {region:?}, {form:?}"
            );
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
            assert!(
                !found.is_finite() || all.holds(found),
                "{expression} at {x}, {y}: {found} in {slope:?}"
            );
        }
    }
}

#[test]
fn every_time_of_an_interval_is_enclosed() {
    let mut random = Random(0x71e);
    for _ in 0..TREES / 10 {
        let (expression, region) = (random.expression(), random.region());
        let form = expression.enclose_during(&region, Interval::new(0.25, 0.75));
        for _ in 0..POINTS / 10 {
            let at = random.point(&region);
            let ([x, y], t) = (region.place(at), random.between(0.25, 0.75));
            let value = expression.eval(x, y, t);
            assert!(
                !is_outside(&form, at, value),
                "{expression} at {x}, {y}, {t}: {value}, {form:?}"
            );
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
        let [x, y] = region.coordinates();
        let numbers = Planted(Forms(region.shape()));
        let form = expression.program.run(&numbers, [x, y, numbers.constant(T)]);
        let mut outside = || {
            let at = random.point(&region);
            let [x, y] = region.place(at);
            is_outside(&form, at, expression.eval(x, y, T))
        };
        found += usize::from((0..50).any(|_| outside()));
    }
    assert!(found > 20, "{found} of 200");
}

fn parse(text: &str) -> Expression {
    Expression::parse(text, Variables::SpaceTime).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn square(x: f64, y: f64, size: f64) -> Region {
    Region::quad([[x, y], [x + size, y], [x + size, y + size], [x, y + size]])
}

/// A Taylor remainder of degree 2 falls by 8 where a region is halved.
#[test]
fn remainders_fall_with_the_third_power() {
    for text in [
        "sin(3*x)*exp(y)",
        "1/(2 + x*y)",
        "sqrt(1 + x^2 + y^2)",
        "atan2(y + 2, x - 1)",
        "tanh(x - y)",
        "x^y",
    ] {
        let expression = parse(text);
        let width = |size: f64| expression.enclose(&square(0.3, 0.4, size), T).remainder.width();
        let rate = width(0.02) / width(0.01);
        assert!((7.0..9.0).contains(&rate), "{text}: {rate}");
    }
}

/// Integrals over parts sum up to the exact one, and enclose it.
#[test]
fn integrals_hold_the_exact_ones() {
    let expression = parse("exp(x)*cos(y)");
    let one = Region::triangle([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    // ∫₀¹ eˣ sin(1 − x) dx = ½(e − cos 1 − sin 1)
    let exact = 0.5 * (1.0_f64.exp() - 1.0_f64.cos() - 1.0_f64.sin());
    let mut parts = vec![one];
    for _ in 0..5 {
        let all = parts.iter().map(|part| part.integral(&expression.enclose(part, T)));
        let sum = all.fold(Interval::ZERO, |sum, part| sum + part);
        assert!(sum.holds(exact), "{sum:?}, {exact}");
        parts = parts.iter().flat_map(Region::parts).collect();
    }
    let quad = Region::quad([[0.0, 0.0], [2.0, 0.0], [1.5, 1.0], [0.0, 1.0]]);
    // A straight right side from x = 2 to 1.5: ∫x = ½∫(2 − ½y)² dy.
    let moment = quad.integral(&parse("x").enclose(&quad, T));
    assert!(moment.holds(37.0 / 24.0), "{moment:?}");
    ENCLOSED.check("a moment", moment.width());
    let length = Region::segment([[0.0, 0.0], [3.0, 4.0]]);
    ENCLOSED.check("a length", length.integral(&parse("x^2").enclose(&length, T)).middle() - 15.0);
}

/// Sides on a kink or at the end of a domain are not crossed by rounding.
#[test]
fn kinks_and_ends_of_domains_on_a_side_are_exact() {
    for (text, range) in [
        ("abs(2*x - 1)", [0.0, 1.0]),
        ("max(0.5 - x, y)", [0.0, 0.5]),
        ("sign(x - 0.5)", [1.0, 1.0]),
        ("sign(0.5 - x)*y", [-0.5, 0.0]),
        ("sqrt(3*x - 1.5)", [0.0, 1.5_f64.sqrt().next_up()]),
        ("sqrt(x^2 + y^2 - 0.25)", [0.0, 1.0]),
    ] {
        let form = parse(text).enclose(&square(0.5, 0.0, 0.5), T);
        assert!(form.is_finite(), "{text}: {form:?}");
        let [low, high] = [form.range().low, form.range().high];
        assert!(low == range[0] && high <= range[1] * (1.0 + 1e-14), "{text}: {low} {high}");
    }
    let form = parse("atan2(y, x)").enclose(&square(-1.0, 0.0, 0.5), T);
    assert!(form.range().low > 2.0, "{form:?}");
}

/// A kink lies between its chord and the kink: exact on either side, and no wider than the smaller side.
#[test]
fn a_kink_near_a_side_is_narrow() {
    let form = parse("abs(x - 0.01)").enclose(&square(0.0, 0.0, 1.0), T);
    assert!(form.remainder.width() < 0.02 && form.remainder.width() > 0.0198, "{form:?}");
}

#[test]
fn what_has_no_value_is_said() {
    let unit = square(-0.5, -0.5, 1.0);
    for (text, range) in [
        ("1/x", Interval::ALL),
        ("1/(x^2)", Interval::new(4.0, f64::INFINITY)),
        ("ln(x)", Interval::new(f64::NEG_INFINITY, 0.5_f64.ln())),
        ("sqrt(x)", Interval::new(0.0, 0.5_f64.sqrt())),
        ("x/y", Interval::ALL),
        ("asin(3*x)", Interval::around(std::f64::consts::FRAC_PI_2)),
    ] {
        let form = parse(text).enclose(&unit, T);
        assert!(!form.is_finite(), "{text}: {form:?}");
        let ends = [form.range().low - range.low, form.range().high - range.high];
        let is_near = |off: f64| off.is_nan() || off.abs() < 1e-12;
        assert!(ends.into_iter().all(is_near), "{text}: {form:?}");
    }
    // Infinite in between, and finite: 1/0² is ∞, and e^−∞ is 0.
    assert!(parse("exp(-1/x^2)").enclose(&unit, T).is_finite());
}
