//! ∫(f − m)² over parts where f is enclosed.

use signorini_problem::Sum;
use signorini_scene::expression::enclosure::{Form, Interval, Region};

/// ∫(f − m)² over a part, and what is missed of it.
pub fn square(f: &Sum, part: &Region, mean: &Form) -> [f64; 2] {
    let form = f.enclose(part);
    match form.range().is_finite() {
        true => part.square(&form.combined(1.0, mean, -1.0)),
        false => unbounded(f, part, mean.range()),
    }
}

/// ∫(f − m)² = ∫f² − 2m∫f + m²|T| over a part where f is not bounded, as it grows, for any m in `mean`.
fn unbounded(f: &Sum, part: &Region, mean: Interval) -> [f64; 2] {
    let Some(growth) = f.growth(part) else { return [0.0, f64::INFINITY] };
    let [integral, square] = [1.0, 2.0].map(|k| part.grown(&growth, k));
    if !square.high.is_finite() {
        return [0.0, f64::INFINITY];
    }
    let signed =
        if growth.sign == 0.0 { Interval::around(integral.high) } else { growth.sign * integral };
    let rest = mean.square() * Interval::point(part.measure()) - 2.0 * (mean * signed);
    let whole = square + rest;
    [whole.middle().max(0.0), 0.5 * whole.width()]
}
