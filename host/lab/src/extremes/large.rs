//! The true error with fewer points than the 16×16 per cell of [`signorini_certify::exact`].
//!
//! On large grids 4×4 inside: for solutions that are polynomials in each cell no point more is needed there. Where S follows curved boundary
//! data it is rational, and all points are taken. No Robin boundary.

use signorini_certify::admissible::Admissible;
use signorini_certify::cell::Cell;
use signorini_certify::conductivity::Conductivity;
use signorini_certify::curved::followed;
use signorini_certify::deviation::Lift;
use signorini_certify::weighed::in_cell;
use signorini_problem::Problem;
use signorini_problem::field::CellField;
use signorini_problem::pointwise::{POINTS, exact_at};
use signorini_problem::quadrature::gauss;
use signorini_scene::error::Result;
use signorini_scene::scene::Exact;

/// Points a direction inside of large grids.
pub const INSIDE: usize = 4;

/// (‖A^½∇(u − S)‖² + ‖A^{−½}(σ − τ)‖²)^½ with `points` a direction in cells without curved boundary data.
///
/// # Errors
/// An exact solution that is not finite at a quadrature point.
pub fn combined(
    exact: &Exact,
    problem: &Problem,
    admissible: &Admissible,
    points: usize,
) -> Result<f64> {
    let deviations = followed(problem, admissible)?;
    let (few, all, mut square) = (gauss(points), gauss(POINTS), 0.0);
    for at in 0..problem.cells() {
        let (cell, s) = (Cell::of(problem, at), admissible.on_cell(problem, at, &deviations));
        let conductivity = Conductivity::of(problem, at);
        // Of this field only the flux is read, so that any numbers do for the means of u.
        let tau = CellField::new(problem, at, admissible.tau, admissible.tau);
        let is_inside = Lift::on_cell(problem, at, &deviations).is_zero();
        for point in cell.points(if is_inside { &few } else { &all }) {
            let (_, u) = exact_at(&problem.scene, exact, point.x, problem.time)?;
            let s = s.at(&cell.local(point.reference))?.gradient;
            let a = conductivity.at(point.x);
            square += point.weight * in_cell(&a, u, s, tau.sample(&point).flux);
        }
    }
    Ok(square.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::extremes::grid::{Grid, Shape};
    use crate::extremes::measure::solve_directly;
    use crate::extremes::plan::cases;
    use signorini_certify::exact::distance;
    use signorini_scene::mesh::structured::Cells;
    use signorini_scene::scene::Scene;
    use signorini_tolerances::lab::FEW_POINTS;

    /// A cut-off solve would do as well: both integrate the same functions.
    #[test]
    fn as_many_points_as_a_polynomial_needs() {
        let mut posed = cases().into_iter().find(|case| case.axis == "cells").unwrap().posed;
        posed.grid = Grid { n: 6, cells: Cells::Triangles, shape: Shape::Square };
        let scene = Scene::parse(&posed.scene(), std::path::Path::new("test.toml")).unwrap();
        let problem = Problem::new(&scene, posed.mesh()).unwrap();
        let solution = solve_directly(&problem).unwrap();
        let (exact, admissible) = (scene.exact.as_ref().unwrap(), solution.certified.admissible());
        let few = combined(exact, &problem, &admissible, INSIDE).unwrap();
        let many = distance(exact, &problem, &admissible).unwrap().combined;
        FEW_POINTS.check_relative("norms", few, many);
    }
}
