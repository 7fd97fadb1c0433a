//! Where the solution of a condensed problem lies, entry by entry, for all loads of a box.
//!
//! With S = N + P as in [`Split`] and b_lo ≤ b ≤ b_hi, from lo = 0
//! ```text
//!   hi = LCP(N, b_hi − P lo),    lo = LCP(N, b_lo − P hi)          0 ≤ lo ≤ x ≤ hi at every step,
//! ```
//! since x solves the problem with matrix N and load b − Px. One step is all where P = 0, and exact at corners.

use super::interval::Interval;
use super::split::{Split, product};
use crate::CondensedModel;
use signorini_reference::ReferenceError;

/// Steps at most: each is an enclosure, and later ones gain little.
const STEPS: u32 = 16;
/// An enclosure that shrinks by less than this part of its size in a step is taken.
const GAIN: f64 = 1e-3;

/// lo ≤ x ≤ hi for every load of a box.
#[derive(Debug, Clone, PartialEq)]
pub struct Enclosure {
    /// Not negative without limits.
    pub lo: Vec<f64>,
    /// Not below `lo`.
    pub hi: Vec<f64>,
    /// At most Sx − b, for the edges of which it is positive; with limits at most the way from it to either end.
    pub reaction: Vec<f64>,
}

/// Intervals of the loads of both sides of every edge: b and the lower end of Sx − b, b and the upper one.
#[derive(Debug, Clone, PartialEq)]
pub struct EndBox {
    /// Where x > 0; −∞ where there is no such side.
    pub least: LoadBox,
    /// Where x < 0; ∞ where there is no such side.
    pub greatest: LoadBox,
}

impl EndBox {
    /// Enclosure of the solutions of `model` for p in `ranges`. An input has one value in a load and in the end of its side.
    pub fn new(model: &CondensedModel, ranges: &[[f64; 2]]) -> Self {
        let ends: Vec<_> = (0..model.contact).map(|at| model.end_columns(at)).collect();
        let side = |side: usize, infinite: f64| {
            let entry = |j: usize, at: usize| {
                let end = ends[at][side][j];
                if end.is_finite() { model.load[j][at] + end } else { 0.0 }
            };
            let column = |j: usize| (0..model.contact).map(|at| entry(j, at)).collect();
            let columns: Vec<Vec<f64>> = (0..model.inputs).map(column).collect();
            let mut loads = LoadBox::new(&columns, ranges, model.contact);
            for (at, end) in ends.iter().enumerate() {
                if end[side][0].is_infinite() {
                    (loads.lo[at], loads.hi[at]) = (infinite, infinite);
                }
            }
            loads
        };
        let mut of = Self { least: side(0, f64::NEG_INFINITY), greatest: side(1, f64::INFINITY) };
        // Inputs with the upper end below the lower one have no solution.
        of.greatest.hi = higher(&of.greatest.hi, &of.least.hi);
        of.least.lo = lower(&of.least.lo, &of.greatest.lo);
        of
    }
}

/// An interval for each entry of the load.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadBox {
    /// b_lo
    pub lo: Vec<f64>,
    /// b_hi
    pub hi: Vec<f64>,
}

impl LoadBox {
    /// All Σ p_j b_j for the columns b_j of n entries each and p_j in `ranges`, rounded outwards.
    pub fn new(columns: &[Vec<f64>], ranges: &[[f64; 2]], n: usize) -> Self {
        let (mut lo, mut hi) = (vec![0.0; n], vec![0.0; n]);
        let mut size = vec![0.0; n];
        for (column, &[least, most]) in columns.iter().zip(ranges) {
            for (at, &entry) in column.iter().enumerate() {
                let [a, b] = [entry * least, entry * most];
                lo[at] += a.min(b);
                hi[at] += a.max(b);
                size[at] += a.abs().max(b.abs());
            }
        }
        let noise = (columns.len() as f64 + 2.0) * f64::EPSILON;
        for (at, size) in size.iter().enumerate() {
            lo[at] -= noise * size;
            hi[at] += noise * size;
        }
        Self { lo, hi }
    }
}

