//! Panels along an edge as fine as its data need, with 8 Gauss points each.
//!
//! A panel is fine enough where its points find in w′ by how much w rises, on all of it and on both of its halves,
//! ```text
//!   |∫ₐᵇ w′ dt − (w(b) − w(a))| ≤ 10⁻⁹ (∫₀¹ w′² dt)^½,
//! ```
//! and where what they miss of w and w′ between them is proved to be less than 10⁻⁴ of the same (`between`). Other panels are bisected,
//! level by level. Where w is singular nothing is proved: `singular` judges these places.
//!
//! Their points miss the energy of v − ṽ all the same, ṽ made from the polynomials through those points: the rule of 8 points is
//! exact for squares of polynomials of degree 7, so the records are those of ṽ, and
//! ```text
//!   ‖A^½∇(s + v) − A^{−½}τ‖ ≤ ‖A^½∇(s + ṽ) − A^{−½}τ‖ + ‖A^½∇(v − ṽ)‖.
//! ```

use super::POINTS;
use super::rise::Rise;
use super::singular::{Rough, beyond};
pub use crate::between::PANELS;
use crate::between::on_part;
use crate::deviation::Deviation;
use signorini_problem::quadrature::gauss;
use signorini_scene::error::Result;

/// Panels in which w is singular, or its rise is not found, are no shorter than that, and no others than the second.
const SHORT: f64 = 1.0 / (1_u64 << 26) as f64;
const SHORTEST: f64 = 1.0 / (1_u64 << 50) as f64;
/// Most panels: data that are rough everywhere are integrated by as many, and no finer.
const MOST: usize = 128;
/// Largest part of a rise that may be missing.
const MISSING: f64 = 1e-9;
/// Part of (∫w′²)^½ that may be missed between the points of a panel.
const BETWEEN: f64 = 1e-4;

/// A subdivision of \[0, 1\] along an edge.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Panels {
    /// The ends of the panels, ascending from 0 to 1.
    pub(super) ends: Vec<f64>,
    /// Where w is rougher than any function of finite energy.
    pub(super) rough: Option<Rough>,
    /// ∫(w − w̃)² and ∫(w′ − w̃′)² at most; nearer to singular places than all panels all of ∫w′².
    pub(super) missed: [f64; 2],
}

impl Panels {
    /// The panels that smooth data have.
    pub(super) fn regular() -> Self {
        let ends = (0..=PANELS).map(|end| f64::from(end) / f64::from(PANELS)).collect();
        Self { ends, rough: None, missed: [0.0; 2] }
    }

    /// Panels as fine as w needs.
    ///
    /// # Errors
    /// Data that are not finite.
    pub(super) fn along(deviation: &Deviation) -> Result<Self> {
        let (mut panels, rise) = (Self::regular(), Rise::of(deviation));
        // First what is singular: other panels leave no room for it.
        panels.bisect(&rise, |_, panel| Ok(rise.is_singular(panel) && width(panel) > SHORT))?;
        let rounding = deviation.rounding();
        panels.bisect(&rise, |size, panel| {
            let [tolerance, enough] = [MISSING, BETWEEN].map(|part| (part * size).max(rounding));
            let [w, slope] = rise.between(panel)?;
            let misses = w + slope > enough * enough && width(panel) > SHORTEST;
            Ok(misses || width(panel) > SHORT && !rise.is_found(panel, tolerance)?)
        })?;
        for panel in panels.all() {
            let missed = rise.between(panel)?;
            panels.missed = [0, 1].map(|k| panels.missed[k] + missed[k]);
        }
        match beyond(&rise)? {
            Ok(energy) => panels.missed[1] += energy,
            Err(rough) => panels.rough = Some(rough),
        }
        Ok(panels)
    }

    /// Bisects the panels that are too coarse for this (∫w′²)^½, level by level, as long as there is room for all of a level.
    fn bisect(
        &mut self,
        rise: &Rise,
        is_coarse: impl Fn(f64, [f64; 2]) -> Result<bool>,
    ) -> Result<()> {
        let mut open = self.all();
        while !open.is_empty() {
            let (size, mut coarse) = (rise.energy(&self.rule())?.sqrt(), Vec::new());
            for panel in open {
                if is_coarse(size, panel)? {
                    coarse.push(panel);
                }
            }
            if self.ends.len() + coarse.len() > MOST {
                break;
            }
            open = coarse.iter().flat_map(halves).collect();
            *self = self.clone().with(&coarse.iter().map(middle).collect::<Vec<_>>());
        }
        Ok(())
    }

    fn all(&self) -> Vec<[f64; 2]> {
        self.ends.windows(2).map(|ends| [ends[0], ends[1]]).collect()
    }

    /// Whether smooth data would have the same.
    pub(super) fn is_regular(&self) -> bool {
        self.ends.len() == PANELS as usize + 1
    }

    /// Gauss points on all panels.
    pub(super) fn rule(&self) -> Vec<[f64; 2]> {
        let rule = gauss(POINTS);
        self.all().into_iter().flat_map(|panel| on_part(panel, &rule)).collect()
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
        let middles: Vec<f64> = self.all().iter().map(middle).collect();
        self.with(&middles)
    }

    /// With the ends of others added.
    pub(super) fn with(mut self, others: &[f64]) -> Self {
        self.ends.extend(others);
        self.ends.sort_by(f64::total_cmp);
        self.ends.dedup();
        self
    }
}

/// Corrections that make samples of w and w′ those of one function: ∫w′ = 0, for w is 0 at both ends, and ∫w = −∫t w′. Both are
/// small differences of data, each rounded on its own, and their products with the fluxes of s and τ nearly cancel.
///
/// The records are those of a field g in the place of ∇v, and ∫g·τ = w̄ (τ_E + κ∫f) holds for the mended one alone. That of the
/// samples themselves would be off by a difference of large terms where a value at an end is, by 10⁻¹⁶ say, that of another
/// branch of the data. What mending changes is added to the bound, by the triangle inequality, unless it is rounding of w;
/// what panels may miss of a kink stays.
pub(super) struct Mended {
    /// Corrections of w and w′ at all points.
    pub(super) change: [f64; 2],
    /// Whether the bound has it added: it is more than rounding, and than panels may miss.
    pub(super) is_counted: bool,
}

impl Mended {
    pub(super) fn new(deviation: &Deviation, panels: &Panels) -> Result<Self> {
        let (mut mean, mut rise, mut lever, mut energy) = (0.0, 0.0, 0.0, 0.0);
        for [t, weight] in panels.rule() {
            let [w, slope] = deviation.at(t)?;
            energy += weight * slope * slope;
            mean += weight * w;
            rise += weight * slope;
            lever += weight * t * slope;
        }
        let change: [f64; 2] = [0.5 * rise - lever - mean, -rise];
        let is_below = |most: f64| change.iter().all(|change| change.abs() <= most);
        let is_rounding = is_below(deviation.rounding());
        // Each panel may miss so much.
        let is_resolved =
            !is_rounding && is_below(MISSING * energy.sqrt() * panels.ends.len() as f64);
        let change = if is_resolved { [0.0; 2] } else { change };
        Ok(Self { change, is_counted: !is_rounding && !is_resolved })
    }
}

fn width([a, b]: [f64; 2]) -> f64 {
    b - a
}

fn middle([a, b]: &[f64; 2]) -> f64 {
    0.5 * (a + b)
}

fn halves(panel @ [a, b]: &[f64; 2]) -> [[f64; 2]; 2] {
    [[*a, middle(panel)], [middle(panel), *b]]
}
