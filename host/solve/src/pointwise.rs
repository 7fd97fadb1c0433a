//! The exact solution of a scene at a point.

use signorini_scene::error::{Error, Result};
use signorini_scene::expression::Expression;
use signorini_scene::scene::{Exact, Located, Scene};

/// Points a direction.
pub const POINTS: usize = 16;

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
