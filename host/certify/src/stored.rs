//! What cells store in a step of time, as its certificate takes it.

use std::f64::consts::PI;

use signorini_bound::certificate::StoredCell;

use super::cell::Cell;
use super::oscillation::alpha;
use signorini_problem::quadrature::gauss;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Problem, Step};

/// Area elements that vary by less than this part of themselves are constant.
const CONSTANT: f64 = 1e-12;

/// Points per direction for the mean of the inverse of an area element.
const POINTS: usize = 16;

/// One per cell, triangles first; `keep` is the part of what a cell lacks of balance that it keeps where it hands on the rest.
pub fn stored_cells<R: Scalar>(
    problem: &Problem,
    step: &Step<R>,
    keep: &[f64],
) -> Vec<StoredCell<R>> {
    let cells = step.contents().zip(keep).enumerate();
    cells.map(|(at, (content, &keep))| stored(problem, at, content, keep)).collect()
}

fn stored<R: Scalar>(problem: &Problem, at: usize, content: R, keep: f64) -> StoredCell<R> {
    let cell = Cell::of(problem, at);
    let (area, [spread, skew], tilt) = shape(&cell);
    let (k, h) = (content.wide() / area, cell.diameter());
    let stiffness = PI * PI * alpha(problem, at) / (h * h);
    // Rounded up: a narrowed number may be the smaller one.
    let up = |x: f64| R::narrow(x * (1.0 + 4.0 * R::EPSILON.wide()));
    StoredCell {
        content,
        spread: up(spread),
        tilt: tilt.map(R::narrow),
        skew: up(skew),
        shed: up(k / (k + stiffness)),
        keep: R::narrow(keep),
    }
}

/// The area, [spread, skew] and tilt of a cell.
fn shape(cell: &Cell) -> (f64, [f64; 2], [f64; 2]) {
    let Cell::Quad(_) = cell else {
        let twice = cell.local([1.0 / 3.0; 3]).determinant;
        return (0.5 * twice, [1.0, 0.0], [0.0; 2]);
    };
    let element = |x: f64, y: f64| cell.local([x, y, 0.0]).determinant;
    // It is affine in x̂ and ŷ.
    let area = element(0.5, 0.5);
    let tilt = [element(1.0, 0.5) - element(0.0, 0.5), element(0.5, 1.0) - element(0.5, 0.0)]
        .map(|rise| rise / area);
    let most = 0.5 * (tilt[0].abs() + tilt[1].abs());
    if most <= CONSTANT {
        return (area, [1.0, 0.0], [0.0; 2]);
    }
    let rule = gauss(POINTS);
    let inverse = rule.iter().flat_map(|&[x, v]| rule.iter().map(move |&[y, w]| [x, y, v * w]));
    let inverse: f64 = inverse.map(|[x, y, weight]| weight * area / element(x, y)).sum();
    (area, [1.0 + most, (inverse - 1.0).max(0.0)], tilt)
}
