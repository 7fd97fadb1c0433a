//! Quadrature for products of two extensions into one cell, each as rough as its edge's data.

use super::panels::Panels;
use super::{FINE, POINTS};
use crate::cell::Cell;
use signorini_problem::quadrature::{gauss, on_panels};

/// Reference points with their weights, to be multiplied by the area element, for the extensions of `sides` of a cell
/// with panels along each.
pub(super) fn points(cell: &Cell, sides: [usize; 2], panels: [&Panels; 2]) -> Vec<([f64; 3], f64)> {
    let smooth = panels.iter().all(|panels| panels.is_regular());
    match cell {
        Cell::Triangle(_) if smooth => between_smooth_rays(sides),
        Cell::Triangle(_) => between_rays(sides, panels),
        Cell::Quad(_) => of_square(sides.into_iter().zip(panels)),
    }
}

/// Points along the rays from both apices of a triangle, for data that are smooth on two of its sides.
///
/// As where rays of any panels meet, but y = xv in one half and x = yv in the other, which takes the singular corner away:
/// ```text
///   λ_r = xv/z    λ_q = (1 − x)v/z    λ_p = (1 − xv)/z    dλ_p dλ_q = v/z³ dx dv,    z = 1 + v − xv
/// ```
/// A product of both data has twice the waves of either: the panels are [`FINE`].
pub fn between_smooth_rays([mine, its]: [usize; 2]) -> Vec<([f64; 3], f64)> {
    let [p, q] = [(mine + 2) % 3, (its + 2) % 3];
    let rule = on_panels(FINE, &gauss(POINTS));
    let half = |[p, q]: [usize; 2]| {
        let point = move |[x, wx]: [f64; 2], [v, wv]: [f64; 2]| {
            let z = 1.0 + v - x * v;
            let mut lambda = [0.0; 3];
            (lambda[3 - p - q], lambda[q], lambda[p]) =
                (x * v / z, (1.0 - x) * v / z, (1.0 - x * v) / z);
            (lambda, wx * wv * v / (z * z * z))
        };
        rule.iter().flat_map(|&x| rule.iter().map(move |&v| point(x, v))).collect::<Vec<_>>()
    };
    [half([p, q]), half([q, p])].concat()
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
    square(&along_x, &along_y)
}

/// The points of a rule along x̂ times one along ŷ.
pub fn square(along_x: &[[f64; 2]], along_y: &[[f64; 2]]) -> Vec<([f64; 3], f64)> {
    let point = |[x, wx]: [f64; 2], [y, wy]: [f64; 2]| ([x, y, 0.0], wx * wy);
    along_y.iter().flat_map(|&y| along_x.iter().map(move |&x| point(x, y))).collect()
}
