//! Values against an independent calculator, gradients against differences, messages.

mod arithmetic;
mod naive;

use super::{Arithmetic, Elementary, Expression, ParseError, Variables};
use signorini_tolerances::scene::{DERIVATIVE, VALUE};

const X: f64 = 1.25;
const Y: f64 = -0.75;
const T: f64 = 0.5;

fn parse(text: &str) -> Result<Expression, ParseError> {
    Expression::parse(text, Variables::SpaceTime)
}

pub(super) fn expression(text: &str) -> Expression {
    parse(text).unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// Computed by Python at (1.25, −0.75), t = 0.5, `^` written as `**`.
const VALUES: [(&str, f64); 55] = [
    ("1", 1.0),
    (".5", 0.5),
    ("1.", 1.0),
    ("1e-3*x", 0.00125),
    ("2.5E+2", 250.0),
    ("1.e2", 100.0),
    ("pi", std::f64::consts::PI),
    ("x+y*t", 0.875),
    ("x-y-t", 1.5),
    ("x/y/t", -3.3333333333333335),
    ("-x^2", -1.5625),
    ("2^3^2", 512.0),
    ("2^-1", 0.5),
    ("2^-x^2", 0.33856388673422316),
    ("-2^-2", -0.25),
    ("(-2)^2", 4.0),
    ("-(-x)", 1.25),
    ("1+-2", -1.0),
    ("2*-x", -2.5),
    ("--x", 1.25),
    ("+-+x", -1.25),
    ("2*-x^2", -3.125),
    ("x^2*y", -1.171875),
    ("x*y^2/t-1", 0.40625),
    ("(x+y)*(x-y)", 1.0),
    ("sin(x)", 0.9489846193555862),
    ("cos(y)", 0.7316888688738209),
    ("tan(x)", 3.0095696738628313),
    ("asin(y)", -0.848062078981481),
    ("acos(y)", 2.4188584057763776),
    ("atan(x)", 0.8960553845713439),
    ("atan2(y,x)", -0.5404195002705842),
    ("atan2(x, -1)", 2.2455372690184494),
    ("sinh(x)", 1.6019190803008256),
    ("cosh(y)", 1.2946832846768448),
    ("tanh(x)", 0.8482836399575129),
    ("exp(y)", 0.4723665527410147),
    ("erf(x)", 0.9229001282564582),
    ("erf(t)", 0.5204998778130465),
    ("erfc(y)", 1.7111556336535152),
    ("erfc(3)", 2.209049699858544e-5),
    ("ln(x)", 0.22314355131420976),
    ("sqrt(x)", 1.118033988749895),
    ("abs(y)", 0.75),
    ("min(x,y)", -0.75),
    ("max(x,y)", 1.25),
    ("min(x,y,-3,t)", -3.0),
    ("max(1,x,2*x,y)", 2.5),
    ("sign(y)", -1.0),
    ("sign(0)", 0.0),
    ("sign(x)", 1.0),
    ("sin(pi*x)*cos(y)+t*x^2-0.5*y", 0.6388678391006067),
    ("exp(-((x-1)^2+(y+1)^2)/0.02)", 0.0019304541362277093),
    (" x\t*\n y ", -0.9375),
    ("sqrt(x^2+y^2)^(2/3)*sin(2/3*atan2(y,x))", -0.45323461046559566),
];

#[test]
fn values_are_those_of_an_independent_calculator() {
    for (text, expected) in VALUES {
        let value = expression(text).eval(X, Y, T);
        let error = (value - expected).abs();
        VALUE.check_over(text, error, expected.abs());
    }
}

#[test]
fn outside_its_domain_an_expression_is_not_finite() {
    for text in ["1/(x-x)", "ln(x-x)", "sqrt(y)", "asin(2*x)", "min(sqrt(y),1)", "max(1,sqrt(y))"] {
        assert!(!expression(text).eval(X, Y, T).is_finite(), "{text}");
    }
}

#[test]
fn negative_zero_is_read_as_zero() {
    assert_eq!(expression("atan2(y, x)").eval(-1.0, -0.0, 0.0), std::f64::consts::PI);
    assert_eq!(expression("1/x").eval(-0.0, 0.0, 0.0), f64::INFINITY);
    let (value, _) = expression("atan2(y, x)").gradient(-1.0, -0.0, 0.0);
    assert_eq!(value, std::f64::consts::PI);
}

#[test]
fn constants_are_folded_and_recognised() {
    assert_eq!(expression("2*3^2-sin(0)").is_constant(), Some(18.0));
    assert!(expression("-0").is_zero() && expression("1-1").is_zero());
    assert_eq!(expression("x*0").is_constant(), None);
    assert!(expression("x+t").uses_time() && !expression("x+y").uses_time());
    assert_eq!(Expression::constant(-1e300).to_string(), "-1e300");
    assert_eq!(expression("-1e300"), expression(&Expression::constant(-1e300).to_string()));
    assert_eq!(Expression::constant(0.1).gradient(X, Y, T), (0.1, [0.0, 0.0]));
}

/// text, culprit, a part of the message or of the hint
const MALFORMED: [(&str, &str, &str); 38] = [
    ("", "", "found the end"),
    ("  ", "", "found the end"),
    ("2x", "x", "write `2*x`"),
    ("x y", "y", "write `x*y`"),
    ("(x)(y)", "(", "write `)*(`"),
    ("2 sin(x)", "sin", "write `2*sin`"),
    ("x(2)", "(", "write `x*(`"),
    ("1.2.3", ".3", "write `1.2*.3`"),
    ("0x10", "x10", "write `0*x10`"),
    ("1e", "e", "write `1`"),
    ("160 W/(m K)", "W", "numbers have no units here"),
    ("1e999", "1e999", "beyond the largest number"),
    ("1e+999-x", "1e+999", "beyond the largest number"),
    ("1/0", "1/0", "its value is inf"),
    ("sqrt(-1)", "sqrt(-1)", "its value is NaN"),
    (".", ".", "no number"),
    ("1+", "", "found the end"),
    ("*x", "*", "found `*`"),
    ("x**2", "*", "a power is written `^`"),
    ("(x", "", "expected `)`, found the end"),
    ("x)", ")", "found `)`"),
    ("()", ")", "found `)`"),
    ("x, y", ",", "found `,`"),
    ("2,5", ",", "written with a point, as in 2.5"),
    ("sin(1,5*x)", "sin", "takes one argument"),
    ("-10 °C", "°", "numbers have no units here"),
    ("(2,5 + x)", ",", "written with a point, as in 2.5"),
    ("(x, y)", ",", "expected `)`, found `,`"),
    ("sin x", "x", "expected `(`"),
    ("sin()", ")", "found `)`"),
    ("sin(x, y)", "sin", "takes one argument"),
    ("atan2(x)", "atan2", "takes two arguments"),
    ("atan2(x, y, 1)", "atan2", "takes two arguments"),
    ("max(x)", "max", "takes two arguments or more"),
    ("log(x)", "log", "known here: x, y, t, pi and the functions sin"),
    ("z", "z", "unknown name `z`"),
    ("3 − x", "−", "write `-`"),
    ("xé", "é", "unexpected character `é`"),
];

#[test]
fn malformed_texts_name_the_culprit() {
    for (text, culprit, part) in MALFORMED {
        let error = parse(text).expect_err(text);
        assert_eq!(&text[error.span.clone()], culprit, "{text}: {error}");
        let said = format!("{} {}", error.message, error.hint.unwrap_or_default());
        assert!(said.contains(part), "{text}: {said}");
    }
}

#[test]
fn time_is_a_name_only_where_it_may_be() {
    let error = Expression::parse("1+t", Variables::Space).expect_err("t in space");
    assert_eq!((error.span, error.message.as_str()), (2..3, "unknown name `t`"));
    assert!(error.hint.is_some_and(|hint| hint.starts_with("known here: x, y, pi")));
}

#[test]
fn chains_are_long_and_nests_are_shallow() {
    assert_eq!(expression(&vec!["1"; 1000].join("+")).is_constant(), Some(1000.0));
    assert_eq!(expression(&vec!["x"; 1000].join("-")).eval(2.0, 0.0, 0.0), -1996.0);
    let nest = |open: &str, close: &str, depth| open.repeat(depth) + "x" + &close.repeat(depth);
    assert_eq!(expression(&nest("(", ")", 64)).eval(2.0, 0.0, 0.0), 2.0);
    assert_eq!(expression(&nest("(1+", ")", 63)).eval(2.0, 0.0, 0.0), 65.0);
    for (open, close) in [("(", ")"), ("-", ""), ("x^", ""), ("sin(", ")"), ("max(x,", ")")] {
        for depth in [65, 500] {
            let error = parse(&nest(open, close, depth)).expect_err("too deep");
            assert!(error.message.starts_with("nested deeper"), "{open}: {error}");
        }
    }
    assert!(parse(&nest("(y+y*", ")", 40)).is_err_and(|error| error.message.starts_with("nested")));
    assert!(parse(&"(".repeat(200_000)).is_err_and(|error| error.message.contains("200000 bytes")));
}

#[test]
fn gradients_match_central_differences() {
    let smooth = VALUES.iter().map(|(text, _)| *text).filter(|text| *text != "acos(y)");
    let more = ["acos(y)", "x^y", "2^x", "x^2/y", "atan2(x*y,x-y)", "tan(x*y)", "ln(x+y^2)"];
    for text in smooth.chain(more) {
        let expression = expression(text);
        let (value, gradient) = expression.gradient(X, Y, T);
        let h = 1e-5;
        let along_x = (expression.eval(X + h, Y, T) - expression.eval(X - h, Y, T)) / (2.0 * h);
        let along_y = (expression.eval(X, Y + h, T) - expression.eval(X, Y - h, T)) / (2.0 * h);
        assert_eq!(value, expression.eval(X, Y, T), "{text}");
        for (exact, difference) in gradient.into_iter().zip([along_x, along_y]) {
            let error = (exact - difference).abs();
            DERIVATIVE.check_over(text, error, 1.0 + exact.abs());
        }
    }
}

#[test]
fn gradients_at_kinks_follow_the_active_branch() {
    let gradient = |text: &str| expression(text).gradient(0.0, 0.0, 0.0).1;
    assert_eq!(gradient("abs(x)"), [0.0, 0.0]);
    assert_eq!(gradient("sign(x)+y"), [0.0, 1.0]);
    assert_eq!(gradient("min(x-1, 2*y)"), [1.0, 0.0]);
    assert_eq!(gradient("max(x-1, 2*y)"), [0.0, 2.0]);
    assert_eq!(gradient("x^1"), [1.0, 0.0]);
    assert_eq!(gradient("x^2+y^0"), [0.0, 0.0]);
    assert_eq!(gradient("x^1.5"), [0.0, 0.0]);
    assert_eq!(gradient("x^(y+1)"), [1.0, 0.0]);
    assert_eq!(gradient("sqrt(x^2+y^2)"), [0.0, 0.0]);
    assert_eq!(expression("x^3").gradient(-2.0, 0.0, 0.0).1, [12.0, 0.0]);
}

/// 37 points leave the last lanes without one; −0.0 is read as 0.0 as by one point.
#[test]
fn many_points_have_the_values_that_each_has_alone() {
    let mut points: Vec<[f64; 2]> =
        (0..37).map(|k| [0.1 * f64::from(k) - 1.7, 1.3 - 0.07 * f64::from(k)]).collect();
    points[5] = [-0.0, -0.0];
    let kinds = [Arithmetic::Double, Arithmetic::Single, Arithmetic::Fast(Elementary::Power)];
    for (text, arithmetic) in VALUES.iter().flat_map(|(text, _)| kinds.map(|kind| (text, kind))) {
        let expression = expression(text).with_arithmetic(arithmetic);
        let all = expression.eval_all(&points, T);
        let alone = points.iter().map(|&[x, y]| expression.eval(x, y, T).to_bits());
        assert!(all.iter().map(|value| value.to_bits()).eq(alone), "{text}, {arithmetic:?}");
    }
    assert!(expression("x").eval_all(&[], T).is_empty());
}

#[test]
fn smooth_is_what_has_all_derivatives() {
    let is_smooth = |text| expression(text).is_smooth();
    for text in
        ["1", "x^2*y - 3*t", "exp(-x)*sin(2*y)/4", "tanh(60*x)", "erf(x) + erfc(y)", "-(x + 1)^3"]
    {
        assert!(is_smooth(text), "{text}");
    }
    let kinks = ["abs(x)", "sign(x - 0.5)", "max(x, y)"];
    let poles = ["1/x", "1/(x*0)", "x^1.5", "x^-1", "2^x", "sqrt(x)", "atan2(y, x)"];
    for text in kinks.into_iter().chain(poles) {
        assert!(!is_smooth(text), "{text}");
    }
}
