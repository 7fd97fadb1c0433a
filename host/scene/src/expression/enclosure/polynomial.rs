//! Polynomials of degree 2 in the reference coordinates, over the reference shapes.
//!
//! ```text
//!   segment   ξ ∈ [−1, 1]             quad   (ξ, η) ∈ [−1, 1]²            triangle   ξ = λ₁ − ⅓, η = λ₂ − ⅓
//! ```
//! Each monomial is at most 1 on each of them. Coordinates of a triangle are those of its centroid, and its ranges are hulls of
//! Bernstein coefficients: nothing is asked of the parallelogram around it.

use super::function::ULP;
use super::interval::Interval;

/// Coefficients of 1, ξ, η, ξ², ξη, η².
pub(super) type Polynomial = [f64; 6];

/// Shapes that reference coordinates run through.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// ξ alone.
    Segment,
    /// The centred barycentric coordinates of the second and third corner.
    Triangle,
    /// Both from −1 to 1.
    Quad,
}

/// Reference coordinates of a triangle's corners.
pub(super) const CORNERS: [[f64; 2]; 3] =
    [[-1.0 / 3.0, -1.0 / 3.0], [2.0 / 3.0, -1.0 / 3.0], [-1.0 / 3.0, 2.0 / 3.0]];

/// The value at reference coordinates.
pub(super) fn value(p: &Polynomial, [x, y]: [f64; 2]) -> f64 {
    p[0] + x * (p[1] + x * p[3] + y * p[4]) + y * (p[2] + y * p[5])
}

/// Σ|pᵢ|, not less than the modulus anywhere.
pub(super) fn size(p: &Polynomial) -> f64 {
    p.iter().map(|p| p.abs()).sum()
}

/// An interval that holds all values on a shape, rounding included.
pub(super) fn range(shape: Shape, p: &Polynomial) -> Interval {
    let [least, most] = match shape {
        Shape::Triangle => of_triangle(p),
        Shape::Segment | Shape::Quad => {
            let ([a, b], [c, d]) = (parabola(p[1], p[3]), parabola(p[2], p[5]));
            [p[0] + a + c - p[4].abs(), p[0] + b + d + p[4].abs()]
        }
    };
    let slack = 8.0 * ULP * size(p);
    Interval::new(least - slack, most + slack)
}

/// Least and greatest value of at + bt² for |t| ≤ 1.
fn parabola(a: f64, b: f64) -> [f64; 2] {
    let ends = [b - a.abs(), b + a.abs()];
    if a.abs() >= 2.0 * b.abs() {
        return ends;
    }
    let vertex = -0.25 * a * (a / b);
    [ends[0].min(vertex), ends[1].max(vertex)]
}

/// Least and greatest Bernstein coefficient: values in the corners p_i, and 2p(m_ij) − ½(p_i + p_j) of the sides' middles.
fn of_triangle(p: &Polynomial) -> [f64; 2] {
    let corners = CORNERS.map(|at| value(p, at));
    let sides = [0, 1, 2].map(|k| {
        let (a, b) = (CORNERS[k], CORNERS[(k + 1) % 3]);
        let middle = value(p, [0, 1].map(|k| 0.5 * (a[k] + b[k])));
        2.0 * middle - 0.5 * (corners[k] + corners[(k + 1) % 3])
    });
    let all = corners.into_iter().chain(sides);
    all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], b| [low.min(b), high.max(b)])
}

/// The part of a product up to degree 2, and what holds the rest of it on a shape.
pub(super) fn product(shape: Shape, a: &Polynomial, b: &Polynomial) -> (Polynomial, Interval) {
    let mut kept = [0.0; 6];
    for k in 0..6 {
        kept[k] = a[0] * b[k] + if k == 0 { 0.0 } else { a[k] * b[0] };
    }
    kept[3] += a[1] * b[1];
    kept[4] += a[1] * b[2] + a[2] * b[1];
    kept[5] += a[2] * b[2];
    let parts = |p: &Polynomial| {
        let (linear, square) =
            ([0.0, p[1], p[2], 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, p[3], p[4], p[5]]);
        let is_affine = square == [0.0; 6];
        [range(shape, &linear), if is_affine { Interval::ZERO } else { range(shape, &square) }]
    };
    let ([a1, a2], [b1, b2]) = (parts(a), parts(b));
    let rest = a1 * b2 + a2 * b1 + a2 * b2;
    (kept, rest.widened(8.0 * ULP * size(a) * size(b)))
}
