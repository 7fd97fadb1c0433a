//! Oscillation in cells that A or their shape stretches: fluxes inside them balance most of what means leave out.
//!
//! What a flux leaves of f − f̄ or g − ḡ is integrated by the rule that has resolved these themselves; what that rule misses of the rest is
//! bounded by moduli in ellipses around the cell, and added.

use super::rules::{ELLIPSES, PANELS, POINTS, differences};
use crate::cell::Cell;
use crate::edge_flux::EdgeFlux;
use crate::local_flux::LocalFlux;
use crate::profile::{self, NO_SIDES, Sides, profiles};
use crate::stretch::{floor, is_even};
use signorini_problem::quadrature::{enclosed, gauss, on_panels};
use signorini_problem::{Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::expression::enclosure::Region;

/// osc_T by a flux inside the cell ([`crate::local_flux`]), through whose sides `sides` leaves. In the plane energies are the same in any
/// unit of length.
///
/// # Errors
/// Data that are not finite.
pub fn in_cell(problem: &Problem, at: usize, f: &Sum, sides: &Sides) -> Result<f64> {
    let (own, rule) = (Cell::of(problem, at), gauss(POINTS));
    let load = problem.loads.of_cell(at);
    let (unit, all) = differences(&own, f, load);
    let (cell, a) = (own.scaled(1.0 / unit), floor(problem, at, &rule));
    let points = cell.points(&rule);
    let values: Vec<_> = all.iter().map(|(_, value)| unit * value).collect();
    let flux = LocalFlux::fitted(&cell, &a, &rule, (&points, &values), sides);
    let [mut square, mut rest] = [0.0; 2];
    for (point, value) in points.iter().zip(&values) {
        let determinant = cell.local(point.reference).determinant;
        square += point.weight * value.powi(2);
        rest += point.weight * (value - flux.divergence(point.reference, determinant)).powi(2);
    }
    let region = enclosed::region(own);
    let missed = ELLIPSES.into_iter().map(|rho| {
        let density = region.least_density(rho) * region.measure();
        let most = f.modulus(&region, rho) + load.abs() / density;
        let own = unit * unit * most + flux.modulus(rho, density / (unit * unit));
        let missed = region.missed(POINTS, rho, own * own) / (unit * unit);
        if density > 0.0 { missed } else { f64::INFINITY }
    });
    let is_exact = own.is_affine() && f.degree() < POINTS as f64;
    let missed = if is_exact { 0.0 } else { missed.fold(f64::INFINITY, f64::min) };
    let by_flux = flux.norm + flux.reach * (rest + missed).sqrt();
    let least = if sides == &NO_SIDES {
        by_flux.min(flux.reach * (square + missed).sqrt())
    } else {
        by_flux
    };
    f.finite(least.min(f64::MAX), own.corners()[0])
}

/// osc_T of all cells, `known` without, where fluxes go through sides as well; nothing where no side has one, or where f is not resolved everywhere: what
/// passes through a side has to be balanced in both cells.
///
/// # Errors
/// Data that are not finite.
pub fn through_sides(problem: &Problem, known: &[f64], unresolved: &[f64]) -> Result<Vec<f64>> {
    let f = Sum::source(&problem.scene, problem.time);
    if f.is_zero() || unresolved.iter().any(|&missed| missed != 0.0) {
        return Ok(Vec::new());
    }
    let profiles = profiles(problem, &f);
    if profiles.is_empty() {
        return Ok(Vec::new());
    }
    let of_cell = |at: usize| {
        let sides = profile::of_cell(problem, at, &profiles);
        let is_closed = sides == NO_SIDES || is_even(problem, at);
        if is_closed { Ok(known[at]) } else { in_cell(problem, at, &f, &sides) }
    };
    (0..problem.cells()).map(of_cell).collect()
}

/// osc_E by a flux inside the cell ([`crate::edge_flux`]); `by_trace` is what ‖g − ḡ‖² costs without one.
pub fn along_edge(
    problem: &Problem,
    edge: usize,
    g: &Sum,
    mean: f64,
    by_trace: impl Fn(f64) -> f64,
) -> f64 {
    let segment = problem.segment(edge);
    let length = problem.lengths[edge];
    let (at, _) = problem.topology.first_side(edge);
    let (cell, points) = (Cell::of(problem, at), gauss(POINTS));
    let rule = on_panels(PANELS, &points);
    let value = |t: f64| {
        let [x, y] = problem.along(edge, t);
        g.at(x, y) - mean
    };
    let differences: Vec<_> = rule.iter().map(|[t, _]| value(*t)).collect();
    let a = floor(problem, at, &points);
    let flux = EdgeFlux::fitted((&cell, segment), &a, (PANELS as usize, &points), &differences);
    let squares = rule.iter().zip(&differences);
    let rest: f64 =
        squares.map(|([t, weight], value)| weight * (value - flux.at(*t)[1]).powi(2)).sum();
    let region = Region::segment(segment);
    // The ellipse of a panel lies inside the disc of the edge.
    let missed = ELLIPSES.into_iter().map(|rho| {
        let most = g.modulus(&region, rho) + mean.abs() + flux.modulus(rho);
        region.missed(POINTS, rho, most * most)
    });
    let missed =
        if g.degree() < POINTS as f64 { 0.0 } else { missed.fold(f64::INFINITY, f64::min) };
    flux.norm + by_trace(length * rest + missed)
}
