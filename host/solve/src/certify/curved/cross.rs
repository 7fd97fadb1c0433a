//! Quadrature for products of two extensions into one cell, each as rough as its edge's data.

use super::POINTS;
use super::panels::Panels;
use crate::certify::cell::Cell;
use crate::quadrature::gauss;

/// Reference points with their weights, to be multiplied by the area element, for the extensions of `sides` of a cell
/// with panels along each.
pub(super) fn points(cell: &Cell, sides: [usize; 2], panels: [&Panels; 2]) -> Vec<([f64; 3], f64)> {
    let smooth = panels.iter().all(|panels| panels.is_regular());
    let [mine, its] = sides;
    match cell {
        Cell::Triangle(_) if smooth => {
            let (apices, along) = ([(mine + 2) % 3, (its + 2) % 3], panels[0].rule());
            let mut points = half_triangle(apices[0], apices[1], &along);
            points.extend(half_triangle(apices[1], apices[0], &along));
            points
        }
        Cell::Triangle(_) => between_rays(sides, panels),
        Cell::Quad(_) => of_square(sides.into_iter().zip(panels)),
    }
}

/// The half of a triangle at vertex `apex`, cut off by the median that parts it from vertex `other`.
///
/// The gradient of an extension depends on the direction in which one comes to its apex; collapsed
/// there, and with the other's apex in the other half, the integrand is as smooth as the data.
pub fn half_triangle(apex: usize, other: usize, along: &[[f64; 2]]) -> Vec<([f64; 3], f64)> {
    let third = 3 - apex - other;
    let away = gauss(POINTS);
    let point = |[t, along]: [f64; 2], [eta, weight]: [f64; 2]| {
        let mut lambda = [0.0; 3];
        lambda[third] = (1.0 - eta) * (1.0 - t);
        lambda[other] = (1.0 - eta) * 0.5 * t;
        lambda[apex] = (1.0 - eta) * 0.5 * t + eta;
        (lambda, 0.5 * along * weight * (1.0 - eta))
    };
    let rows = along.iter();
    rows.flat_map(|&along| away.iter().map(move |&away| point(along, away))).collect()
}

/// Ends of panels towards the corner in which all rays meet.
const GRADED: i32 = 16;

/// The points where a ray from one apex meets a ray from the other: kinks and layers lie along rays.
///
/// With a, b the sides' coordinates from their common vertex r, x = 1 − a, y = 1 − b, z = x + y − xy,
/// ```text
///   λ_r = xy/z    λ_q = ay/z    λ_p = bx/z    dλ_p dλ_q = xy/z³ da db
/// ```
/// where p, q are the apices of the first and the second side. The side pq is collapsed into x = y = 0.
pub(super) fn between_rays([mine, its]: [usize; 2], panels: [&Panels; 2]) -> Vec<([f64; 3], f64)> {
    let [p, q] = [(mine + 2) % 3, (its + 2) % 3];
    let r = 3 - p - q;
    // x and y run from an apex to r.
    let to_r = |panels: &Panels, side: usize| {
        let turned = if side == r { panels.reversed() } else { panels.clone() };
        let graded: Vec<f64> = (1..=GRADED).map(|k| 0.5_f64.powi(k)).collect();
        turned.with(&graded).rule()
    };
    let [along, across] = [to_r(panels[0], mine), to_r(panels[1], its)];
    let point = |[x, wx]: [f64; 2], [y, wy]: [f64; 2]| {
        let z = x + y - x * y;
        let mut lambda = [0.0; 3];
        (lambda[r], lambda[q], lambda[p]) = (x * y / z, (1.0 - x) * y / z, (1.0 - y) * x / z);
        (lambda, wx * wy * x * y / (z * z * z))
    };
    along.iter().flat_map(|&x| across.iter().map(move |&y| point(x, y))).collect()
}

/// The square of panels along x̂ and ŷ that hold those of sides of a quad.
pub(super) fn of_square<'p>(
    sides: impl Iterator<Item = (usize, &'p Panels)>,
) -> Vec<([f64; 3], f64)> {
    let mut axes = [Panels::regular(), Panels::regular()];
    for (side, panels) in sides {
        let turned = if side < 2 { panels.clone() } else { panels.reversed() };
        let axis = &mut axes[side % 2];
        *axis = axis.clone().with(&turned.ends);
    }
    let [along_x, along_y] = axes.map(|panels| panels.rule());
    let rows = along_y.iter();
    let square = rows.flat_map(|&[y, wy]| along_x.iter().map(move |&[x, wx]| (x, y, wx * wy)));
    square.map(|(x, y, weight)| ([x, y, 0.0], weight)).collect()
}
