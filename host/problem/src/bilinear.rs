//! The inverse of the bilinear map of a quad.

use signorini_kernel::element::rannacher_turek;

/// F⁻¹ on a convex quad by Newton's iteration from the middle; far outside it may not converge, and
/// then returns a point outside.
pub(super) fn inverse_bilinear(corners: [[f64; 2]; 4], x: [f64; 2]) -> [f64; 2] {
    let [a, b, c, d] = corners;
    let mut at = [0.5; 2];
    for _ in 0..30 {
        let here = rannacher_turek::place(corners, at).x;
        let along = |k: usize, t: f64| (b[k] - a[k]) * (1.0 - t) + (c[k] - d[k]) * t;
        let across = |k: usize, s: f64| (d[k] - a[k]) * (1.0 - s) + (c[k] - b[k]) * s;
        let (sx, sy) = (along(0, at[1]), along(1, at[1]));
        let (tx, ty) = (across(0, at[0]), across(1, at[0]));
        let (rx, ry) = (x[0] - here[0], x[1] - here[1]);
        let determinant = sx * ty - sy * tx;
        let step = [(rx * ty - ry * tx) / determinant, (sx * ry - sy * rx) / determinant];
        at = [at[0] + step[0], at[1] + step[1]];
        if step[0].abs().max(step[1].abs()) < 1e-14 || !at[0].is_finite() {
            break;
        }
    }
    at
}
