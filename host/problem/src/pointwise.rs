//! The exact solution of a scene at a point.

use crate::quadrature::Point;
use signorini_scene::error::{Error, Result};
use signorini_scene::expression::Expression;
use signorini_scene::scene::{Exact, Located, Scene};

/// Points a direction.
pub const POINTS: usize = 16;

/// Cells from which on fewer will do: those with a kink or a singular place of u are then a small part.
const MANY: usize = 20_000;

/// Points a direction on a mesh of so many cells.
pub fn points_on(cells: usize) -> usize {
    if cells < MANY { POINTS } else { POINTS / 2 }
}

/// u and ∇u of the exact solution at a point and a time.
///
/// # Errors
/// A value that is not finite.
pub fn exact_at(
    scene: &Scene,
    exact: &Exact,
    [x, y]: [f64; 2],
    time: f64,
) -> Result<(f64, [f64; 2])> {
    let value = |key: &Located<Expression>| {
        let value = key.value.eval(x, y, time);
        if value.is_finite() {
            return Ok(value);
        }
        let message = format!("not finite at ({x}, {y})");
        Err(Error::from(scene.error(key, message).hint("see [exact]")))
    };
    let [along_x, along_y] = &exact.gradient;
    Ok((value(&exact.u)?, [value(along_x)?, value(along_y)?]))
}

/// Values of the exact solution at many points of cells.
///
/// # Errors
/// A value that is not finite.
pub fn exact_at_all(
    scene: &Scene,
    exact: &Exact,
    points: &[Point],
    time: f64,
) -> Result<Vec<(f64, [f64; 2])>> {
    let places: Vec<[f64; 2]> = points.iter().map(|point| point.x).collect();
    let [along_x, along_y] = &exact.gradient;
    let [u, x, y] = [&exact.u, along_x, along_y].map(|key| key.value.eval_all(&places, time));
    let found = u.into_iter().zip(x.into_iter().zip(y)).map(|(u, (x, y))| (u, [x, y]));
    let is_finite = |(u, [x, y]): &(f64, [f64; 2])| u.is_finite() && x.is_finite() && y.is_finite();
    let found: Vec<_> = found.collect();
    // Which of them is not, and where.
    let is_off = found.iter().position(|of| !is_finite(of));
    is_off.map_or(Ok(()), |at| exact_at(scene, exact, places[at], time).map(drop))?;
    Ok(found)
}
