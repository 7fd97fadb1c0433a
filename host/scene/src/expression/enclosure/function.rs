//! The range of each operation over intervals of its operands, and whether it is a number there.

use super::super::operation::{Binary, Unary, sign};
use super::interval::{Interval, is_exact_product};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Twice what rounding to the nearest does to 1.
pub(super) const ULP: f64 = f64::EPSILON;
/// The largest error of libm, and a unit more.
const LIBM: f64 = 4.0;
/// Beyond it the period of sines is not resolved.
const LARGE: f64 = 1e12;

/// A range, and whether every operand in the intervals has a value that is a number.
pub(super) type Range = (Interval, bool);

/// What underflow may hide of a result, which later factors may enlarge: nothing where an operand, and so the result, is 0.
pub(super) fn faded(is_zero: bool) -> f64 {
    if is_zero { 0.0 } else { f64::MIN_POSITIVE }
}

/// The values of `operation` on `a`.
pub(super) fn unary(operation: Unary, a: Interval) -> Range {
    let whole = |range: Interval| (range, a.is_finite());
    match operation {
        Unary::Negate => (-a, true),
        Unary::Sin => whole(cosine(a, FRAC_PI_2, f64::sin)),
        Unary::Cos => whole(cosine(a, 0.0, f64::cos)),
        Unary::Tan => whole(tangent(a)),
        Unary::Asin => within(a, -1.0, 1.0, |a| increasing(a, f64::asin)),
        Unary::Acos => within(a, -1.0, 1.0, |a| -increasing(a, |a| -a.acos())),
        Unary::Atan => (increasing(a, f64::atan), true),
        Unary::Sinh => (increasing(a, f64::sinh), true),
        Unary::Cosh => (increasing(a.abs(), f64::cosh).meet(from(1.0)), true),
        Unary::Tanh => (increasing(a, f64::tanh).meet(Interval::around(1.0)), true),
        Unary::Exp => (increasing(a, f64::exp).meet(from(0.0)), true),
        Unary::Erf => (increasing(a, libm::erf).meet(Interval::around(1.0)), true),
        Unary::Erfc => (complement(a), true),
        Unary::Ln => within(a, 0.0, f64::INFINITY, |a| increasing(a, f64::ln)),
        Unary::Sqrt => within(a, 0.0, f64::INFINITY, root),
        Unary::Abs => (a.abs(), true),
        Unary::Sign => (Interval { low: sign(a.low), high: sign(a.high) }, true),
    }
}

/// The values of `operation` on `a` and `b`.
pub(super) fn binary(operation: Binary, a: Interval, b: Interval) -> Range {
    let unbounded = |a: Interval| !a.is_finite();
    match operation {
        Binary::Add => (a + b, !opposed(a, b)),
        Binary::Subtract => (a - b, !opposed(a, -b)),
        Binary::Multiply => {
            let is_no_number = |a: Interval, b: Interval| a.holds(0.0) && unbounded(b);
            (a * b, !is_no_number(a, b) && !is_no_number(b, a))
        }
        Binary::Divide => {
            let zeros = a.holds(0.0) && b.holds(0.0);
            (a.over(b), !(zeros || unbounded(a) && unbounded(b)))
        }
        Binary::Power if b.low == b.high => power(a, b.low),
        Binary::Power => powers(a, b),
        Binary::Atan2 => (angle(a, b), true),
        Binary::Min => (Interval { low: a.low.min(b.low), high: a.high.min(b.high) }, true),
        Binary::Max => (Interval { low: a.low.max(b.low), high: a.high.max(b.high) }, true),
    }
}

/// Whether a sum of them may be ∞ − ∞.
fn opposed(a: Interval, b: Interval) -> bool {
    let meets = |a: Interval, b: Interval| a.high == f64::INFINITY && b.low == f64::NEG_INFINITY;
    meets(a, b) || meets(b, a)
}

fn from(low: f64) -> Interval {
    Interval { low, high: f64::INFINITY }
}

/// The range over the part of `a` between `least` and `most`, everything where there is no such part.
fn within(a: Interval, least: f64, most: f64, range: impl Fn(Interval) -> Interval) -> Range {
    let part = Interval { low: a.low.max(least), high: a.high.min(most) };
    let is_whole = part == a;
    (if part.low <= part.high { range(part) } else { Interval::ALL }, is_whole)
}

/// `value` of libm at `a`, moved by 4 ulp towards `way`; exact are the zeros at 0 and 1, and what is infinite.
fn widened(a: f64, value: f64, way: f64) -> f64 {
    let is_exact = value.is_infinite() || (value == 0.0 && (a == 0.0 || a == 1.0));
    if is_exact { value } else { value + way * (LIBM * ULP * value.abs()).max(f64::MIN_POSITIVE) }
}

/// The range of an increasing function of libm.
fn increasing(a: Interval, function: impl Fn(f64) -> f64) -> Interval {
    let low = function(a.low);
    let high = if a.high == a.low { low } else { function(a.high) };
    Interval::new(widened(a.low, low, -1.0), widened(a.high, high, 1.0))
}

