//! Functions of a point, as values that scenes can hold and share.

use std::sync::Arc;

/// A point (x, y) of the plane, physical or of the reference cell.
pub type Point = [f64; 2];
/// A scalar function of a point.
pub type Scalar = Arc<dyn Fn(Point) -> f64 + Send + Sync>;
/// A vector function of a point.
pub type Vector = Arc<dyn Fn(Point) -> [f64; 2] + Send + Sync>;
/// A symmetric tensor [a_xx, a_xy, a_yy] as a function of a point.
pub type Tensor = Arc<dyn Fn(Point) -> [f64; 3] + Send + Sync>;

/// The identity tensor.
pub const IDENTITY: [f64; 3] = [1.0, 0.0, 1.0];

/// The function that has the same value everywhere.
pub fn constant(value: f64) -> Scalar {
    Arc::new(move |_| value)
}

/// (x, y) ↦ c + a x + b y.
pub fn affine(c: f64, a: f64, b: f64) -> Scalar {
    Arc::new(move |[x, y]| c + a * x + b * y)
}

/// The product A v of a symmetric tensor and a vector.
pub fn apply(a: [f64; 3], v: [f64; 2]) -> [f64; 2] {
    [a[0] * v[0] + a[1] * v[1], a[1] * v[0] + a[2] * v[1]]
}

/// The scalar product of two vectors.
pub fn dot(v: [f64; 2], w: [f64; 2]) -> f64 {
    v[0] * w[0] + v[1] * w[1]
}

/// The vector v − w.
pub fn minus(v: [f64; 2], w: [f64; 2]) -> [f64; 2] {
    [v[0] - w[0], v[1] - w[1]]
}
