//! The part of the distance that a bound over time is about.

use super::{EdgePoint, Integrands};
use crate::admissible::Admissible;
use crate::cell::Cell;
use crate::conductivity::{Conductivity, product};
use crate::curved;
use crate::sampled::{Lifted, Sampled, Solution};
use crate::weighed::{minus, on_robin};
use signorini_problem::{Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::scene::Exact;

/// ‖A^½∇(u − S)‖² + ∫_R h(u − S)² at the time of the problem.
///
/// # Errors
/// An exact solution or data that are not finite at a quadrature point.
pub fn in_energy(exact: &Exact, problem: &Problem, admissible: &Admissible) -> Result<f64> {
    let deviations = &curved::followed(problem, admissible)?;
    let (u, lift) = (&Solution { exact, problem }, &Lifted { problem, deviations });
    let of = Integrands { exact, problem, admissible, deviations, u, lift, panels: 1, fewer: 1 };
    let (mut square, rule) = (0.0, of.rule());
    for at in 0..problem.cells() {
        let (cell, conductivity) = (Cell::of(problem, at), Conductivity::of(problem, at));
        let s = admissible.on_cell(problem, at, deviations);
        let points = curved::points(problem, at, deviations, &rule)?;
        for (point, u) in points.iter().zip(u.on_cell(at, &points)?.iter()) {
            let own = s.at(&cell.local(point.reference))?.gradient;
            let error = minus(u.gradient, own);
            square += point.weight * product(&conductivity.at(point.x), error, error);
        }
    }
    for edge in 0..problem.kinds.len() {
        let Some(h) = Sum::transfer(problem, edge) else { continue };
        let term = |EdgePoint { x, weight, u, s, .. }: EdgePoint| {
            Ok([weight * on_robin(h.finite_at(x)?, u - s, 0.0), 0.0])
        };
        square += of.on_edge(edge, term)?[0];
    }
    Ok(square)
}