impl Enclosure {
    /// Encloses the solutions of x ≥ 0, Sx − b ≥ 0, xᵀ(Sx − b) = 0 for all b of `loads`.
    ///
    /// # Errors
    /// Loads that are not finite.
    pub fn new(split: &Split, loads: &LoadBox) -> Result<Self, ReferenceError> {
        let n = loads.lo.len();
        let mut now = Self { lo: vec![0.0; n], hi: vec![f64::INFINITY; n], reaction: vec![0.0; n] };
        for step in 0..STEPS {
            let before = now.width();
            let [least, _] = split.push(&now.lo);
            now.hi = lower(&now.hi, &split.above(&minus(&loads.hi, &least))?);
            // What overflows tells nothing of any edge.
            if now.hi.iter().any(|hi| !hi.is_finite()) {
                return Ok(now);
            }
            let [_, most] = split.push(&now.hi);
            now.lo = higher(&now.lo, &split.below(&minus(&loads.lo, &most))?);
            let has_shrunk = before - now.width() > GAIN * before;
            if split.has_all_signs() || step > 0 && !has_shrunk {
                break;
            }
        }
        now.reaction = split.reaction(&now, loads);
        Ok(now)
    }

    /// The solutions of `model` for p in `ranges`, where fluxes have limits; nothing where P is not 0: x may have either sign
    /// then, and there is no enclosure to begin with.
    ///
    /// # Errors
    /// Loads that are not finite.
    pub fn between(
        split: &Split,
        model: &CondensedModel,
        ranges: &[[f64; 2]],
    ) -> Result<Option<Self>, ReferenceError> {
        if !split.has_all_signs() {
            return Ok(None);
        }
        let EndBox { least, greatest } = EndBox::new(model, ranges);
        let hi = split.above_ends(&least.hi, &greatest.hi)?;
        let lo = split.below_ends(&least.lo, &greatest.lo)?;
        let mut now = Self { reaction: vec![0.0; lo.len()], lo, hi };
        // What overflows tells nothing of any edge.
        if now.lo.iter().chain(&now.hi).all(|end| end.is_finite()) {
            now.reaction = split.rooms(&now, &least, &greatest);
        }
        Ok(Some(now))
    }

    /// Σ (hi − lo)
    fn width(&self) -> f64 {
        self.hi.iter().zip(&self.lo).map(|(hi, lo)| hi - lo).sum()
    }
}

impl Enclosure {
    /// lo ≤ x ≤ hi
    pub(super) fn intervals(&self) -> Vec<Interval> {
        self.lo.iter().zip(&self.hi).map(|(&lo, &hi)| Interval { lo, hi }).collect()
    }

    /// Whether x_at > 0 for all loads.
    pub(super) fn is_open(&self, at: usize) -> bool {
        self.lo[at] > 0.0
    }

    /// Whether x_at < 0 for all loads.
    pub(super) fn is_saturated(&self, at: usize) -> bool {
        self.hi[at] < 0.0
    }

    /// Whether x_at = 0 for all loads.
    pub(super) fn is_touching(&self, at: usize) -> bool {
        self.reaction[at] > 0.0
    }
}

impl Split {
    /// At most (Sx − b)_i = s_ii x_i + (N x)_i off the diagonal + (Px)_i − b_i where x_i = 0 is taken.
    fn reaction(&self, of: &Enclosure, loads: &LoadBox) -> Vec<f64> {
        let [push, _] = self.push(&of.lo);
        let rows = self.off_diagonal().zip(push).zip(&loads.hi);
        let least = rows.map(|((row, push), b)| {
            let (sum, noise) = product(&row, &of.hi);
            let size = sum.abs() + push.abs() + b.abs();
            sum - noise + push - b - 4.0 * f64::EPSILON * size
        });
        least.collect()
    }
}

impl Split {
    /// At most the way from (Sx − b)_i to either end, where x_i = 0 is taken.
    fn rooms(&self, of: &Enclosure, least: &LoadBox, greatest: &LoadBox) -> Vec<f64> {
        let rows = self.off_diagonal().enumerate();
        let room = |(at, row): (usize, Vec<f64>)| {
            let way = |x: &[f64], end: f64, sign: f64| {
                let (sum, noise) = product(&row, x);
                let size = sum.abs() + end.abs();
                match end.is_infinite() {
                    true => f64::INFINITY,
                    false => sign * (sum - end) - noise - 4.0 * f64::EPSILON * size,
                }
            };
            way(&of.hi, least.hi[at], 1.0).min(way(&of.lo, greatest.lo[at], -1.0))
        };
        rows.map(room).collect()
    }
}

fn minus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn lower(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a.min(*b)).collect()
}

fn higher(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a.max(*b)).collect()
}
