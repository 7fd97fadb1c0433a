//! The ends of a contact edge's flux: nowhere the wrong way round.
//!
//! ```text
//!   lo(x) = flux + Σ_j p_j π_j ≤ hi(x) = limit + Σ_j p_j π_j
//! ```
//! at the points of the rule for edge data and at the ends of every edge. Means of them are what the kernel has: the smaller
//! one in size as the base of the range, and the way to the other as its span.

use signorini_kernel::Real;
use signorini_kernel::flux_range::settled;

use super::{Problem, Sum};
use crate::quadrature::{DATA_POINTS, gauss, on_panels};
use signorini_scene::error::Result;
use signorini_scene::scene::Field;

/// Gauss points a panel, and panels on an edge, at which the least and the largest span are looked for.
const POINTS: usize = 8;
const PANELS: u32 = 4;
/// Part of a constant difference that rounding may leave.
const CONSTANT: f64 = 1e-12;

/// Terms that an end counts for where rounding is told from an empty range: an expression has many, and so has a mean.
pub(super) const TERMS: usize = 4500;

/// The means of both ends of a contact edge's flux; an infinite end is its own mean.
pub(super) fn ends(problem: &Problem, edge: usize, time: f64) -> Result<[f64; 2]> {
    let mean = |field, unlimited: f64| {
        let Some(end) = Sum::on_edge(problem, edge, field, time) else { return Ok(unlimited) };
        let infinite = end.constant().filter(|end| end.is_infinite());
        infinite.map_or_else(|| end.mean(problem.segment(edge)), Ok)
    };
    Ok([mean(Field::Flux, f64::NEG_INFINITY)?, mean(Field::Limit, f64::INFINITY)?])
}

/// Base and span of a contact edge from the means of its ends over a length of `length`.
pub(super) fn base_and_span([least, most]: [f64; 2], length: f64) -> [f64; 2] {
    // Means of equal ends may differ by rounding.
    let span = length * (most - least).max(0.0);
    match most.abs() < least.abs() {
        true => [length * most, -span],
        false => [length * least, span],
    }
}

/// hi − lo along an edge on which it varies, times the length of the edge.
pub struct Spread {
    /// By how much its largest value exceeds the mean.
    pub excess: f64,
    /// Its least value, as a part of the mean.
    pub least: f64,
}

/// Spread of a contact edge; `None` where both ends are finite on no side, or hi − lo is constant along the edge.
pub fn spread(problem: &Problem, edge: usize, time: f64) -> Option<Spread> {
    let least = Sum::on_edge(problem, edge, Field::Flux, time)?;
    let most = Sum::on_edge(problem, edge, Field::Limit, time)?;
    let is_infinite = |sum: &Sum| sum.constant().is_some_and(f64::is_infinite);
    let are_constant = least.constant().is_some() && most.constant().is_some();
    if are_constant || is_infinite(&least) || is_infinite(&most) {
        return None;
    }
    let [a, b] = problem.segment(edge);
    let inside = on_panels(PANELS, &gauss(POINTS));
    let along = inside.iter().map(|&[t, weight]| (t, weight)).chain([(0.0, 0.0), (1.0, 0.0)]);
    let (mut low, mut high, mut mean) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
    let mut terms: f64 = 0.0;
    for (t, weight) in along {
        let [x, y] = [0, 1].map(|k| a[k] + t * (b[k] - a[k]));
        let span = most.at(x, y) - least.at(x, y);
        (low, high, mean) = (low.min(span), high.max(span), mean + weight * span);
        terms = terms.max(least.terms_at(x, y) + most.terms_at(x, y));
    }
    // Of ends that are equal rounding leaves a part of themselves.
    let varies = high - low > (CONSTANT * mean).max(64.0 * f64::EPSILON * terms);
    varies.then(|| Spread { excess: problem.lengths[edge] * (high - mean), least: low / mean })
}

/// Refuses a lower end above the upper one.
///
/// # Errors
/// The first edge with such a point, with both values.
pub(super) fn check(problem: &Problem) -> Result<()> {
    let scene = &problem.scene;
    if !scene.boundaries.iter().any(|boundary| boundary.condition.is_limited()) {
        return Ok(());
    }
    let counts = problem.topology.counts;
    (counts.free..counts.unknowns()).try_for_each(|edge| check_edge(problem, edge))
}

fn check_edge(problem: &Problem, edge: usize) -> Result<()> {
    let end = |field| Sum::on_edge(problem, edge, field, problem.time);
    let (Some(least), Some(most)) = (end(Field::Flux), end(Field::Limit)) else { return Ok(()) };
    let [a, b] = problem.segment(edge);
    let inside = f64::GAUSS[DATA_POINTS - 1].iter().map(|point| point[0]);
    for t in inside.chain([0.0, 1.0]) {
        let [x, y] = [0, 1].map(|k| a[k] + t * (b[k] - a[k]));
        let (low, high) = (least.at(x, y), most.at(x, y));
        let terms = || least.terms_at(x, y) + most.terms_at(x, y);
        if low > high && settled(high - low, terms(), TERMS).is_none() {
            let message =
                format!("the limit is {high} at ({x}, {y}), less than flux = {low} there");
            let hint =
                "the flux of a contact boundary lies between `flux` and `limit`, inputs included";
            return Err(problem.scene.error(most.key(), message).hint(hint).into());
        }
    }
    Ok(())
}
