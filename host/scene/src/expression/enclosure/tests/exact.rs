//! Enclosures whose ranges, remainders or integrals are known.

use super::super::super::Expression;
pub(super) use super::super::super::tests::expression as parse;
use super::super::{Interval, Region};
use super::T;
use signorini_tolerances::scene::ENCLOSED;

pub fn square(x: f64, y: f64, size: f64) -> Region {
    Region::quad([[x, y], [x + size, y], [x + size, y + size], [x, y + size]])
}

/// A Taylor remainder of degree 2 falls by 8 where a region is halved.
#[test]
fn remainders_fall_with_the_third_power() {
    let some = ["sin(3*x)*exp(y)", "1/(2 + x*y)", "sqrt(1 + x^2 + y^2)", "atan2(y + 2, x - 1)"];
    for text in some.into_iter().chain(["tanh(x - y)", "erf(x - y)", "erfc(x*y)", "x^y"]) {
        let expression = parse(text);
        let width = |size: f64| expression.enclose(&square(0.3, 0.4, size), T).remainder.width();
        let rate = width(0.02) / width(0.01);
        assert!((7.0..9.0).contains(&rate), "{text}: {rate}");
    }
}

/// −1·1 is exact, and −0.2·5 below it is rounded to the same number: 0.2 is less than it is stored as.
#[test]
fn a_product_holds_what_rounds_to_another_exact_one() {
    let [a, b] = [[-1.0, 0.2], [-5.0, 1.0]].map(|[low, high]| Interval { low, high });
    for (a, b) in [(a, b), (b, a), (-a, -b)] {
        assert!((a * b).low < -1.0, "{:?}", a * b);
        assert!((-a * b).high > 1.0, "{:?}", -a * b);
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

/// Where erfc underflows it is less than any number and more than 0; without an end the range is that of the limits.
#[test]
fn error_functions_far_out_keep_their_promise() {
    let far = square(1.0, 0.0, 1.0);
    for (text, low, high) in [
        ("erf(1e200*x)", 1.0 - 1e-15, 1.0),
        ("erf(-30*x)", -1.0, 1e-15 - 1.0),
        ("erfc(30*x)", 0.0, 1e-307),
        ("erfc(1e200*x)", 0.0, 1e-307),
        ("erfc(-30*x)", 2.0 - 6e-15, 2.0),
        ("erfc(1/(x - 1.5))", 0.0, 2.0),
        ("erf(1e300*x*1e300)", 1.0 - 1e-15, 1.0),
    ] {
        let form = parse(text).enclose(&far, T);
        let range = form.range();
        let is_within = range.low >= low && range.high <= high;
        assert!(is_within && range.low < range.high, "{text}: {form:?}");
    }
    for text in ["erf(30*x)", "erfc(30*x)", "erfc(-1e200*x)"] {
        let modulus = parse(text).modulus(&far, 1.5, T);
        assert!(modulus > 0.0 && modulus < 2.0 + 1e-13, "{text}: {modulus}");
    }
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

#[test]
fn degrees_are_those_of_polynomials_alone() {
    for (text, degree) in [
        ("1 + t", 0.0),
        ("x*y - 3*t^2", 2.0),
        ("(x + y)^3*x/(1 + t)", 4.0),
        ("sin(t)*x + max(1, 2)", 1.0),
        ("abs(x)", f64::INFINITY),
        ("x^0.5", f64::INFINITY),
        ("1/x", f64::INFINITY),
    ] {
        assert_eq!(parse(text).degree(T), degree, "{text}");
    }
}

/// Along an affine zero nothing is left but rounding; along a circle each level of strips leaves a quarter.
#[test]
fn jumps_are_cut_along_their_zero() {
    let one = Region::triangle([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    let open = |expression: &Expression, levels: usize| {
        let mut parts = vec![one];
        for _ in 0..levels {
            let cut = |part: &Region| match expression.switch(part, T) {
                Some(argument) => part.cut(&argument).unwrap_or_else(|| part.parts()),
                None => vec![*part],
            };
            parts = parts.iter().flat_map(cut).collect();
        }
        let area: f64 = parts.iter().map(Region::measure).sum();
        ENCLOSED.check("the area of all parts", area - 0.5);
        let is_open = |part: &&Region| expression.switch(part, T).is_some();
        parts.iter().filter(is_open).map(Region::measure).sum::<f64>()
    };
    let line = parse("sign(3*x + 2*y - 1.7)*exp(x)");
    assert!(open(&line, 1) < 1e-13);
    let mut parts = one.cut(&line.switch(&one, T).expect("a jump")).expect("a cut");
    parts.retain(|part| line.switch(part, T).is_none());
    let sum = parts.iter().map(|part| part.integral(&line.enclose(part, T)));
    assert!(sum.fold(Interval::ZERO, |sum, part| sum + part).is_finite());
    let circle = parse("max(x^2 + y^2 - 0.3, 0)");
    let [coarse, fine] = [5, 9].map(|levels| open(&circle, levels));
    assert!(fine < 0.1 * coarse && fine < 2e-3, "{coarse} {fine}");
}
