//! Integrals of loads over edges and cells, and what is missed of them at most.
//!
//! What a rule misses of a load's mean is out of balance, and no bound of the oscillation, which has no mean, sees it. So each integral
//! comes with a proof:
//! ```text
//!   a polynomial that the rule integrates exactly ─► the rule
//!   analytic around the region, by its modulus    ─► the rule
//!   else parts of the region, the worst first: each by the rule and its modulus, or by its Taylor form and remainder
//! ```
//! Where the sum over parts confirms the rule, its value stays, with its bits. What is missed beyond 1e−13 of ∫|f| is counted.

use signorini_kernel::Real;

use super::refined::refined;
use super::{DATA_POINTS, Point, TRIANGLE_POINTS};
use crate::Sum;
use crate::cell::Cell;
use signorini_scene::expression::enclosure::{Interval, Region, Shape};

/// Part of ∫|f| up to which an integral counts as exact: rounding of the data themselves is as large.
const RESOLVED: f64 = 1e-13;
/// Ellipses in which continuations are looked at: wide ones prove most where data are smooth, narrow ones reach no pole. Six points need the
/// widest: they miss 16⁻¹² of a modulus in the next, which is more than 1e−13 of a load.
const ELLIPSES: [f64; 5] = [64.0, 16.0, 8.0, 4.0, 2.0];
/// Most parts in all, and for each region: of data whose enclosures converge fast, and of others.
const MOST: [usize; 2] = [20_000, 4_000];
const EACH: usize = 4;
/// Cuts in search of a pole.
const HALVINGS: u32 = 24;
/// Part of the largest |f| that is as good as nothing.
const FAINT: f64 = 1e-18;

/// An integral, and what is missed of it: 0 where it is resolved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Integral {
    /// The value.
    pub value: f64,
    /// The exact value differs by no more.
    pub missed: f64,
}

impl Integral {
    /// A rule's value with its bits instead, where this proves that no more than `tolerance` is missed of it.
    #[must_use]
    pub fn unless(self, rule: f64, tolerance: f64) -> Self {
        match (rule - self.value).abs() + self.missed <= tolerance {
            true => Self { value: rule, missed: 0.0 },
            false => self,
        }
    }
}

/// The region of a cell.
pub fn region(cell: Cell) -> Region {
    match cell {
        Cell::Triangle(corners) => Region::triangle(corners),
        Cell::Quad(corners) => Region::quad(corners),
    }
}

/// ∫f over each of `cells`.
pub fn over_cells(f: &Sum, cells: &[Cell]) -> Vec<Integral> {
    let by_rule = cells.iter().map(|cell| by_rule(f, &rule_of(cell))).collect();
    resolved(f, &cells.iter().map(|&cell| region(cell)).collect::<Vec<_>>(), by_rule)
}

/// The mean of f over a segment.
pub fn mean_on_edge(f: &Sum, segment @ [a, b]: [[f64; 2]; 2]) -> Integral {
    let region = Region::segment(segment);
    let at = |t: f64| [0, 1].map(|k| a[k] + t * (b[k] - a[k]));
    let points = f64::GAUSS[DATA_POINTS - 1].iter();
    let rule: Vec<_> = points.map(|&[t, weight]| (at(t), weight)).collect();
    let length = region.measure();
    let [mean, size] = by_rule(f, &rule);
    let found = resolved(f, &[region], vec![[mean, size].map(|x| length * x)]);
    // The rule's own bits where it stays.
    match found[..] {
        [Integral { value, missed }] if missed > 0.0 || value != length * mean => {
            Integral { value: value / length, missed: missed / length }
        }
        _ => Integral { value: mean, missed: 0.0 },
    }
}

fn rule_of(cell: &Cell) -> Vec<([f64; 2], f64)> {
    let points = cell.points(f64::GAUSS[points(cell.corners().len()) - 1]);
    points.into_iter().map(|Point { x, weight, .. }| (x, weight)).collect()
}

/// Points a direction of the rule for data.
fn points(corners: usize) -> usize {
    if corners == 3 { TRIANGLE_POINTS } else { DATA_POINTS }
}

/// ∫f and ∫|f| by a rule.
fn by_rule(f: &Sum, rule: &[([f64; 2], f64)]) -> [f64; 2] {
    let values = f.at_all(&rule.iter().map(|(at, _)| *at).collect::<Vec<_>>());
    rule.iter().zip(values).fold([0.0; 2], |[sum, size], ((_, weight), value)| {
        [sum + weight * value, size + (weight * value).abs()]
    })
}

/// Whether the rule integrates polynomials of this degree over a region exactly.
fn is_exact(region: &Region, degree: f64) -> bool {
    let n = points(region.corners().len()) as f64;
    degree <= if region.shape() == Shape::Segment { 2.0 * n - 1.0 } else { 2.0 * n - 2.0 }
}

/// The most that the rule misses over a region, by the best ellipse; the search ends below `enough`.
fn missed_by_rule(f: &Sum, region: &Region, enough: f64) -> f64 {
    let n = points(region.corners().len());
    let mut best = f64::INFINITY;
    for rho in ELLIPSES {
        let missed = region.missed(n, rho, f.modulus(region, rho));
        best = if missed < best { missed } else { best };
        if best <= enough {
            break;
        }
    }
    best
}

