//! Random scenes: whatever the format allows, small enough to solve thousands of.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::sync::Arc;

use crate::field::{Point, Scalar, affine as plane};
use crate::grid::Grid;
use crate::problem::{Boundary, Problem};
pub use signorini_problem::random::Random;

/// c + a x + b y with coefficients of size 1.
pub fn affine(random: &mut Random) -> Scalar {
    let mut coefficient = || random.between(-1.0, 1.0);
    plane(coefficient(), coefficient(), coefficient())
}

/// How far a vertex may move, in mesh widths: below 1/4 every quad of a square grid stays convex
/// and both halves of a cut one keep their orientation.
const MOVE: f64 = 0.2;

/// A grid of 1 to `most` columns and rows with all vertices moved, each cell kept or cut by
/// either diagonal, and listed from any of its corners on.
pub fn grid(random: &mut Random, most: u32) -> Grid {
    let (columns, rows) = (1 + random.below(most), 1 + random.below(most));
    let width = 1.0 / f64::from(rows);
    let mut grid = Grid::default();
    for (i, j) in (0..=columns).flat_map(|i| (0..=rows).map(move |j| (i, j))) {
        let mut coordinate = |k: u32| width * (f64::from(k) + random.between(-MOVE, MOVE));
        grid.vertices.push([coordinate(i), coordinate(j)]);
    }
    for (i, j) in (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j))) {
        let a = i * (rows + 1) + j;
        let mut corners = [a, a + rows + 1, a + rows + 2, a + 1];
        corners.rotate_left(random.below(4) as usize);
        let [a, b, c, d] = corners;
        if random.below(2) == 0 {
            grid.quads.push(corners);
        } else {
            grid.triangles.extend([[b, c, a], [a, c, d]]);
        }
    }
    grid
}

/// A tensor with eigenvalues of 10^−2 … 10^2 and any axes: jumps between cells reach 10⁴.
pub fn tensor(random: &mut Random) -> [f64; 3] {
    let mut eigenvalue = || 10f64.powf(random.between(-2.0, 2.0));
    let (p, q) = (eigenvalue(), eigenvalue());
    let (sin, cos) = random.between(0.0, PI).sin_cos();
    [p * cos * cos + q * sin * sin, (p - q) * sin * cos, p * sin * sin + q * cos * cos]
}

/// A condition of any kind with affine data.
pub fn boundary(random: &mut Random) -> Boundary {
    match random.below(8) {
        0 => dirichlet(random),
        1 => Boundary::Neumann { flux: affine(random) },
        2 => {
            // Positive where the grids of this module lie: x, y ≥ −0.2.
            let coefficient = plane(random.between(1.0, 9.0), random.between(0.0, 1.0), 0.1);
            Boundary::Robin { coefficient, ambient: affine(random) }
        }
        _ => Boundary::Contact { gap: affine(random), flux: affine(random) },
    }
}

fn dirichlet(random: &mut Random) -> Boundary {
    Boundary::Dirichlet { value: affine(random) }
}

/// A scene with one tensor and one affine source for each cell, and a condition for each boundary
/// edge, of which at least one is Dirichlet, so that there is exactly one solution.
pub fn problem(random: &mut Random, most: u32) -> Problem {
    let grid = grid(random, most);
    let tensors: Vec<_> = (0..grid.cell_count()).map(|_| tensor(random)).collect();
    let sources: Vec<_> = (0..grid.cell_count()).map(|_| affine(random)).collect();
    let edges = grid.boundary();
    let mut conditions: BTreeMap<_, _> = edges.iter().map(|&e| (e, boundary(random))).collect();
    conditions.insert(edges[random.below(edges.len() as u32) as usize], dirichlet(random));
    Problem {
        grid,
        tensor: Arc::new(move |cell, _: Point| tensors[cell]),
        source: Arc::new(move |cell, p| sources[cell](p)),
        boundary: conditions,
        order: 8,
    }
}
