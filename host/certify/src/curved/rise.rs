//! The rise of w along parts of an edge, and as points find it in w′.

use super::POINTS;
use crate::between::{Part, on_part, through};
use crate::deviation::Deviation;
use signorini_problem::quadrature::gauss;
use signorini_scene::error::Result;

/// w along an edge, and the rule of a panel.
pub(super) struct Rise<'a, 's> {
    pub(super) deviation: &'a Deviation<'s>,
    rule: Vec<[f64; 2]>,
}

impl<'a, 's> Rise<'a, 's> {
    pub(super) fn of(deviation: &'a Deviation<'s>) -> Self {
        Self { deviation, rule: gauss(POINTS) }
    }

    /// ∫w′² by a rule.
    pub(super) fn energy(&self, rule: &[[f64; 2]]) -> Result<f64> {
        rule.iter()
            .try_fold(0.0, |sum, &[t, weight]| Ok(sum + weight * self.deviation.at(t)?[1].powi(2)))
    }

    /// |∫ₐᵇ w′ dt − (w(b) − w(a))|; NaN, which tells nothing, where a single point is singular.
    pub(super) fn missing(&self, [a, b]: [f64; 2]) -> Result<f64> {
        let mut rest = self.deviation.value(b) - self.deviation.value(a);
        for [t, weight] in on_part([a, b], &self.rule) {
            rest -= weight * self.deviation.at(t)?[1];
        }
        Ok(rest.abs())
    }

    /// Whether the rise of a panel and of both of its halves is found but for so much.
    pub(super) fn is_found(&self, panel @ [a, b]: [f64; 2], tolerance: f64) -> Result<bool> {
        let middle = 0.5 * (a + b);
        for part in [panel, [a, middle], [middle, b]] {
            if self.missing(part)? > tolerance {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// ∫(w − w̃)² and ∫(w′ − w̃′)² over a panel at most, without the parts of the edge in which w is singular: by the points of the others,
    /// and by what these miss.
    pub(super) fn between(&self, [a, b]: [f64; 2]) -> Result<[f64; 2]> {
        let width = b - a;
        let known = self.rule.iter().map(|[t, _]| self.deviation.at(a + width * t));
        let known = known.collect::<Result<Vec<_>>>()?;
        let mut sum = [0.0; 2];
        for part in self.parts_in([a, b]).filter(|part| !part.is_singular()) {
            let [from, to] = part.range;
            if width <= to - from {
                return Ok(part.missed.map(|missed| missed * (width / (to - from))));
            }
            let mut seen = [0.0; 2];
            for [t, weight] in on_part(part.range, &self.rule) {
                let (of, at) =
                    (through(&self.rule, &known, (t - a) / width), self.deviation.at(t)?);
                seen = [0, 1].map(|k| seen[k] + weight * (at[k] - of[k]).powi(2));
            }
            sum = [0, 1].map(|k| sum[k] + (seen[k].sqrt() + part.missed[k].sqrt()).powi(2));
        }
        Ok(sum)
    }

    /// Whether w is singular in a part of a panel.
    pub(super) fn is_singular(&self, panel: [f64; 2]) -> bool {
        self.parts_in(panel).any(Part::is_singular)
    }

    fn parts_in(&self, [a, b]: [f64; 2]) -> impl Iterator<Item = &Part> {
        self.deviation.parts().iter().filter(move |part| part.range[0] < b && a < part.range[1])
    }

    /// Whether w jumps between a and b: what is missing there is more than rounding, and the same in wider parts on either side. That of
    /// a function of finite energy grows at least like the root of the width, where it has a sign at all.
    pub(super) fn jumps(&self, [a, b]: [f64; 2]) -> Result<bool> {
        const WIDER: [f64; 3] = [2.0, 5.0, 11.0];
        let narrow = self.missing([a, b])?;
        let rounding = self.deviation.rounding_at(a) + self.deviation.rounding_at(b);
        let mut jumps = narrow > rounding;
        for reach in WIDER.map(|wider| wider * (b - a)) {
            for wide in [[(a - reach).max(0.0), b], [a, (b + reach).min(1.0)]] {
                let missing = self.missing(wide)?;
                jumps &= (missing - narrow).abs() <= 0.3 * narrow;
            }
        }
        Ok(jumps)
    }
}