/// Integrals over regions, from value and size by the rule.
fn resolved(f: &Sum, regions: &[Region], by_rule: Vec<[f64; 2]>) -> Vec<Integral> {
    let degree = f.degree();
    let sizes: f64 = by_rule.iter().map(|of| of[1]).sum();
    let measures: f64 = regions.iter().map(Region::measure).sum();
    let tolerance =
        |at: usize| RESOLVED * (by_rule[at][1] + sizes * (regions[at].measure() / measures));
    let is_open = |&at: &usize| {
        let is_settled = is_exact(&regions[at], degree) || !by_rule[at][0].is_finite();
        let is_proved = || missed_by_rule(f, &regions[at], tolerance(at)) <= tolerance(at);
        !is_settled && !is_proved()
    };
    let open: Vec<usize> = (0..regions.len()).filter(is_open).collect();
    let mut all: Vec<_> =
        by_rule.iter().map(|&[value, _]| Integral { value, missed: 0.0 }).collect();
    for (&at, sum) in open.iter().zip(on_parts(f, regions, &open, sizes)) {
        all[at] = sum.unless(by_rule[at][0], tolerance(at));
    }
    all
}

/// Integrals over the regions `open`, on parts.
fn on_parts(f: &Sum, regions: &[Region], open: &[usize], sizes: f64) -> Vec<Integral> {
    if open.is_empty() {
        return Vec::new();
    }
    let forms = open.iter().map(|&at| f.enclose(&regions[at]));
    let most = forms.map(|form| form.range().size()).filter(|size| size.is_finite());
    let faint = FAINT * most.fold(0.0, f64::max);
    let [smooth, rough] = MOST;
    let most = EACH * open.len() + if f.is_smooth() { smooth } else { rough };
    let measure: f64 = open.iter().map(|&at| regions[at].measure()).sum();
    let is_enough = |size: f64, missed: f64| missed <= RESOLVED * size.max(sizes) + faint * measure;
    let parts = refined(
        |region| f.cut(region),
        open.iter().map(|&at| regions[at]).enumerate(),
        most,
        is_enough,
        |_, region| on_part(f, region, faint),
    );
    let mut sums = vec![Integral { value: 0.0, missed: 0.0 }; open.len()];
    for part in parts {
        sums[part.of].value += part.value;
        sums[part.of].missed += part.missed;
    }
    sums
}

/// ∫f over a part and what is missed of it, by its form or by the rule.
fn on_part(f: &Sum, region: &Region, faint: f64) -> [f64; 2] {
    let form = f.enclose(region);
    let whole = match form.range().is_finite() {
        true => region.integral(&form),
        false => unbounded(f, region),
    };
    let by_form = [whole.middle(), 0.5 * whole.width()];
    let size = form.range().size() * region.measure();
    let enough = 0.1 * RESOLVED * size + faint * region.measure();
    if by_form[1] <= enough {
        return by_form;
    }
    let missed = missed_by_rule(f, region, enough) + 16.0 * f64::EPSILON * size;
    let rule = match *region.corners() {
        [a, b, c] => rule_of(&Cell::Triangle([a, b, c])),
        [a, b, c, d] => rule_of(&Cell::Quad([a, b, c, d])),
        _ => region.along(f64::GAUSS[DATA_POINTS - 1]),
    };
    let [value, sizes] = by_rule(f, &rule);
    if missed < by_form[1] {
        return [value, missed];
    }
    // The middle of what says next to nothing is no value.
    let says_nothing = by_form[1].is_finite() && by_form[1] > WIDE * sizes;
    if says_nothing && whole.low <= value && value <= whole.high {
        return [value, (value - whole.low).max(whole.high - value)];
    }
    by_form
}

/// Half of an enclosure is wide that is more than so many times what points see of |f|.
const WIDE: f64 = 8.0;

/// ∫f over a part where it is not bounded, as it grows.
fn unbounded(f: &Sum, region: &Region) -> Interval {
    let Some(growth) = f.growth(region) else { return Interval::ALL };
    let size = region.grown(&growth, 1.0);
    match growth.sign {
        0.0 => Interval::around(size.high),
        sign => sign * size,
    }
}

/// Where f may not be bounded, or not be enclosed, in a region; and whether |f|ᵏ is proved to have no finite integral there.
pub fn pole(f: &Sum, region: &Region, k: f64) -> Option<([f64; 2], bool)> {
    let is_open = |part: &Region| !f.enclose(part).range().is_finite();
    let mut part = Some(*region).filter(is_open)?;
    for _ in 0..HALVINGS {
        let growth = f.growth(&part);
        if let Some(growth) = growth.filter(|growth| part.grown(growth, k).low == f64::INFINITY) {
            let place = growth.place.map_or(part.centre(), |place| part.nearest(place));
            return Some((place, true));
        }
        let Some(next) = part.parts().into_iter().find(is_open) else { break };
        part = next;
    }
    Some((part.centre(), false))
}

#[cfg(test)]
mod tests;
