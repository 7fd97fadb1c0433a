//! Energy norms of the bound's S: how large it is, and how far the discontinuous u_h lies from it.
//!
//! ```text
//!   energy norm    (‖A^½∇S‖² + ∫_R h (S − u_ext)²)^½  what a bound is compared with
//!   nonconformity  ‖A^½∇_h(S − u_h)‖                  what the bound for u_h adds to that for S
//! ```
//! Neither changes where a constant is added to every datum of u: a bound is the same part of its norm in °C and in K.

use signorini_certify::admissible::Admissible;
use signorini_certify::cell::Cell;
use signorini_certify::conductivity::{Conductivity, product};
use signorini_certify::curved;
use signorini_certify::deviation::Deviations;
use signorini_certify::robin::robin;
use signorini_kernel::Real;
use signorini_problem::Problem;
use signorini_problem::field::CellField;
use signorini_problem::pointwise::POINTS;
use signorini_problem::quadrature::{DATA_POINTS, gauss};
use signorini_problem::threads::in_portions;
use signorini_scene::error::Result;

/// The energy norm of a solution's S; `None` where it has no bound, and S is a picture alone.
///
/// # Errors
/// Data that are not finite.
pub fn of_solution(problem: &Problem, solution: &crate::Solution) -> Result<Option<f64>> {
    if solution.bound.is_none() {
        return Ok(None);
    }
    if let Some((problem, own)) = solution.in_its_units() {
        return Ok(of_solution(problem, own)?.map(|norm| norm * solution.units.energy()));
    }
    norm(problem, &solution.certified.admissible()).map(Some)
}

/// The norm in words.
pub fn name(problem: &Problem) -> &'static str {
    match problem.loads.robin.is_empty() {
        true => "‖A^½∇s‖",
        false => "(‖A^½∇s‖² + ∫_R h (s − u_ext)²)^½",
    }
}

/// (‖A^½∇S‖² + ∫_R h (S − u_ext)²)^½ at the time of the problem.
///
/// # Errors
/// Data that are not finite.
pub fn norm(problem: &Problem, s: &Admissible) -> Result<f64> {
    let deviations = curved::followed(problem, s)?;
    let mut square = squares(problem, s, &deviations, None)?;
    let transfer = robin(problem)?;
    for (record, points) in problem.loads.robin.iter().zip(&transfer) {
        for (&[t, weight], [h, outside]) in f64::GAUSS[DATA_POINTS - 1].iter().zip(points) {
            let s = s.on_edge(problem, record.edge as usize, None, t)?;
            square += weight * h * (s - outside).powi(2);
        }
    }
    Ok(square.sqrt())
}

/// ‖A^½∇_h(S − u_h)‖ for the edge means `u`.
///
/// # Errors
/// Data that are not finite.
pub fn nonconformity(problem: &Problem, s: &Admissible, u: &[f64]) -> Result<f64> {
    let deviations = curved::followed(problem, s)?;
    Ok(squares(problem, s, &deviations, Some(u))?.sqrt())
}

/// Σ_T ∫_T |A^½∇(S − u_h)|², without `u` that of S alone.
fn squares(
    problem: &Problem,
    s: &Admissible,
    deviations: &Deviations,
    u: Option<&[f64]>,
) -> Result<f64> {
    let of_cell = |at| -> Result<f64> {
        let (cell, conductivity) = (Cell::of(problem, at), Conductivity::of(problem, at));
        let s = s.on_cell(problem, at, deviations);
        let field = u.map(|u| CellField::new(problem, at, u, u));
        let is_lifted = deviations.of_cell(problem, at).iter().any(Option::is_some);
        let rule = gauss(if is_lifted { POINTS } else { conductivity.points_for(&cell, 1) });
        let mut square = 0.0;
        let points = match conductivity.cut_for_curves() {
            Some(pieces) => pieces.many_points(cell).map(|of| of.point).collect(),
            None => curved::points(problem, at, deviations, &rule)?,
        };
        for point in points {
            let [x, y] = s.at(&cell.local(point.reference))?.gradient;
            let [of_x, of_y] = field.map_or([0.0; 2], |field| field.sample(&point).gradient);
            let difference = [x - of_x, y - of_y];
            square += point.weight * product(&conductivity.at(point.x), difference, difference);
        }
        Ok(square)
    };
    let sums = in_portions(problem.cells(), |mut cells| {
        cells.try_fold(0.0, |sum, at| Ok(sum + of_cell(at)?))
    })?;
    Ok(sums.iter().sum())
}
