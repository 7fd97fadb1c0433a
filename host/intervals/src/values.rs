//! Outputs of s and τ, the functions that the error bound is about, and such that the data give.

use super::answer::OnMesh;
use super::part::Part;
use signorini_certify::cell::Cell;
use signorini_certify::curved;
use signorini_problem::field::CellField;
use signorini_problem::quadrature::enclosed::Integral;
use signorini_problem::quadrature::{gauss, mean_on_edge};
use signorini_problem::{EdgeKind, Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::scene::{Condition, Field};
use std::collections::BTreeSet;

/// Part of their size that the quadrature of smooth data may miss.
pub(super) const INTEGRATED: f64 = 2e-9;

/// Part of loads that counts as resolved, twice.
const RESOLVED: f64 = 2e-13;

/// The value of an output, and what it may be off beside the error of s and τ.
#[derive(Debug, Clone, Copy)]
pub(super) struct Value {
    /// The value.
    pub value: f64,
    /// The size of what it is summed from: data are integrated up to a part of it.
    pub terms: f64,
    /// The size of all numbers of its kind: the solver's scalar rounds next to it.
    pub largest: f64,
}

/// A mean over a part of the boundary, or a flux through it, that the data give: over D or through N. Nothing for others.
pub(super) fn given(problem: &Problem, part: &Part, field: Field) -> Result<Value> {
    let [mut value, mut terms] = [0.0; 2];
    for edge in part.edges() {
        let Some(data) = Sum::on_edge(problem, edge, field) else { continue };
        let [of_edge, size] = integral(problem, edge, &data)?;
        (value, terms) = (value + of_edge, terms + size);
    }
    if field == Field::Value {
        (value, terms) = (value / part.length(), terms / part.length());
    }
    Ok(Value { value, terms, largest: 0.0 })
}

/// ∫_E of data, on parts of the edge where they are not smooth, and of their modulus, which what is in doubt adds to.
fn integral(problem: &Problem, edge: usize, data: &Sum) -> Result<[f64; 2]> {
    let (segment, length) = (problem.segment(edge), problem.lengths[edge]);
    if let Some(constant) = data.constant() {
        return Ok([constant, constant.abs()].map(|x| length * x));
    }
    let Integral { value, missed } = data.mean_and_missed(segment)?;
    let size = mean_on_edge(segment, |x, y| data.at(x, y).abs());
    Ok([length * value, length * (size + missed / INTEGRATED)])
}

/// Doubt in the integrals of f, of given fluxes and of the ends of fluxes on C: what is missed, and rounding.
pub(super) fn doubt(problem: &Problem) -> f64 {
    let loads = &problem.loads;
    let cells = loads.triangles.iter().chain(&loads.quads).chain(&loads.contact_flux);
    let given = loads.neumann.iter().map(|record| &record.flux);
    loads.missed + RESOLVED * cells.chain(given).map(|load| load.abs()).sum::<f64>()
}

/// Sum of the loads of cells and of the fluxes through N that τ leaves: rounding. A cell that stores u keeps what it lacks (`stored`).
pub(super) fn imbalance(OnMesh { problem, answer, .. }: &OnMesh) -> f64 {
    let tau = &answer.certified.tau;
    let surplus =
        |at: usize| CellField::new(problem, at, tau, tau).surplus(problem.loads.of_cell(at), &[]);
    let step = problem.loads.step.as_ref();
    let mut keeps = vec![false; problem.cells()];
    if let Some(step) = step {
        keeps.iter_mut().zip(step.contents()).for_each(|(keeps, content)| *keeps = content > 0.0);
    }
    let cells: f64 = (0..keeps.len()).filter(|&at| !keeps[at]).map(|at| surplus(at).abs()).sum();
    let mut given = vec![0.0; problem.ends.len()];
    problem.loads.neumann.iter().for_each(|record| given[record.edge as usize] = record.flux);
    let on_neumann = (0..given.len()).filter(|&edge| problem.kinds[edge] == EdgeKind::Neumann);
    cells + on_neumann.map(|edge| (tau[edge] - given[edge]).abs()).sum::<f64>()
}

/// The mean of s over a part of the boundary. Where s follows data above their chord, theirs is integrated as the loads are.
pub(super) fn mean(on: &OnMesh, part: &Part) -> Result<Value> {
    let OnMesh { problem, answer, deviations } = on;
    let s = answer.certified.admissible();
    let [mut sum, mut terms] = [0.0; 2];
    for edge in part.edges() {
        let [a, b] = problem.ends[edge].map(|vertex| s.vertices[vertex as usize]);
        let above = deviations.on(edge).map_or(Ok(0.0), |deviation| deviation.mean())?;
        let bubble = 2.0 / 3.0 * s.bubbles[edge];
        sum += problem.lengths[edge] * (0.5 * (a + b) + bubble + above);
        terms += problem.lengths[edge] * (a.abs() + b.abs() + bubble.abs() + above.abs());
    }
    let length = part.length();
    Ok(Value { value: sum / length, terms: terms / length, largest: largest(s.vertices) })
}

pub(super) fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

/// Σ_T w_T s̄_T for weights of the cells, s̄_T the mean of s over one.
pub(super) fn inside(on: &OnMesh, weights: &[f64]) -> Result<Value> {
    let OnMesh { problem, answer, deviations } = on;
    let s = answer.certified.admissible();
    let lifted: BTreeSet<usize> =
        deviations.found.iter().map(|of| problem.topology.first_side(of.edge).0).collect();
    let [mut value, mut terms] = [0.0; 2];
    for (at, weight) in weights.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
        let (cell, on_cell) = (Cell::of(problem, at), s.on_cell(problem, at, deviations));
        let points = match lifted.contains(&at) {
            true => curved::points_along_sides(problem, at, deviations, &gauss(curved::POINTS))?,
            // Of degree 3 in each direction, with the area element.
            false => cell.points(&gauss(2)),
        };
        let [mut sum, mut size, mut area] = [0.0; 3];
        for point in points {
            let here = on_cell.at(&cell.local(point.reference))?.value;
            (sum, size) = (sum + point.weight * here, size + point.weight * here.abs());
            area += point.weight;
        }
        (value, terms) = (value + weight * sum / area, terms + weight * size / area);
    }
    Ok(Value { value, terms, largest: largest(s.vertices) })
}

