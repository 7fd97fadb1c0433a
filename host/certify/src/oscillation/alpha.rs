//! How little A conducts in a cell.

use super::rules::POINTS;
use crate::cell::Cell;
use crate::conductivity::{Conductivity, smallest_eigenvalue};
use signorini_problem::Problem;
use signorini_problem::quadrature::gauss;

/// The smallest eigenvalue of A on a cell; where A varies, of A at the quadrature points.
pub fn alpha(problem: &Problem, at: usize) -> f64 {
    let (cell, a) = (Cell::of(problem, at), Conductivity::of(problem, at));
    if a.is_constant() {
        return smallest_eigenvalue(&a.at(cell.corners()[0]));
    }
    let points = cell.points(&gauss(POINTS)).into_iter();
    points.map(|point| smallest_eigenvalue(&a.at(point.x))).fold(f64::INFINITY, f64::min)
}
