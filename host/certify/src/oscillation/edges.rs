//! Oscillation of given fluxes and of the ends of contact fluxes, along their edges.

use std::f64::consts::PI;

use signorini_kernel::mesh::geometry::triangle_area;

use super::parts;
use super::rules::{ELLIPSES, LEFT, PANELS, POINTS, RESOLVED};
use super::stretched;
use crate::cell::Cell;
use crate::conductivity::Conductivity;
use crate::stretch::is_even;
use signorini_problem::quadrature::enclosed::{Integral, pole};
use signorini_problem::quadrature::refined::refined;
use signorini_problem::quadrature::{gauss, on_panels};
use signorini_problem::{Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::expression::enclosure::{Form, Region, Shape};
use signorini_scene::mesh::shape::edge_length;
use signorini_scene::scene::Field;

/// Of the trace inequality, with |E| h_K²/|K|.
const TRACE: f64 = 1.0 / (PI * PI) + 1.0 / PI;

/// Most parts of an edge.
const MOST: usize = 200;

/// osc_E, and what may be missed of it; g and q are both the `flux` of their boundary. Between two finite ends τ·n = lo + θ (hi − lo) all
/// along the edge, where θ is that of its mean. What the mean leaves out of it, (1 − θ) that of lo and θ that of hi, is at most the larger
/// one of both.
pub fn of_flux(problem: &Problem, edge: usize) -> Result<[f64; 2]> {
    let least = of_end(problem, edge, Field::Flux)?;
    let most = of_end(problem, edge, Field::Limit)?;
    Ok(if least.iter().sum::<f64>() > most.iter().sum() { least } else { most })
}

fn of_end(problem: &Problem, edge: usize, field: Field) -> Result<[f64; 2]> {
    let Some(g) = Sum::on_edge(problem, edge, field) else { return Ok([0.0; 2]) };
    if g.constant().is_some() {
        return Ok([0.0; 2]);
    }
    let segment = problem.segment(edge);
    let (length, mean) = (problem.lengths[edge], g.mean_and_missed(segment)?);
    let square = length_square(&g, segment, length, mean)?;
    let (at, _) = problem.topology.first_side(edge);
    let (shape, alpha) = (shape(problem, edge), Conductivity::of(problem, at).alpha());
    let by_trace = |square: f64| (shape * TRACE * square / alpha).sqrt();
    let known = by_trace(square.value);
    if square.missed == 0.0 && !is_even(problem, at) {
        let by_flux = stretched::along_edge(problem, edge, &g, mean.value, by_trace);
        return Ok([known.min(by_flux), 0.0]);
    }
    Ok([known, by_trace(square.value + square.missed) - known])
}

/// How far the mean of v along an edge may be from that in its cell, where ‖A^½∇v‖ = 1 there. The mean of |v − v_T| is not larger. In
/// a quad it is the mean of the reference square, over which loads are spread.
pub fn off_mean(problem: &Problem, edge: usize) -> f64 {
    let (at, _) = problem.topology.first_side(edge);
    let (softness, length) = (Conductivity::of(problem, at).alpha(), problem.lengths[edge]);
    let shape = shape(problem, edge);
    let from_triangle = (shape * TRACE / (length * softness)).sqrt();
    let cell = Cell::of(problem, at);
    let Cell::Quad(corners) = cell else { return from_triangle };
    // |K| = |E| h_K²/shape, where h_K ≥ |E|; of the square 1/(4 det) weighs v, whose least stands at a corner.
    let area = length.powi(3) / shape;
    let corner = |at: usize| triangle_area([0, 1, 3].map(|next| corners[(at + next) % 4]));
    let least = (0..4).map(corner).fold(f64::INFINITY, f64::min);
    let from_square = (1.0 / area).sqrt() + (0.5 / least).sqrt();
    from_triangle + cell.diameter() / PI / softness.sqrt() * from_square
}

/// |E| h_K²/|K| of the triangle K of an edge.
fn shape(problem: &Problem, edge: usize) -> f64 {
    let ([a, b], length) = (problem.segment(edge), problem.lengths[edge]);
    let (at, side) = problem.topology.first_side(edge);
    let apex = opposite(&Cell::of(problem, at), side);
    let diameter = length.max(edge_length([a, apex])).max(edge_length([b, apex]));
    length * diameter * diameter / triangle_area([a, b, apex])
}

/// ‖g − ḡ‖² on an edge. What is missed of the mean counts with it.
fn length_square(g: &Sum, segment: [[f64; 2]; 2], length: f64, mean: Integral) -> Result<Integral> {
    let [a, b] = segment;
    let difference = |t: f64| g.at(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])) - mean.value;
    let rule = on_panels(PANELS, &gauss(POINTS));
    let square: f64 = rule.iter().map(|[t, weight]| weight * difference(*t).powi(2)).sum();
    let square = length * g.finite(square, a)?;
    let region = Region::segment(segment);
    let is_resolved = g.degree() < POINTS as f64
        || ELLIPSES.into_iter().any(|rho| {
            let most = g.modulus(&region, rho) + mean.value.abs();
            region.missed(POINTS, rho, most * most) <= RESOLVED * square
        });
    if is_resolved {
        return Ok(Integral { value: square, missed: 0.0 });
    }
    let constant = Form::constant(Shape::Segment, mean.value);
    let cut = refined(
        |region| g.cut(region),
        [(0, region)],
        MOST,
        |size, missed| missed <= LEFT * size,
        |_, part| parts::square(g, part, &constant),
    );
    let [value, missed] = cut
        .iter()
        .fold([0.0; 2], |[value, missed], part| [value + part.value, missed + part.missed]);
    let sum = Integral { value, missed: missed + length * mean.missed.powi(2) };
    Ok(sum.unless(square, RESOLVED * square))
}

/// The vertex opposite of a triangle's side, the middle of a quad.
fn opposite(cell: &Cell, side: usize) -> [f64; 2] {
    match cell {
        Cell::Triangle(corners) => corners[(side + 2) % 3],
        Cell::Quad([a, b, c, d]) => [0, 1].map(|k| 0.25 * (a[k] + b[k] + c[k] + d[k])),
    }
}

/// Where a flux or a limit has no square integral on an edge.
pub fn pole_on_edge(problem: &Problem, edge: usize) -> Option<(Field, [f64; 2], bool)> {
    [Field::Flux, Field::Limit, Field::Ambient].into_iter().find_map(|field| {
        let data = Sum::on_edge(problem, edge, field)?;
        let (at, is_proved) = pole(&data, &Region::segment(problem.segment(edge)), 2.0)?;
        Some((field, at, is_proved))
    })
}
