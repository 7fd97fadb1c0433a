//! Taylor coefficients f, f′, f″/2, f‴/6 of smooth operations, over intervals.

use super::super::operation::Unary;
use super::function::{power, unary};
use super::interval::Interval;
use std::f64::consts::FRAC_2_SQRT_PI;

/// Coefficients of degree 0 to 3.
pub(super) type Series = [Interval; 4];

fn number(value: f64) -> Interval {
    Interval::point(value)
}

/// aᵖ
fn to(a: Interval, p: f64) -> Interval {
    power(a, p).0
}

/// Taylor coefficients of `operation` over `a`; `None` where it is none with derivatives, or is resolved otherwise.
pub(super) fn series(operation: Unary, a: Interval) -> Option<Series> {
    let of = |operation| unary(operation, a).0;
    let series = match operation {
        Unary::Negate | Unary::Abs | Unary::Sign => return None,
        Unary::Sin => alternating(of(Unary::Sin), of(Unary::Cos)),
        Unary::Cos => alternating(of(Unary::Cos), -of(Unary::Sin)),
        Unary::Tan => {
            // T′ = 1 + T², T″ = 2T(1 + T²), T‴ = 2(1 + T²)(1 + 3T²)
            let t = of(Unary::Tan);
            let slope = number(1.0) + t.square();
            let third = slope * (number(1.0) + 3.0 * t.square());
            [t, slope, t * slope, third * third_part()]
        }
        Unary::Asin => arcsine(a, of(Unary::Asin), 1.0),
        Unary::Acos => arcsine(a, of(Unary::Acos), -1.0),
        Unary::Atan => {
            // f′ = 1/q, f″/2 = −a/q², f‴/6 = (a² − ⅓)/q³ with q = 1 + a²
            let q = number(1.0) + a.square();
            let third = (a.square() - third_part()) * to(q, -3.0);
            [of(Unary::Atan), to(q, -1.0), -(a * to(q, -2.0)), third]
        }
        Unary::Sinh => growing(of(Unary::Sinh), of(Unary::Cosh)),
        Unary::Cosh => growing(of(Unary::Cosh), of(Unary::Sinh)),
        Unary::Tanh => {
            // T′ = S = 1/cosh², T″/2 = −TS, T‴/6 = −S(1 − 3T²)/3
            let (t, s) = (of(Unary::Tanh), to(of(Unary::Cosh), -2.0));
            let third = -(s * (third_part() - t.square()));
            [t, s, -(t * s), third]
        }
        Unary::Exp => growing(of(Unary::Exp), of(Unary::Exp)),
        Unary::Erf => bell(a, of(Unary::Erf), 1.0),
        Unary::Erfc => bell(a, of(Unary::Erfc), -1.0),
        Unary::Ln => [of(Unary::Ln), to(a, -1.0), -0.5 * to(a, -2.0), third_part() * to(a, -3.0)],
        Unary::Sqrt => {
            let [slope, second, third] = [1, 2, 3].map(|k| of_power(a, 0.5, k));
            [of(Unary::Sqrt), slope, second, third]
        }
    };
    Some(series)
}

/// ⅓ as an interval.
fn third_part() -> Interval {
    number(1.0).over(number(3.0))
}

/// f with f″ = −f, from f and f′.
fn alternating(f: Interval, slope: Interval) -> Series {
    [f, slope, -0.5 * f, -(slope * number(1.0).over(number(6.0)))]
}

/// f with f″ = f, from f and f′.
fn growing(f: Interval, slope: Interval) -> Series {
    [f, slope, 0.5 * f, slope * number(1.0).over(number(6.0))]
}

/// ±(1 − a²)^−½, ±½a (1 − a²)^−3/2, ±⅙(1 + 2a²)(1 − a²)^−5/2
fn arcsine(a: Interval, value: Interval, way: f64) -> Series {
    let q = (number(1.0) - a) * (number(1.0) + a);
    let third = (number(1.0) + 2.0 * a.square()) * to(q, -2.5) * number(1.0).over(number(6.0));
    [value, way * to(q, -0.5), 0.5 * way * (a * to(q, -1.5)), way * third]
}

/// ±g, ∓ag, ±⅓(2a² − 1)g with g = 2/√π exp(−a²)
fn bell(a: Interval, value: Interval, way: f64) -> Series {
    let slope = way * (two_by_root_pi() * unary(Unary::Exp, -a.square()).0);
    let third = (2.0 * a.square() - number(1.0)) * third_part();
    [value, slope, -(a * slope), third * slope]
}

/// 2/√π as an interval.
pub(super) fn two_by_root_pi() -> Interval {
    Interval { low: FRAC_2_SQRT_PI.next_down(), high: FRAC_2_SQRT_PI.next_up() }
}

/// The coefficient of degree k of aᵖ: a binomial times aᵖ⁻ᵏ.
pub(super) fn of_power(a: Interval, p: f64, k: i32) -> Interval {
    let exact = |k: f64| number(p) - number(k);
    let second = || 0.5 * (number(p) * exact(1.0));
    let binomial = match k {
        0 => return to(a, p),
        1 => number(p),
        2 => second(),
        _ => second() * exact(2.0) * third_part(),
    };
    binomial * to(a, p - f64::from(k))
}