/// erfc, which libm misses by 1.73 ε in 1.8 million numbers: one between two ends may lie beyond their values by twice the largest error,
/// for which three times the usual margin is kept.
fn complement(a: Interval) -> Interval {
    let ends = -increasing(a, |a| -libm::erfc(a));
    let again = Interval::point(1.0).widened(2.0 * LIBM * ULP);
    (ends * again).meet(Interval { low: 0.0, high: 2.0 })
}

/// √a for a ≥ 0, rounded correctly by every machine.
fn root(a: Interval) -> Interval {
    let [low, high] = [a.low.sqrt(), a.high.sqrt()];
    let is_exact = |root: f64, of: f64| root.is_infinite() || is_exact_product(root, root, of);
    let low = if is_exact(low, a.low) { low } else { low.next_down() };
    Interval::new(low, if is_exact(high, a.high) { high } else { high.next_up() })
}

/// The range of cos(a − peak), whose greatest values lie at peak + 2πk.
fn cosine(a: Interval, peak: f64, function: impl Fn(f64) -> f64) -> Interval {
    let whole = Interval::around(1.0);
    if a.size() > LARGE || a.width() >= TAU {
        return whole;
    }
    // Half turns from the peak: even ones are greatest, odd ones least values. In doubt there is one.
    let slack = 8.0 * ULP * (1.0 + a.size());
    let first = ((a.low - peak - slack) / PI).ceil();
    let last = ((a.high - peak + slack) / PI).floor();
    let ends = [(a.low, function(a.low)), (a.high, function(a.high))];
    let [low, high] = [-1.0, 1.0].map(|way| ends.map(|(a, value)| widened(a, value, way)));
    let has = |parity: f64| {
        let nearest = if first.rem_euclid(2.0) == parity { first } else { first + 1.0 };
        nearest <= last
    };
    let high = if has(0.0) { 1.0 } else { high[0].max(high[1]) };
    Interval::new(if has(1.0) { -1.0 } else { low[0].min(low[1]) }, high).meet(whole)
}

/// tan, everything where a pole may lie between.
fn tangent(a: Interval) -> Interval {
    let slack = 8.0 * ULP * (1.0 + a.size());
    let turns = |a: f64| ((a - FRAC_PI_2) / PI).floor();
    let is_between = turns(a.low - slack) == turns(a.high + slack);
    if a.size() < LARGE && a.width() < PI && is_between {
        increasing(a, f64::tan)
    } else {
        Interval::ALL
    }
}

/// aᵖ: for a < 0 only if p is an integer.
pub(super) fn power(a: Interval, p: f64) -> Range {
    let is_integer = p.fract() == 0.0;
    if p == 0.0 {
        return (Interval::point(1.0), true);
    }
    if p == 1.0 {
        return (a, true);
    }
    if p == 2.0 {
        return (a.square(), true);
    }
    if !is_integer {
        return within(a, 0.0, f64::INFINITY, |a| of_positive(a, p));
    }
    if p % 2.0 == 0.0 {
        return (of_positive(a.abs(), p), true);
    }
    let range = match (a.low < 0.0, a.high > 0.0) {
        (false, _) => of_positive(a, p),
        (true, false) => -of_positive(-a, p),
        (true, true) if p < 0.0 => Interval::ALL,
        (true, true) => {
            let side = |end: f64| of_positive(Interval { low: 0.0, high: end }, p).high;
            Interval { low: -side(-a.low), high: side(a.high) }
        }
    };
    (range, true)
}

/// aᵖ for a ≥ 0.
fn of_positive(a: Interval, p: f64) -> Interval {
    let at = |a: f64| {
        // A zero below the axis is none.
        let value = (a + 0.0).powf(p);
        let is_exact = a == 0.0 || a == 1.0 || a.is_infinite();
        [-1.0, 1.0].map(|way| if is_exact { value } else { widened(a, value, way).max(0.0) })
    };
    let low = at(a.low);
    let ends = [low, if a.high == a.low { low } else { at(a.high) }];
    let [least, most] = if p > 0.0 { ends } else { [ends[1], ends[0]] };
    Interval::new(least[0], most[1])
}

/// a to powers that vary: the ends of each are enough for a ≥ 0; for a < 0 the values at integers are no range.
fn powers(a: Interval, b: Interval) -> Range {
    if a.low < 0.0 {
        return (Interval::ALL, false);
    }
    let [least, most] = [b.low, b.high].map(|p| of_positive(a, p));
    let one = if b.holds(0.0) { Interval::point(1.0) } else { least };
    (least.join(most).join(one), true)
}

/// The angle of the points (b, a), all angles where they cross the cut.
fn angle(a: Interval, b: Interval) -> Interval {
    if a.low < 0.0 && a.high > 0.0 && b.low < 0.0 {
        return Interval::around(widened(PI, PI, 1.0));
    }
    // Below the cut the angle tends to −π. Off the cut it is monotonic in each coordinate, so greatest and least in corners.
    let top = if a.low < 0.0 && a.high == 0.0 { -0.0 } else { a.high };
    let corners = [[a.low, b.low], [a.low, b.high], [top, b.low], [top, b.high]];
    let hull = Interval::hull(&corners.map(|[a, b]| a.atan2(b + 0.0)));
    Interval::new(widened(a.low, hull.low, -1.0), widened(a.low, hull.high, 1.0))
}
