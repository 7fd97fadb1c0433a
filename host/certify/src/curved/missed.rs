//! The part of w that the points of the panels miss: the energy of v − ṽ, ṽ made from the polynomials through those points.
//!
//! The rule of 8 points is exact for squares of polynomials of degree 7, so the records are those of ṽ, and
//! ```text
//!   ‖A^½∇(s + v) − A^{−½}τ‖ ≤ ‖A^½∇(s + ṽ) − A^{−½}τ‖ + ‖A^½∇(v − ṽ)‖.
//! ```
//! The last norm is taken from points between: of smooth data it is rounding, of a kink up to 10⁻³ of ‖A^½∇v‖.

use super::POINTS;
use super::panels::Panels;
use crate::deviation::Deviation;
use crate::energy::Sample;
use signorini_problem::quadrature::gauss;
use signorini_scene::error::Result;

impl Panels {
    /// v − ṽ at points between those of the panels.
    pub(super) fn missed(&self, deviation: &Deviation) -> Result<Vec<Sample>> {
        let (rule, mut samples) = (gauss(POINTS), Vec::new());
        for panel in self.ends.windows(2) {
            let (start, width) = (panel[0], panel[1] - panel[0]);
            let known = rule.iter().map(|[t, _]| deviation.at(start + width * t));
            let known = known.collect::<Result<Vec<_>>>()?;
            for half in [0.0, 0.5] {
                for [t, weight] in &rule {
                    let t = half + 0.5 * t;
                    let [w, slope] = deviation.at(start + width * t)?;
                    let of = through(&rule, &known, t);
                    samples.push(Sample {
                        t: start + width * t,
                        weight: 0.5 * width * weight,
                        w: w - of[0],
                        slope: slope - of[1],
                    });
                }
            }
        }
        Ok(samples)
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
