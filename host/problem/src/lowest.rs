//! The least value of data along an edge whatever inputs are in their ranges, enclosed: a narrow dip between points is found, or
//! proved to be none.
//!
//! ```text
//!   min Σ_j p_j d_j(x) = Σ_j min(a_j d_j(x), b_j d_j(x)),   a_j ≤ p_j ≤ b_j
//!   bound(part) ≤ value(x) for all x in a part:   the part with the least bound is halved until that is near enough
//! ```

use signorini_scene::expression::enclosure::{Interval, Region};

use super::{Problem, Sum};

/// Parts of an edge, at most.
const MOST: usize = 256;
/// Part of a size that rounding may be.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A term p (d⁺ − d⁻) of a sum.
pub(super) struct Ranged<'s> {
    /// d⁺, where it is not 0.
    pub plus: Option<Sum<'s>>,
    /// d⁻, where it is not 0.
    pub minus: Option<Sum<'s>>,
    /// The least and the largest p.
    pub factor: [f64; 2],
}

impl<'s> Ranged<'s> {
    /// p d
    pub fn of(data: Sum<'s>, factor: [f64; 2]) -> Self {
        Self { plus: Some(data), minus: None, factor }
    }

    /// Both data that there are.
    pub fn data(&self) -> impl Iterator<Item = &Sum<'s>> {
        self.plus.iter().chain(&self.minus)
    }

    /// d at a point.
    pub fn at(&self, [x, y]: [f64; 2]) -> f64 {
        let value = |of: &Option<Sum>| of.as_ref().map_or(0.0, |of| of.at(x, y));
        value(&self.plus) - value(&self.minus)
    }

    /// All values of d in a region.
    pub fn within(&self, region: &Region) -> Interval {
        match [&self.plus, &self.minus].map(|of| of.as_ref().map(|of| of.enclose(region))) {
            [Some(plus), Some(minus)] => plus.combined(1.0, &minus, -1.0).range(),
            [Some(plus), None] => plus.range(),
            [None, Some(minus)] => minus.scaled(-1.0).range(),
            [None, None] => Interval::point(0.0),
        }
    }

    /// The least p d for d in an interval.
    pub fn least(&self, d: Interval) -> f64 {
        let times = |p: f64, d: f64| if d == 0.0 || p == 0.0 { 0.0 } else { p * d };
        let [a, b] = self.factor;
        times(a, d.low).min(times(a, d.high)).min(times(b, d.low)).min(times(b, d.high))
    }

    /// The least p d at a point.
    pub fn least_at(&self, at: [f64; 2]) -> f64 {
        self.least(Interval::point(self.at(at)))
    }

    /// The size of its terms at a point.
    pub fn size_at(&self, [x, y]: [f64; 2]) -> f64 {
        let most = self.factor[0].abs().max(self.factor[1].abs());
        most * self.data().map(|of| of.terms_at(x, y)).sum::<f64>()
    }
}

impl Problem {
    /// The points of an edge at which a sum that is to be nowhere below 0 is looked at: those of the rule, and where it is lowest.
    pub(super) fn looks(
        &self,
        edge: usize,
        terms: &[Ranged],
    ) -> impl Iterator<Item = [f64; 2]> + use<'_> {
        let size = terms.iter().map(|of| of.size_at(self.along(edge, 0.5))).sum::<f64>();
        let found = self.lowest_sum(edge, terms, |value, bound| {
            bound >= -ROUNDING * size || value < -ROUNDING * size
        });
        self.rule_points(edge).chain([found.at])
    }

    /// The least value of a sum along an edge, see [`lowest`].
    pub(super) fn lowest_sum(
        &self,
        edge: usize,
        terms: &[Ranged],
        is_enough: impl Fn(f64, f64) -> bool,
    ) -> Lowest {
        let value = |at: [f64; 2]| terms.iter().map(|of| of.least_at(at)).sum();
        let bound = |part: &Region| terms.iter().map(|of| of.least(of.within(part))).sum();
        lowest(self.segment(edge), value, bound, is_enough)
    }
}

/// A least value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Lowest {
    /// A point where data are least, of those that were looked at.
    pub at: [f64; 2],
    /// Their value there.
    pub value: f64,
    /// No value along the edge is less.
    pub bound: f64,
}

/// Looks for the least value along a segment, first at its middle, until `is_enough` of the value and the bound.
pub(super) fn lowest(
    segment: [[f64; 2]; 2],
    value: impl Fn([f64; 2]) -> f64,
    bound: impl Fn(&Region) -> f64,
    is_enough: impl Fn(f64, f64) -> bool,
) -> Lowest {
    // What is not a number is not bounded.
    let bounded = |part: Region| match bound(&part) {
        bound if bound.is_nan() => (f64::NEG_INFINITY, part),
        bound => (bound, part),
    };
    let whole = Region::segment(segment);
    let mut found = Lowest { at: whole.centre(), value: value(whole.centre()), bound: 0.0 };
    let mut parts = vec![bounded(whole)];
    loop {
        let order = |a: &(f64, Region), b: &(f64, Region)| {
            a.0.total_cmp(&b.0).then_with(|| b.1.measure().total_cmp(&a.1.measure()))
        };
        let Some((worst, part)) = parts.iter().copied().min_by(order) else { return found };
        found.bound = worst;
        if is_enough(found.value, worst) || parts.len() >= MOST || part.is_tiny() {
            return found;
        }
        parts.retain(|of| of.1 != part);
        for half in part.parts() {
            let at = half.centre();
            let here = value(at);
            if here < found.value {
                (found.at, found.value) = (at, here);
            }
            parts.push(bounded(half));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_scene::expression::{Expression, Variables};

    fn of(text: &str, enough: f64) -> Lowest {
        let expression = Expression::parse(text, Variables::Space).expect("an expression");
        lowest(
            [[0.0, 0.0], [1.0, 0.0]],
            |[x, y]| expression.eval(x, y, 0.0),
            |part| expression.enclose(part, 0.0).range().low,
            |value, bound| value - bound <= enough,
        )
    }

    #[test]
    fn a_dip_of_a_millionth_is_found() {
        let found = of("1 - 3*exp(-((x - 0.437)/1e-6)^2)", 1e-3);
        assert!((found.value + 2.0).abs() < 1e-3 && found.value - found.bound <= 1e-3, "{found:?}");
        assert!((found.at[0] - 0.437).abs() < 1e-6, "{found:?}");
    }
}