/// ∫τ·n over a part of the boundary; as a force, from the ends that it is measured from. Through N the data give it.
pub(super) fn flux(on: &OnMesh, part: &Part, is_force: bool) -> Result<Value> {
    let OnMesh { problem, answer, .. } = on;
    let [mut value, mut terms] = [0.0; 2];
    for edge in part.edges() {
        if let (EdgeKind::Neumann, false) = (problem.kinds[edge], is_force) {
            let data = Sum::on_edge(problem, edge, Field::Flux);
            let [given, size] = data.map_or(Ok([0.0; 2]), |data| integral(problem, edge, &data))?;
            (value, terms) = (value + given, terms + size);
            continue;
        }
        let flux = answer.certified.tau[edge];
        let (direction, [end, size]) = match is_force {
            true if problem.kinds[edge] != EdgeKind::Contact => continue,
            true => end(problem, edge)?,
            false => (1.0, [0.0; 2]),
        };
        value += direction * (flux - end);
        terms += flux.abs() + size;
    }
    Ok(Value { value, terms, largest: largest(&answer.certified.tau) })
}

/// 1 where the force on a boundary is measured from its least flux, −1 where it has none, and it is the way to its limit.
pub(super) fn direction(problem: &Problem, table: usize) -> f64 {
    let Condition::Contact { flux, .. } = &problem.scene.boundaries[table].condition else {
        return 0.0;
    };
    if flux.value.is_constant() == Some(f64::NEG_INFINITY) { -1.0 } else { 1.0 }
}

/// The direction of the force on a contact edge, and ∫_E of the end that it is measured from, with its size.
pub(super) fn end(problem: &Problem, edge: usize) -> Result<(f64, [f64; 2])> {
    let table = problem.binding.boundary(problem.ends[edge]);
    let direction = table.map_or(0.0, |table| direction(problem, table));
    let field = if direction > 0.0 { Field::Flux } else { Field::Limit };
    let Some(end) = Sum::on_edge(problem, edge, field) else {
        return Ok((direction, [0.0; 2]));
    };
    Ok((direction, integral(problem, edge, &end)?))
}
