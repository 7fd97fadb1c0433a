//! Rules for oscillations, and up to what they are resolved.

use crate::cell::Cell;
use signorini_problem::Sum;
use signorini_problem::quadrature::{Point, gauss};

/// Gauss points a direction on a cell, and a panel on an edge.
pub const POINTS: usize = 16;
/// Panels on an edge.
pub const PANELS: u32 = 4;
/// Ellipses in which continuations are looked at.
pub const ELLIPSES: [f64; 3] = [4.0, 2.0, 8.0];
/// Part of ‖f − f̄‖² up to which the rule is right.
pub const RESOLVED: f64 = 1e-13;
/// Part of Σ osc² that may be left on parts: 5 % of the oscillation.
pub const LEFT: f64 = 0.1;

/// f − f̄ at the points of the rule on a cell with the load ∫f, times a unit: squares of f may vanish or overflow where lengths are huge or
/// tiny, those of f times a length do not.
pub fn differences(cell: &Cell, f: &Sum, load: f64) -> (f64, Vec<(Point, f64)>) {
    let unit = cell.diameter().log2().round().exp2();
    let points = cell.points(&gauss(POINTS));
    let values = f.at_all(&points.iter().map(|point| point.x).collect::<Vec<_>>());
    let difference = |(point, value): (Point, f64)| {
        let mean = cell.spread(load, cell.determinant(point.reference));
        (point, unit * (value - mean))
    };
    (unit, points.into_iter().zip(values).map(difference).collect())
}
