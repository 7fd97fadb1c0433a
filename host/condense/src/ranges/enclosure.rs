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
pub(super) const STEPS: u32 = 16;
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
        Self { least: side(0, f64::NEG_INFINITY), greatest: side(1, f64::INFINITY) }.feasible()
    }

    /// Intervals of both loads of every edge, where these ends of it are finite.
    pub(super) fn of(intervals: &[[[f64; 2]; 2]], ends: &[[Vec<f64>; 2]]) -> Self {
        let side = |side: usize| {
            let all = intervals.iter().zip(ends).map(|(own, ends)| match ends[side][0] {
                end if end.is_finite() => (own[side][0], own[side][1]),
                infinite => (infinite, infinite),
            });
            let (lo, hi) = all.unzip();
            LoadBox { lo, hi }
        };
        Self { least: side(0), greatest: side(1) }.feasible()
    }

    /// With so much more on either side.
    pub(super) fn widened(&self, by: &[f64]) -> Self {
        let moved =
            |of: &[f64], sign: f64| of.iter().zip(by).map(|(end, by)| end + sign * by).collect();
        let side = |of: &LoadBox| LoadBox { lo: moved(&of.lo, -1.0), hi: moved(&of.hi, 1.0) };
        Self { least: side(&self.least), greatest: side(&self.greatest) }
    }

    /// Without inputs that put the upper end below the lower one: they have no solution.
    fn feasible(mut self) -> Self {
        self.greatest.hi = higher(&self.greatest.hi, &self.least.hi);
        self.least.lo = lower(&self.least.lo, &self.greatest.lo);
        self
    }
}

impl Enclosure {
    /// Encloses the solutions for all loads and ends of `box_of`: x ≥ 0, Sx − b ≥ 0, xᵀ(Sx − b) = 0, or the same with limits.
    /// Nothing where fluxes have limits and P is not 0: x may have either sign then, and there is no enclosure to begin with.
    ///
    /// # Errors
    /// Loads that are not finite.
    pub fn new(split: &Split, box_of: &EndBox) -> Result<Option<Self>, ReferenceError> {
        let (EndBox { least, greatest }, n) = (box_of, box_of.least.lo.len());
        let is_limited = greatest.hi.iter().any(|&end| end != f64::INFINITY);
        if is_limited && !split.has_all_signs() {
            return Ok(None);
        }
        let lowest = if is_limited { f64::NEG_INFINITY } else { 0.0 };
        let (lo, hi, reaction) = (vec![lowest; n], vec![f64::INFINITY; n], vec![0.0; n]);
        let above = |lo: &[f64]| {
            let [push, _] = split.push(lo);
            split.above(&minus(&least.hi, &push), &greatest.hi)
        };
        let mut now = Self { lo, hi, reaction }.shrunk(split, box_of, above)?;
        // What overflows tells nothing of any edge.
        if now.is_finite() {
            // (Sx − b)_i = s_ii x_i + (Nx)_i off the diagonal + (Px)_i − b_i
            let [down, up] = split.push(&now.lo);
            now.reaction = rooms(split.off_diagonal(), [&down, &up], &now, box_of);
        }
        Ok(Some(now))
    }

    /// Each side made from what the other one pushes by, until both stay; `above` finds upper ones from lower ones.
    pub(super) fn shrunk(
        mut self,
        split: &Split,
        EndBox { least, greatest }: &EndBox,
        above: impl Fn(&[f64]) -> Result<Vec<f64>, ReferenceError>,
    ) -> Result<Self, ReferenceError> {
        for _ in 0..STEPS {
            let before = self.width();
            self.hi = lower(&self.hi, &above(&self.lo)?);
            if !split.has_all_signs() && !self.is_finite() {
                break;
            }
            let [_, push] = split.push(&self.hi);
            let lo = split.below(&minus(&least.lo, &push), &minus(&greatest.lo, &push))?;
            self.lo = higher(&self.lo, &lo);
            let has_shrunk = before.is_infinite() || before - self.width() > GAIN * before;
            if split.has_all_signs() || !has_shrunk {
                break;
            }
        }
        Ok(self)
    }

    /// Whether nothing has overflowed.
    pub(super) fn is_finite(&self) -> bool {
        self.lo.iter().chain(&self.hi).all(|end| end.is_finite())
    }

    /// Σ (hi − lo)
    fn width(&self) -> f64 {
        self.hi.iter().zip(&self.lo).map(|(hi, lo)| hi - lo).sum()
    }

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

/// At most the way from Σ_j a_ij x_j + pushes_i − b_i to either end, for rows a_i that take x_i = 0 or its past alone; from below what `lo`
/// pushes by, from above what `hi` does.
pub(super) fn rooms(
    rows: impl Iterator<Item = Vec<f64>>,
    pushes: [&[f64]; 2],
    of: &Enclosure,
    EndBox { least, greatest }: &EndBox,
) -> Vec<f64> {
    let room = |(at, row): (usize, Vec<f64>)| {
        let way = |x: &[f64], push: f64, end: f64, sign: f64| {
            let (sum, noise) = product(&row, x);
            let size = sum.abs() + push.abs() + end.abs();
            match end.is_infinite() {
                true => f64::INFINITY,
                false => sign * (sum + push - end) - noise - 4.0 * f64::EPSILON * size,
            }
        };
        let above = way(&of.hi, pushes[0][at], least.hi[at], 1.0);
        above.min(way(&of.lo, pushes[1][at], greatest.lo[at], -1.0))
    };
    rows.enumerate().map(room).collect()
}

pub(super) fn minus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn lower(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a.min(*b)).collect()
}

fn higher(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a.max(*b)).collect()
}
