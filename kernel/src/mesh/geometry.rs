//! Areas, sides and convexity of cells.

use nalgebra::Vector2;

use crate::Real;
use crate::error::{CellId, Error};
use crate::index::read;

/// |E| n: the side from `a` to `b` turned clockwise, outward where the cell runs counterclockwise.
pub fn scaled_normal<R: Real>(a: [R; 2], b: [R; 2]) -> Vector2<R> {
    Vector2::new(b[1] - a[1], a[0] - b[0])
}

/// Twice the signed area of the triangle abc, positive when it runs counterclockwise.
pub fn doubled_area<R: Real>(a: [R; 2], b: [R; 2], c: [R; 2]) -> R {
    (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
}

/// The area of a triangle.
pub fn triangle_area<R: Real>([a, b, c]: [[R; 2]; 3]) -> R {
    R::HALF * doubled_area(a, b, c)
}

/// The area of a quad: half the cross product of its diagonals.
pub fn quad_area<R: Real>([a, b, c, d]: [[R; 2]; 4]) -> R {
    R::HALF * ((c[0] - a[0]) * (d[1] - b[1]) - (d[0] - b[0]) * (c[1] - a[1]))
}

/// How a corner turns: the sign of `doubled_area`, zero where rounding hides it.
///
/// The two products are each off by at most a few ε of themselves; a difference below that says
/// nothing about the corner.
fn turn<R: Real>(a: [R; 2], b: [R; 2], c: [R; 2]) -> R {
    let left = (b[0] - a[0]) * (c[1] - a[1]);
    let right = (c[0] - a[0]) * (b[1] - a[1]);
    let slack = (R::TWO + R::TWO) * R::EPSILON * (left.magnitude() + right.magnitude());
    let area = left - right;
    if area > slack {
        R::ONE
    } else if -area > slack {
        -R::ONE
    } else {
        R::ZERO
    }
}

/// Every corner of a strictly convex counterclockwise polygon turns left.
pub(crate) fn check_corners<R: Real>(corners: &[[R; 2]], id: CellId) -> Result<(), Error> {
    let n = corners.len();
    let corner = |k: usize| read(corners, k % n);
    let turns = |k| turn(corner(k), corner(k + 1), corner(k + 2));
    let (mut left, mut right) = (0, 0);
    for k in 0..n {
        let direction = turns(k);
        left += usize::from(direction > R::ZERO);
        right += usize::from(direction < R::ZERO);
    }
    if left == n {
        Ok(())
    } else if right == n {
        Err(Error::Clockwise(id))
    } else if left + right == 0 || n == 3 {
        Err(Error::Degenerate(id))
    } else {
        Err(Error::NotConvex(id))
    }
}
