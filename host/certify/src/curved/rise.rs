//! The rise of w along parts of an edge, and as points find it in w′.

use super::POINTS;
use crate::deviation::Deviation;
use signorini_problem::quadrature::gauss;
use signorini_scene::error::Result;

/// Widths of a panel within which a singular place is beside it.
const NEAR: f64 = 2.0;

/// Parts of a panel that tell more closely what its points miss.
const PARTS: u32 = 8;

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
        for [t, weight] in &self.rule {
            rest -= (b - a) * weight * self.deviation.at(a + (b - a) * t)?[1];
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

    /// ∫(w − w̃)² and ∫(w′ − w̃′)² over a panel: proved, but right beside singular places, where nothing is, by points in between.
    pub(super) fn between(
        &self,
        panel @ [a, b]: [f64; 2],
        singular: &[[f64; 2]],
        enough: f64,
    ) -> Result<[f64; 2]> {
        let proved = self.deviation.missed(panel);
        let near = NEAR * (b - a);
        let is_beside = |&[low, high]: &[f64; 2]| low - near < b && a < high + near;
        match proved[0] + proved[1] > enough && singular.iter().any(is_beside) {
            true => self.on_parts(panel, 2, |_| [0.0; 2]),
            false => Ok(proved),
        }
    }

    /// The same more closely, where it is more than enough: on parts by their own points and by what is proved of these.
    pub(super) fn closely(
        &self,
        panel: [f64; 2],
        singular: &[[f64; 2]],
        enough: f64,
    ) -> Result<[f64; 2]> {
        let whole = self.between(panel, singular, 0.0)?;
        if whole[0] + whole[1] <= enough {
            return Ok(whole);
        }
        let parts = self.on_parts(panel, PARTS, |part| self.deviation.missed(part))?;
        Ok([0, 1].map(|k| whole[k].min(parts[k])))
    }

    /// ∫(w − w̃)² and ∫(w′ − w̃′)² on parts of a panel, by their points and by what these miss.
    fn on_parts(
        &self,
        [a, b]: [f64; 2],
        parts: u32,
        missed: impl Fn([f64; 2]) -> [f64; 2],
    ) -> Result<[f64; 2]> {
        let (width, share) = (b - a, 1.0 / f64::from(parts));
        let known = self.rule.iter().map(|[t, _]| self.deviation.at(a + width * t));
        let known = known.collect::<Result<Vec<_>>>()?;
        let mut sum = [0.0; 2];
        for part in 0..parts {
            let from = share * f64::from(part);
            let mut seen = [0.0; 2];
            for &[t, weight] in &self.rule {
                let t = from + share * t;
                let (of, at) = (through(&self.rule, &known, t), self.deviation.at(a + width * t)?);
                seen = [0, 1].map(|k| seen[k] + share * width * weight * (at[k] - of[k]).powi(2));
            }
            let missed = missed([from, from + share].map(|t| a + width * t));
            sum = [0, 1].map(|k| sum[k] + (seen[k].sqrt() + missed[k].sqrt()).powi(2));
        }
        Ok(sum)
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

/// The polynomials through w and w′ at the points of `rule`, at t (Lagrange).
fn through(rule: &[[f64; 2]], known: &[[f64; 2]], t: f64) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for (at, ([own, _], values)) in rule.iter().zip(known).enumerate() {
        let others = rule.iter().enumerate().filter(|(other, _)| *other != at);
        let factor: f64 = others.map(|(_, [other, _])| (t - other) / (own - other)).product();
        sum = [0, 1].map(|k| sum[k] + factor * values[k]);
    }
    sum
}
