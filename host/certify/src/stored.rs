//! What cells store in a step of time, as its certificate takes it.

use std::f64::consts::PI;

use signorini_bound::certificate::StoredCell;

use super::cell::Cell;
use super::conductivity::{Conductivity, product, smallest_eigenvalue};
use super::weighed::minus;
use signorini_kernel::Tensor;
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
    let k = content.wide() / area;
    let stiffness = stiffness(problem, at, (&cell, tilt == [0.0; 2]));
    // Rounded up: a narrowed number may be the smaller one.
    let up = |x: f64| R::narrow(x * (1.0 + 4.0 * R::EPSILON.wide()));
    StoredCell {
        content,
        spread: up(spread),
        tilt: tilt.map(R::narrow),
        skew: up(skew),
        shed: up(k / (k + stiffness)),
        loose: up(k / stiffness),
        keep: R::narrow(keep),
    }
}

/// μ such that μ‖e − ē‖² ≤ ‖A^½∇e‖² on a cell, ē the mean of e: Poincaré's inequality on a convex cell, μ = π²α/h² with its diameter h;
/// or that of the unit square and of half of it, for both of which μ = π², in the coordinates x̂ of a parallelogram or a triangle:
/// ```text
///   x = a + F x̂,     μ = π² λ_min(F⁻¹AF⁻ᵀ)
/// ```
/// Each corner of a triangle may be a.
fn stiffness(problem: &Problem, at: usize, (cell, is_affine): (&Cell, bool)) -> f64 {
    let h = cell.diameter();
    let conductivity = Conductivity::of(problem, at);
    let floors = conductivity.floors();
    let by_diameter = conductivity.alpha() / (h * h);
    let in_coordinates = |[a, b, c]: [[f64; 2]; 3]| {
        let [p, q] = [minus(b, a), minus(c, a)];
        let determinant = p[0] * q[1] - p[1] * q[0];
        // The rows of F⁻¹.
        let [m, n] = [[q[1], -q[0]], [-p[1], p[0]]].map(|row| row.map(|x| x / determinant));
        let least = floors.iter().map(|floor| {
            let [xx, xy, yy] = [product(floor, m, m), product(floor, m, n), product(floor, n, n)];
            smallest_eigenvalue(&Tensor { xx, xy, yy })
        });
        least.fold(f64::INFINITY, f64::min)
    };
    let best = match *cell {
        Cell::Triangle([a, b, c]) => {
            let corners = [[a, b, c], [b, c, a], [c, a, b]];
            corners.map(in_coordinates).into_iter().fold(by_diameter, f64::max)
        }
        Cell::Quad([a, b, _, d]) if is_affine => by_diameter.max(in_coordinates([a, b, d])),
        Cell::Quad(_) => by_diameter,
    };
    PI * PI * best
}

/// The area, [spread, skew] and tilt of a cell.
fn shape(cell: &Cell) -> (f64, [f64; 2], [f64; 2]) {
    let Cell::Quad(_) = cell else {
        let twice = cell.determinant([1.0 / 3.0; 3]);
        return (0.5 * twice, [1.0, 0.0], [0.0; 2]);
    };
    let element = |x: f64, y: f64| cell.determinant([x, y, 0.0]);
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
