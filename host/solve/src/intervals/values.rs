//! Outputs of s and τ, the functions that the error bound is about: each with the size of what it is summed from.

use super::part::Part;
use crate::certify::cell::Cell;
use crate::certify::curved::{self, followed};
use crate::functional::Functional;
use crate::problem::{EdgeKind, Problem, Sum};
use crate::quadrature::{DATA_POINTS, gauss};
use crate::solve::Solution;
use signorini_kernel::Real;
use signorini_scene::error::Result;
use signorini_scene::scene::{Condition, Field, Output};

/// The mean of s over a part of the boundary.
pub(super) fn mean(problem: &Problem, solution: &Solution, part: &Part) -> Result<[f64; 2]> {
    let s = solution.certified.admissible();
    let deviations = followed(problem, &s)?;
    let [mut sum, mut terms] = [0.0; 2];
    for edge in part.edges() {
        for &[t, weight] in f64::GAUSS[DATA_POINTS - 1] {
            let value = s.on_edge(problem, edge, deviations.on(edge), t)?;
            sum += problem.lengths[edge] * weight * value;
            terms += problem.lengths[edge] * weight * value.abs();
        }
    }
    Ok([sum / part.length(), terms / part.length()])
}

/// The cell with a probe, and the mean of s over it; on quads that in its reference coordinates.
pub(super) fn cell(
    problem: &Problem,
    solution: &Solution,
    output: &Output,
) -> Result<(usize, [f64; 2])> {
    let Functional::Probe(at, _) = Functional::of(problem, output)? else {
        return Ok((0, [f64::NAN; 2]));
    };
    let (cell, s) = (Cell::of(problem, at), solution.certified.admissible());
    let deviations = followed(problem, &s)?;
    let s = s.on_cell(problem, at, &deviations);
    let [mut sum, mut terms] = [0.0; 2];
    for point in curved::points(problem, at, &deviations, &gauss(curved::POINTS))? {
        let local = cell.local(point.reference);
        let (value, weight) = (s.at(&local)?.value, cell.spread(point.weight, local.determinant));
        sum += weight * value;
        terms += weight * value.abs();
    }
    Ok((at, [sum, terms]))
}

/// ∫τ·n over a part of the boundary; as a force, from the ends that it is measured from.
pub(super) fn flux(
    problem: &Problem,
    solution: &Solution,
    part: &Part,
    is_force: bool,
) -> Result<[f64; 2]> {
    let [mut sum, mut terms] = [0.0; 2];
    for edge in part.edges() {
        let flux = solution.certified.tau[edge];
        let (direction, end) = match is_force {
            true if problem.kinds[edge] != EdgeKind::Contact => continue,
            true => end(problem, edge)?,
            false => (1.0, 0.0),
        };
        sum += direction * (flux - end);
        terms += flux.abs() + end.abs();
    }
    Ok([sum, terms])
}

/// 1 where the force on a boundary is measured from its least flux, −1 where it has none, and it is the way to its limit.
pub(super) fn direction(problem: &Problem, table: usize) -> f64 {
    let Condition::Contact { flux, .. } = &problem.scene.boundaries[table].condition else {
        return 0.0;
    };
    if flux.value.is_constant() == Some(f64::NEG_INFINITY) { -1.0 } else { 1.0 }
}

/// The direction of the force on a contact edge, and ∫_E of the end that it is measured from.
pub(super) fn end(problem: &Problem, edge: usize) -> Result<(f64, f64)> {
    let table = problem.binding.boundary(problem.ends[edge]);
    let direction = table.map_or(0.0, |table| direction(problem, table));
    let field = if direction > 0.0 { Field::Flux } else { Field::Limit };
    let Some(end) = Sum::on_edge(problem, edge, field, problem.time) else {
        return Ok((direction, 0.0));
    };
    Ok((direction, problem.lengths[edge] * end.mean(problem.segment(edge))?))
}
