//! Expressions in f32 and micromath, off by the sizes that their documentation promises.

use super::expression;
use crate::expression::{Arithmetic, Elementary};
use signorini_tolerances::scene::SINGLE;

/// Function, text, the largest relative error of micromath's, at x, y of this test. Logarithms below 1, and
/// powers with them, rest on an inverse that is off by 12 %.
const FUNCTIONS: [(Elementary, &str, f64); 16] = [
    (Elementary::Sqrt, "sqrt(x)", 6.1e-2),
    (Elementary::Sin, "sin(x)", 4e-3),
    (Elementary::Cos, "cos(x)", 4e-3),
    (Elementary::Tan, "tan(x)", 1e-2),
    (Elementary::Asin, "asin(y)", 6.1e-2),
    (Elementary::Acos, "acos(y)", 6.1e-2),
    (Elementary::Atan, "atan(x)", 1e-2),
    (Elementary::Atan2, "atan2(y,x)", 1e-2),
    (Elementary::Exp, "exp(x)", 1e-3),
    (Elementary::Exp, "sinh(x)", 2e-3),
    (Elementary::Exp, "cosh(x)", 2e-3),
    (Elementary::Exp, "tanh(x)", 2e-3),
    (Elementary::Ln, "ln(x)", 0.2),
    (Elementary::Ln, "ln(x + 1)", 1e-3),
    (Elementary::Power, "x^3", 0.4),
    (Elementary::Power, "(x + 1)^3", 2e-3),
];

const AT: [f64; 3] = [0.6, 0.4, 0.0];

fn relative_error(text: &str, arithmetic: Arithmetic) -> f64 {
    let ([x, y, t], exact) = (AT, expression(text));
    let (value, truth) = (exact.with_arithmetic(arithmetic).eval(x, y, t), exact.eval(x, y, t));
    ((value - truth) / truth).abs()
}

#[test]
fn micromath_errs_as_documented_and_never_by_nothing() {
    for (function, text, most) in FUNCTIONS {
        let error = relative_error(text, Arithmetic::Fast(function));
        assert!((1e-6..=most).contains(&error), "{text}: {error:e}, at most {most:e}");
        assert!(expression(text).calls(function) > 0, "{text}");
    }
    for function in Elementary::ALL {
        assert!(FUNCTIONS.iter().any(|(known, ..)| *known == function), "{}", function.name());
    }
}

#[test]
fn the_square_root_of_two_is_off_by_percents() {
    let root = expression("sqrt(x)").with_arithmetic(Arithmetic::Fast(Elementary::Sqrt));
    assert_eq!(root.eval(2.0, 0.0, 0.0), 1.5);
}

#[test]
fn outside_its_domain_a_fast_function_is_no_number() {
    for (function, text) in [
        (Elementary::Asin, "asin(x)"),
        (Elementary::Acos, "acos(x)"),
        (Elementary::Sqrt, "sqrt(-1 - x)"),
        (Elementary::Ln, "ln(-x)"),
    ] {
        let fast = expression(text).with_arithmetic(Arithmetic::Fast(function));
        assert!(fast.eval(1.5, 0.0, 0.0).is_nan(), "{text}");
    }
}

#[test]
fn single_precision_errs_by_rounding_alone() {
    for (_, text, _) in FUNCTIONS {
        let error = relative_error(text, Arithmetic::Single);
        SINGLE.check(text, error);
    }
    assert!(relative_error("x*y", Arithmetic::Single) > 0.0);
}

#[test]
fn where_micromath_overflows_the_exact_value_stands() {
    let powers = ["x^3", "(-x)^3", "x^-3", "x^0.25", "ln(x)", "ln(-x)", "exp(x)", "tanh(x)"];
    for text in powers {
        for x in [0.0, -0.0, 1e30, -1e30, 1e-30, f64::INFINITY, f64::NAN] {
            for function in [Elementary::Power, Elementary::Ln, Elementary::Exp] {
                let _ =
                    expression(text).with_arithmetic(Arithmetic::Fast(function)).eval(x, 0.0, 0.0);
            }
        }
    }
    let cube = expression("max(-x, 0)^3").with_arithmetic(Arithmetic::Fast(Elementary::Power));
    assert_eq!(cube.eval(0.0, 0.0, 0.0), 0.0);
}

#[test]
fn one_function_is_replaced_and_no_other() {
    let text = "x*y - sqrt(x)/max(y, 0.1) + abs(-x)";
    assert_eq!(relative_error(text, Arithmetic::Fast(Elementary::Sin)), 0.0);
    assert!(relative_error(text, Arithmetic::Fast(Elementary::Sqrt)) > 1e-3);
    assert_eq!(expression("sin(x)^2 + sin(y) + sin(2)").calls(Elementary::Sin), 2);
}
