//! Points inside a cell for what its extensions make as rough as their edges' data.

use super::cross::{between_rays, between_smooth_rays, of_square};
use super::panels::Panels;
use super::{FINE, POINTS};
use crate::cell::Cell;
use crate::deviation::Deviations;
use signorini_problem::Problem;
use signorini_problem::quadrature::{Point, gauss, on_panels};
use signorini_scene::error::Result;

/// The points of `rule`'s square on cell `at` (triangles first); where data on its sides need finer panels than
/// smooth ones, the points of those.
///
/// # Errors
/// Data that are not finite.
pub fn points(
    problem: &Problem,
    at: usize,
    deviations: &Deviations,
    rule: &[[f64; 2]],
) -> Result<Vec<Point>> {
    points_or(problem, at, deviations, rule, |_| None)
}

/// Points for products of what sides carry inside: on triangles those of smooth data lie along rays from the apices of their
/// sides, where these functions are polynomials.
///
/// # Errors
/// Data that are not finite.
pub fn points_along_sides(
    problem: &Problem,
    at: usize,
    deviations: &Deviations,
    rule: &[[f64; 2]],
) -> Result<Vec<Point>> {
    points_or(problem, at, deviations, rule, |cell| {
        let of_cell = deviations.of_cell(problem, at);
        let sides: Vec<usize> = (0..of_cell.len()).filter(|&k| of_cell[k].is_some()).collect();
        Some(match (cell, &sides[..]) {
            (_, []) => return None,
            (Cell::Triangle(_), [side]) => {
                on_side(cell, *side, &on_panels(FINE, &gauss(POINTS)), rule)
            }
            (Cell::Triangle(_), [one, other, ..]) => between_smooth_rays([*one, *other]),
            (Cell::Quad(_), sides) => {
                let panels = Panels::regular();
                of_square(sides.iter().map(|&side| (side, &panels)))
            }
        })
    })
}

/// The points for rough data; for others those that `smooth` tells, or the square of `rule`.
fn points_or(
    problem: &Problem,
    at: usize,
    deviations: &Deviations,
    rule: &[[f64; 2]],
    smooth: impl FnOnce(&Cell) -> Option<ReferencePoints>,
) -> Result<Vec<Point>> {
    let cell = Cell::of(problem, at);
    let rough = of_rough_sides(problem, at, std::slice::from_ref(deviations), rule)?;
    let Some(found) = rough.or_else(|| smooth(&cell)) else { return Ok(cell.points(rule)) };
    let point = |(reference, weight)| {
        let local = cell.local(reference);
        Point { x: local.x, reference, weight: weight * local.determinant }
    };
    Ok(found.into_iter().map(point).collect())
}

/// Reference coordinates, and weights that lack the area element.
pub type ReferencePoints = Vec<([f64; 3], f64)>;

/// Reference points with weights that lack the area element, on cell `at`; `None` where smooth data's points will do
/// for `all` data on its sides.
///
/// # Errors
/// Data that are not finite.
pub fn of_rough_sides(
    problem: &Problem,
    at: usize,
    all: &[Deviations],
    rule: &[[f64; 2]],
) -> Result<Option<ReferencePoints>> {
    let cell = Cell::of(problem, at);
    let mut sides: Vec<(usize, Panels)> = Vec::new();
    for deviations in all {
        for (side, deviation) in deviations.of_cell(problem, at).into_iter().enumerate() {
            let Some(deviation) = deviation else { continue };
            let panels = Panels::along(deviation)?;
            match sides.iter_mut().find(|(other, _)| *other == side) {
                Some((_, known)) => *known = known.clone().with(&panels.ends),
                None => sides.push((side, panels)),
            }
        }
    }
    // Squares and products have twice the waves of the data.
    let is_rough = sides.iter().any(|(_, panels)| !panels.is_regular());
    if is_rough {
        sides.iter_mut().for_each(|(_, panels)| *panels = panels.clone().halved());
    }
    // The roughest first: the third side of a triangle has no panels of its own.
    sides.sort_by_key(|(_, panels)| std::cmp::Reverse(panels.ends.len()));
    Ok(Some(match (&cell, &sides[..]) {
        _ if !is_rough => return Ok(None),
        (Cell::Triangle(_), [(one, panels), (other, others), ..]) => {
            between_rays([*one, *other], [panels, others])
        }
        (Cell::Triangle(_), sides) => sides
            .iter()
            .flat_map(|(side, panels)| on_side(&cell, *side, &panels.rule(), rule))
            .collect(),
        (Cell::Quad(_), sides) => of_square(sides.iter().map(|(side, panels)| (*side, panels))),
    }))
}

/// The points along one side of a triangle times `rule` away from it, collapsed at the apex.
pub fn on_side(
    cell: &Cell,
    side: usize,
    along: &[[f64; 2]],
    rule: &[[f64; 2]],
) -> Vec<([f64; 3], f64)> {
    let point = |[t, weight]: [f64; 2], [eta, away]: [f64; 2]| {
        (cell.side_point(side, t, eta), weight * away * (1.0 - eta))
    };
    along.iter().flat_map(|&along| rule.iter().map(move |&away| point(along, away))).collect()
}
