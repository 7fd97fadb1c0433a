//! Panels along an edge as fine as its data need, with 8 Gauss points each.
//!
//! A panel is fine enough where its points find in w′ by how much w rises,
//! ```text
//!   |∫ₐᵇ w′ dt − (w(b) − w(a))| ≤ 10⁻⁹ (∫₀¹ w′² dt)^½,
//! ```
//! on all of it and on both of its halves: what they miss of a kink or of a layer, however thin it is, is missing
//! in the integral. Other panels are bisected, level by level. Where a rise is still missing that no energy explains, w jumps, or
//! has a kink right beside a vertex: they are bisected on, as far as coordinates tell places apart. A kink is found then.
//!
//! Their points miss the energy of v − ṽ all the same, ṽ made from the polynomials through those points: the rule of 8 points is
//! exact for squares of polynomials of degree 7, so the records are those of ṽ, and
//! ```text
//!   ‖A^½∇(s + v) − A^{−½}τ‖ ≤ ‖A^½∇(s + ṽ) − A^{−½}τ‖ + ‖A^½∇(v − ṽ)‖.
//! ```
//! The last norm is taken from points between: of smooth data it is rounding, of a kink up to 10⁻³ of ‖A^½∇v‖.

use super::POINTS;
use super::singular::{Rough, beyond};
use crate::deviation::Deviation;
use crate::energy::Sample;
use signorini_problem::quadrature::gauss;
use signorini_scene::error::Result;

/// Panels to begin with: smooth data need no more.
pub const PANELS: u32 = 4;
/// Most bisections of a panel: a layer of 10⁻⁶ of the edge is then a few panels wide.
const LEVELS: u32 = 24;
/// Most bisections where else w would jump: panels are about an ulp of the coordinates wide.
const FINEST: u32 = 24;
/// Most panels: data that are rough everywhere are integrated by as many, and no finer.
const MOST: usize = 128;
/// Largest part of a rise that may be missing.
pub(super) const MISSING: f64 = 1e-9;

/// A subdivision of \[0, 1\] along an edge.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Panels {
    /// The ends of the panels, ascending from 0 to 1.
    pub(super) ends: Vec<f64>,
    /// Where w is rougher than any function of finite energy.
    pub(super) rough: Option<Rough>,
    /// ∫w′² nearer to singular places than all panels.
    pub(super) beyond: f64,
}

impl Panels {
    /// The panels that smooth data have.
    pub(super) fn regular() -> Self {
        let ends = (0..=PANELS).map(|end| f64::from(end) / f64::from(PANELS)).collect();
        Self { ends, rough: None, beyond: 0.0 }
    }

    /// Panels as fine as w needs.
    ///
    /// # Errors
    /// Data that are not finite.
    pub(super) fn along(deviation: &Deviation) -> Result<Self> {
        let regular = Self::regular();
        let (mut energy, rise) = (0.0, Rise { deviation, rule: gauss(POINTS) });
        for [t, weight] in regular.rule() {
            energy += weight * deviation.at(t)?[1].powi(2);
        }
        let tolerance = (MISSING * energy.sqrt()).max(deviation.rounding());
        let mut open: Vec<[f64; 2]> =
            regular.ends.windows(2).map(|ends| [ends[0], ends[1]]).collect();
        let mut ends = regular.ends;
        rise.bisect(&mut ends, &mut open, |_| tolerance, LEVELS)?;
        let found = Self::judged(&rise, ends.clone(), &open)?;
        let Some(Rough::Jump(_)) = found.rough else { return Ok(found) };
        let explained = |panel| tolerance.max(rise.explained(panel));
        rise.bisect(&mut ends, &mut open, explained, FINEST)?;
        let finer = Self::judged(&rise, ends, &open)?;
        Ok(if finer.rough.is_none() { finer } else { found })
    }

    /// Panels with these ends, in some of which the rise of w is not found yet.
    fn judged(rise: &Rise, mut ends: Vec<f64>, open: &[[f64; 2]]) -> Result<Self> {
        ends.sort_by(f64::total_cmp);
        let mut found = Self { ends, rough: None, beyond: 0.0 };
        match beyond(rise.deviation, open)? {
            Ok(energy) => found.beyond = energy,
            Err(steep) => found.rough = Some(steep),
        }
        if found.rough.is_none() {
            found.rough = rise.jumps(open, &found.rule())?.map(Rough::Jump);
        }
        Ok(found)
    }

