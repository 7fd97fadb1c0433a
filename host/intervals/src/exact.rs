//! The value of an output for the exact solution, where a scene has one.

use super::part::Part;
use super::values::end;
use signorini_certify::cell::Cell;
use signorini_certify::conductivity::{Conductivity, apply, dot};
use signorini_kernel::mesh::geometry::scaled_normal;
use signorini_problem::functional::{Functional, of_cells};
use signorini_problem::pointwise::exact_at;
use signorini_problem::quadrature::bisected::graded_mean;
use signorini_problem::quadrature::{gauss, on_panels};
use signorini_problem::{EdgeKind, Problem};
use signorini_scene::error::Result;
use signorini_scene::scene::{Exact, Output, Quantity};

/// Panels a direction of a cell, and points on each: u may have kinks inside.
const PANELS: u32 = 8;
const POINTS: usize = 8;

/// Exact value of a force, a flux, a mean, or of the mean over the cell of a probe, and by how much its quadrature is in doubt.
///
/// # Errors
/// An exact solution that is not finite in the middle of a cell.
pub(super) fn value(problem: &Problem, exact: &Exact, output: &Output) -> Result<[f64; 2]> {
    let part = Part::new(problem, output);
    let is_force = output.quantity == Quantity::Force;
    let sum = |all: [f64; 2], of: [f64; 2]| [all[0] + of[0], all[1] + of[1]];
    match output.quantity {
        Quantity::Probe { .. } => Ok([over_cell(problem, exact, output)?, 0.0]),
        Quantity::MeanInside | Quantity::Content => over_cells(problem, exact, output),
        Quantity::Mean => {
            let all = part.edges().map(|edge| of_u(problem, exact, edge)).fold([0.0; 2], sum);
            Ok(all.map(|x| x / part.length()))
        }
        _ => part
            .edges()
            .try_fold([0.0; 2], |all, edge| Ok(sum(all, of_flux(problem, exact, edge, is_force)?))),
    }
}

/// ∫_E u
fn of_u(problem: &Problem, exact: &Exact, edge: usize) -> [f64; 2] {
    let u = |x: f64, y: f64| exact.u.value.eval(x, y, problem.time);
    graded_mean(problem.segment(edge), &u).map(|mean| problem.lengths[edge] * mean)
}

/// ∫_E (A∇u)·n, as a force from the end that it is measured from.
fn of_flux(problem: &Problem, exact: &Exact, edge: usize, is_force: bool) -> Result<[f64; 2]> {
    let segment @ [a, b] = problem.segment(edge);
    let normal: [f64; 2] = scaled_normal(a, b).into();
    let (cell, _) = problem.topology.first_side(edge);
    let conductivity = Conductivity::of(problem, cell);
    let along = |x: f64, y: f64| {
        let gradient = [0, 1].map(|k| exact.gradient[k].value.eval(x, y, problem.time));
        dot(apply(&conductivity.at([x, y]), gradient), normal)
    };
    let [flux, doubt] = graded_mean(segment, &along);
    Ok(match is_force {
        false => [flux, doubt],
        true if problem.kinds[edge] != EdgeKind::Contact => [0.0; 2],
        true => {
            let (direction, [end, _]) = end(problem, edge)?;
            [direction * (flux - end), doubt]
        }
    })
}

/// The mean over the cell of a probe.
fn over_cell(problem: &Problem, exact: &Exact, output: &Output) -> Result<f64> {
    let Functional::Probe(at, _) = Functional::of(problem, output)? else { return Ok(f64::NAN) };
    mean(problem, exact, at, &on_panels(PANELS, &gauss(POINTS)))
}

/// Σ_T w_T ū_T, and by how much rules of [`POINTS`] and half as many points a direction differ in it.
fn over_cells(problem: &Problem, exact: &Exact, output: &Output) -> Result<[f64; 2]> {
    let [mut value, mut doubt] = [0.0; 2];
    let rules = [POINTS, POINTS / 2].map(gauss);
    for (at, weight) in of_cells(problem, output).into_iter().enumerate() {
        if weight != 0.0 {
            let [fine, coarse] = [0, 1].map(|rule| mean(problem, exact, at, &rules[rule]));
            let fine = fine?;
            value += weight * fine;
            doubt += weight * (fine - coarse?).abs();
        }
    }
    Ok([value, doubt])
}

/// The mean over a cell.
fn mean(problem: &Problem, exact: &Exact, at: usize, rule: &[[f64; 2]]) -> Result<f64> {
    let cell = Cell::of(problem, at);
    let [mut sum, mut area] = [0.0; 2];
    for point in cell.points(rule) {
        sum += point.weight * exact_at(&problem.scene, exact, point.x, problem.time)?.0;
        area += point.weight;
    }
    Ok(sum / area)
}
