//! Oscillation in cells that A or their shape stretches: fluxes inside them balance most of what means leave out.
//!
//! What a flux leaves of f − f̄ or g − ḡ is integrated by the rule that has resolved these themselves; what that rule misses of the rest is
//! bounded by moduli in ellipses around the cell, and added.

use signorini_kernel::Tensor;

use super::rules::{ELLIPSES, PANELS, POINTS, differences};
use crate::cell::Cell;
use crate::edge_flux::EdgeFlux;
use crate::local_flux::LocalFlux;
use crate::profile::{self, NO_SIDES};
use crate::stretch::floor;
use signorini_problem::quadrature::{enclosed, gauss, on_panels};
use signorini_problem::{Problem, Sum};
use signorini_scene::expression::enclosure::Region;

/// A flux inside a stretched cell, in a unit of length of its own, and what its divergence leaves.
#[derive(Debug, Clone)]
pub struct Inside {
    cell: Cell,
    a: Tensor<f64>,
    flux: LocalFlux,
    rest: f64,
}

/// osc_T by a flux inside the cell ([`crate::local_flux`]). In the plane energies are the same in any unit of length.
pub fn in_cell(problem: &Problem, at: usize, f: &Sum) -> (f64, Inside) {
    let (own, rule) = (Cell::of(problem, at), gauss(POINTS));
    let load = problem.loads.of_cell(at);
    let (unit, all) = differences(&own, f, load);
    let (cell, a) = (own.scaled(1.0 / unit), floor(problem, at));
    let points = cell.points(&rule);
    let values: Vec<_> = all.iter().map(|(_, value)| unit * value).collect();
    let flux = LocalFlux::fitted(&cell, &a, &rule, (&points, &values), &NO_SIDES);
    let [mut square, mut rest] = [0.0; 2];
    for (point, value) in points.iter().zip(&values) {
        let determinant = cell.determinant(point.reference);
        square += point.weight * value.powi(2);
        rest += point.weight * (value - flux.divergence(point.reference, determinant)).powi(2);
    }
    let rest = flux.reach * (rest + missed(&own, f, load, &flux, unit)).sqrt();
    ((flux.norm + rest).min(flux.reach * square.sqrt()), Inside { cell, a, flux, rest })
}

/// The part of the square of f − f̄ − ∇·ρ that the rule misses, in the cell's own unit.
fn missed(cell: &Cell, f: &Sum, load: f64, flux: &LocalFlux, unit: f64) -> f64 {
    if cell.is_affine() && f.degree() < POINTS as f64 {
        return 0.0;
    }
    let (region, square) = (enclosed::region(*cell), unit * unit);
    let within = |rho: f64| {
        let density = region.least_density(rho) * region.measure();
        let of_data = f.modulus(&region, rho) + load.abs() / density;
        let most = square * of_data + flux.modulus(rho, density / square);
        let missed = region.missed(POINTS, rho, most * most) / square;
        if density > 0.0 && !missed.is_nan() { missed } else { f64::INFINITY }
    };
    ELLIPSES.into_iter().map(within).fold(f64::INFINITY, f64::min)
}

/// osc_T of all cells, `known` without, where fluxes go through sides between stretched quads as well; nothing where there are none.
pub fn through_sides(problem: &Problem, known: &[f64], inside: &[Option<Inside>]) -> Vec<f64> {
    if inside.iter().all(Option::is_none) {
        return Vec::new();
    }
    let in_rows = |of: &Inside| of.flux.in_rows(&of.cell, &of.a);
    let quads: Vec<_> = inside.iter().map(|of| of.as_ref().and_then(in_rows)).collect();
    let (profiles, rule) = (profile::profiles(problem, &quads), gauss(POINTS));
    let of_cell = |at: usize| match &inside[at] {
        Some(of) if quads[at].is_some() => {
            let sides = profile::of_cell(problem, at, &profiles);
            of.flux.norm_through(&of.cell, &of.a, &rule, &sides) + of.rest
        }
        _ => known[at],
    };
    (0..inside.len()).map(of_cell).collect()
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
    let a = floor(problem, at);
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