    /// Whether smooth data would have the same.
    pub(super) fn is_regular(&self) -> bool {
        self.ends.len() == PANELS as usize + 1
    }

    /// Gauss points on all panels.
    pub(super) fn rule(&self) -> Vec<[f64; 2]> {
        let rule = gauss(POINTS);
        let panels = self.ends.windows(2).map(|ends| [ends[0], ends[1] - ends[0]]);
        let points = |[start, width]: [f64; 2]| {
            rule.iter().map(move |[t, weight]| [start + width * t, width * weight])
        };
        panels.flat_map(points).collect()
    }

    /// These panels seen from the edge's other end.
    pub(super) fn reversed(&self) -> Self {
        Self { ends: self.ends.iter().rev().map(|end| 1.0 - end).collect(), ..*self }
    }

    /// With their middles added, unless they are many: data that are rough everywhere gain nothing.
    pub(super) fn halved(self) -> Self {
        if self.ends.len() > MOST / 2 {
            return self;
        }
        let middles: Vec<f64> =
            self.ends.windows(2).map(|ends| 0.5 * (ends[0] + ends[1])).collect();
        self.with(&middles)
    }

    /// With the ends of others added.
    pub(super) fn with(mut self, others: &[f64]) -> Self {
        self.ends.extend(others);
        self.ends.sort_by(f64::total_cmp);
        self.ends.dedup();
        self
    }

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

fn middle([a, b]: &[f64; 2]) -> f64 {
    0.5 * (a + b)
}

fn halves(panel @ [a, b]: &[f64; 2]) -> [[f64; 2]; 2] {
    [[*a, middle(panel)], [middle(panel), *b]]
}

/// The rise of w as the points of a panel find it.
struct Rise<'a, 's> {
    deviation: &'a Deviation<'s>,
    rule: Vec<[f64; 2]>,
}

impl Rise<'_, '_> {
    /// |∫ₐᵇ w′ dt − (w(b) − w(a))|; NaN, which tells nothing, where a single point is singular.
    fn missing(&self, [a, b]: [f64; 2]) -> Result<f64> {
        let mut rest = self.deviation.value(b) - self.deviation.value(a);
        for [t, weight] in &self.rule {
            rest -= (b - a) * weight * self.deviation.at(a + (b - a) * t)?[1];
        }
        Ok(rest.abs())
    }

    /// Bisects the `open` panels in which the rise is not found, up to so many times; their middles are new `ends`.
    fn bisect(
        &self,
        ends: &mut Vec<f64>,
        open: &mut Vec<[f64; 2]>,
        tolerance: impl Fn([f64; 2]) -> f64,
        levels: u32,
    ) -> Result<()> {
        for _ in 0..levels {
            let mut coarse = Vec::new();
            for &panel in open.iter() {
                if !self.is_found(panel, tolerance(panel))? {
                    coarse.push(panel);
                }
            }
            *open = coarse;
            if open.is_empty() || ends.len() + open.len() > MOST {
                break;
            }
            ends.extend(open.iter().map(middle));
            *open = open.iter().flat_map(halves).collect();
        }
        Ok(())
    }

    /// The part of the rise on a panel that rounding explains.
    fn explained(&self, [a, b]: [f64; 2]) -> f64 {
        self.deviation.rounding_at(a) + self.deviation.rounding_at(b)
    }

    fn is_found(&self, panel: [f64; 2], tolerance: f64) -> Result<bool> {
        let [left, right] = halves(&panel);
        for part in [panel, left, right] {
            if self.missing(part)? > tolerance {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Tells whether the rise missing on a panel would need more than the energy found by `rule` on all of them.
    fn jumps(&self, panels: &[[f64; 2]], rule: &[[f64; 2]]) -> Result<Option<f64>> {
        let mut energy = 0.0;
        for &[t, weight] in rule {
            energy += weight * self.deviation.at(t)?[1].powi(2);
        }
        for &panel in panels {
            if self.missing(panel)?.powi(2) > (panel[1] - panel[0]) * energy {
                return Ok(Some(middle(&panel)));
            }
        }
        Ok(None)
    }
}
