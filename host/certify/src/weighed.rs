//! Terms of a distance at a point, each with the sum of the sizes that its rounding is a part of.

use signorini_kernel::Tensor;

use super::conductivity::{apply, inverse, product};

/// Roundings of an expression and of a difference of two.
pub const FEW: f64 = 16.0 * f64::EPSILON;

/// An integral, and what its rounding is a part of: Σ weight·|terms|.
pub type Weighed = [f64; 2];

pub(crate) fn plus([a, size]: Weighed, [b, more]: Weighed) -> Weighed {
    [a + b, size + more]
}

/// 2w·(a − b)(c − d)
pub fn twice(w: f64, [a, b]: [f64; 2], [c, d]: [f64; 2]) -> Weighed {
    let size = (a - b).abs() * (c.abs() + d.abs()) + (a.abs() + b.abs()) * (c - d).abs();
    [2.0 * w * (a - b) * (c - d), 2.0 * w * size]
}

/// |A^½(∇u − ∇S)|² + |A^{−½}(A∇u − τ)|² at a point.
pub fn in_cell(a: &Tensor<f64>, u: [f64; 2], s: [f64; 2], tau: [f64; 2]) -> f64 {
    let (error, flux_error) = (minus(u, s), minus(apply(a, u), tau));
    product(a, error, error) + product(&inverse(a), flux_error, flux_error)
}

/// Σ|terms| that the rounding of [`in_cell`] is a part of.
pub fn size_in_cell(a: &Tensor<f64>, u: [f64; 2], s: [f64; 2], tau: [f64; 2]) -> f64 {
    let size = |v: [f64; 2], w: [f64; 2]| [0, 1].map(|k| v[k].abs() + w[k].abs());
    let all = |a: &Tensor<f64>| Tensor { xx: a.xx, xy: a.xy.abs(), yy: a.yy };
    let one = |a: &Tensor<f64>, v: [f64; 2], w: [f64; 2]| {
        2.0 * product(&all(a), minus(v, w).map(f64::abs), size(v, w))
    };
    one(a, u, s) + one(&inverse(a), apply(a, u), tau)
}

/// h(u − S)² + ((σ − τ)·n)²/h at a point of the Robin boundary.
pub fn on_robin(h: f64, error: f64, flux_error: f64) -> f64 {
    let square = h * error * error;
    if h > 0.0 { square + flux_error * flux_error / h } else { square }
}

/// v − w
pub fn minus(v: [f64; 2], w: [f64; 2]) -> [f64; 2] {
    [v[0] - w[0], v[1] - w[1]]
}
