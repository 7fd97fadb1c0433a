//! Quadrature for squares of s and τ on a cell.

use signorini_certify::cell::Cell;
use signorini_certify::conductivity::Conductivity;
use signorini_certify::curved::{FINE, POINTS, between_smooth_rays};
use signorini_problem::quadrature::{DATA_POINTS, gauss, on_panels};

/// Points a direction that a cell needs where its boundary data are affine; gradients of bubbles are
/// of degree 2.
pub(super) fn points_for(cell: &Cell, conductivity: &Conductivity) -> usize {
    match cell {
        Cell::Triangle(_) if conductivity.is_constant() => 2,
        Cell::Quad(_) if conductivity.is_constant() && cell.is_affine() => 3,
        _ => DATA_POINTS,
    }
}

/// Reference coordinates with weights that lack the area element, with `rule` points a direction or,
/// where sides are `curved`, those that integrate what the sides carry inside.
pub(super) fn points(cell: &Cell, rule: usize, curved: &[usize]) -> Vec<([f64; 3], f64)> {
    let along = on_panels(FINE, &gauss(POINTS));
    match (cell, curved) {
        (Cell::Triangle(_), []) => on_triangle(cell, 0, &gauss(rule), &gauss(rule)),
        (Cell::Triangle(_), [side]) => on_triangle(cell, *side, &along, &gauss(POINTS)),
        (Cell::Triangle(_), [one, other, ..]) => between_smooth_rays([*one, *other]),
        (Cell::Quad(_), _) => {
            // Sides 0 and 2 run along x̂, 1 and 3 along ŷ.
            let axis = |parity: usize| match curved.iter().any(|side| side % 2 == parity) {
                true => along.clone(),
                false if curved.is_empty() => gauss(rule),
                false => gauss(POINTS),
            };
            square(&axis(0), &axis(1))
        }
    }
}

/// The points (t, η) of one side of a triangle.
fn on_triangle(
    cell: &Cell,
    side: usize,
    along: &[[f64; 2]],
    away: &[[f64; 2]],
) -> Vec<([f64; 3], f64)> {
    let point = |[t, weight]: [f64; 2], [eta, weight_away]: [f64; 2]| {
        (cell.side_point(side, t, eta), weight * weight_away * (1.0 - eta))
    };
    along.iter().flat_map(|&along| away.iter().map(move |&away| point(along, away))).collect()
}

fn square(along_x: &[[f64; 2]], along_y: &[[f64; 2]]) -> Vec<([f64; 3], f64)> {
    let point = |[x, wx]: [f64; 2], [y, wy]: [f64; 2]| ([x, y, 0.0], wx * wy);
    along_y.iter().flat_map(|&y| along_x.iter().map(move |&x| point(x, y))).collect()
}
