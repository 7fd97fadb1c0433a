//! The nonparametric Rannacher–Turek quad: span{1, X, Y, X² − Y²} in affine coordinates of the cell
//! itself, with edge means as degrees of freedom.
//!
//! The origin is the mean p of the vertices, and the axes e₁, e₂ join the middles of opposite sides.
//! With X̂ = x̂ − ½, Ŷ = ŷ − ½ and the distortion w = a − b + c − d = w₁e₁ + w₂e₂ of the quad abcd
//! ```text
//!   F(x̂, ŷ) = p + X̂e₁ + Ŷe₂ + X̂Ŷw,     X = X̂ (1 + w₁Ŷ),  Y = Ŷ (1 + w₂X̂),
//!   dx dy = det(e₁, e₂) (1 + w₁Ŷ + w₂X̂) dx̂ dŷ.
//! ```
//! The middles of the sides have the coordinates (0, −½), (½, 0), (0, ½), (−½, 0) whatever the shape,
//! and the means q₀ … q₃ of X² − Y² over the sides meet q₁ + q₃ − q₀ − q₂ = ⅔: the system for the
//! basis has a solution on every quad, and a short one,
//! ```text
//!   φ₀ = ¼ − Y − Q     φ₁ = ¼ + X + Q     φ₂ = ¼ + Y − Q     φ₃ = ¼ − X + Q,
//!   Q = 3/2 (X² − Y²) + (w₂X − w₁Y)/4 − (w₁² − w₂²)/32.
//! ```
//! On a parallelogram w = 0: this is the parametric element ([`super::rannacher_turek`]) then.
//! Elsewhere it holds all linear functions, which the parametric one does not: on quads that keep their
//! shape under refinement u_h converges with its full rate.
//!
//! Σφ = 1, and the load of a cell goes to its sides in quarters here too, so that formula (15) and the
//! balance of each cell stay as they are. The means of the φ over the cell are quarters up to w/12: a
//! quarter stands for f gathered at p instead of the centroid, which is of the order of its oscillation.
//!
//! With C the cofactor matrix of (e₁ e₂) and ∇ the derivatives by X and Y
//! ```text
//!   K_ij = ∫ (C∇φ_i)·A(C∇φ_j) (1 + w₁Ŷ + w₂X̂) / det(e₁, e₂)  dx̂ dŷ:
//! ```
//! of degree 3 in x̂ and in ŷ where A is constant, so that a 2×2 Gauss rule is exact on every quad.

use nalgebra::Vector2;

use super::above_diagonal;
use super::rannacher_turek::{MappedPoint, place};
use crate::mesh::geometry::scaled_normal;
use crate::{Real, Tensor};

/// The affine coordinates of one quad.
#[derive(Debug, Clone, Copy)]
pub struct Axes<R: Real> {
    /// Rows of C: e₂ and e₁, turned by ∓90°.
    cofactors: [Vector2<R>; 2],
    /// det(e₁, e₂), the area of the quad.
    area: R,
    distortion: [R; 2],
}

/// The axes of a convex quad.
pub fn axes<R: Real>(quad: [[R; 2]; 4]) -> Axes<R> {
    let middle = place(quad, [R::HALF; 2]);
    let [e1, e2] = middle.directions();
    let cofactors = [scaled_normal([R::ZERO; 2], e2), -scaled_normal([R::ZERO; 2], e1)];
    let [a, b, c, d] = quad.map(|[x, y]| Vector2::new(x, y));
    let (w, per_area) = ((a - b) + (c - d), R::ONE / middle.determinant);
    let distortion = cofactors.map(|row| row.dot(&w) * per_area);
    Axes { cofactors, area: middle.determinant, distortion }
}

impl<R: Real> Axes<R> {
    /// (w₁, w₂), zero on a parallelogram; |w₁| + |w₂| < 2 on a convex quad.
    pub fn distortion(&self) -> [R; 2] {
        self.distortion
    }

    /// φ₀ … φ₃ at reference coordinates (x̂, ŷ) in \[0, 1\]².
    pub fn basis(&self, reference: [R; 2]) -> [R; 4] {
        let [x, y] = affine(self.distortion, reference);
        let (bubble, quarter) = (bubble(self.distortion, [x, y]), R::QUARTER);
        [quarter - y - bubble, quarter + x + bubble, quarter + y - bubble, quarter - x + bubble]
    }

    /// Σ_i means_i ∇φ_i at reference coordinates (x̂, ŷ).
    pub fn gradient(&self, reference: [R; 2], means: [R; 4]) -> Vector2<R> {
        let [_, g1, g2, g3] = self.scaled_gradients(reference);
        // Written with differences, since the four gradients add up to zero.
        let sum =
            g1 * (means[1] - means[0]) + g2 * (means[2] - means[0]) + g3 * (means[3] - means[0]);
        sum * (R::ONE / self.area)
    }

    /// C ∇φ_i.
    fn scaled_gradients(&self, reference: [R; 2]) -> [Vector2<R>; 4] {
        let ([x, y], [w1, w2]) = (affine(self.distortion, reference), self.distortion);
        let [by_x, by_y] = self.cofactors;
        let bubble =
            by_x * (R::THREE * x + R::QUARTER * w2) - by_y * (R::THREE * y + R::QUARTER * w1);
        [-by_y - bubble, by_x + bubble, by_y - bubble, bubble - by_x]
    }

    /// (1 + w₁Ŷ + w₂X̂) / det(e₁, e₂)
    fn density(&self, [x, y]: [R; 2]) -> R {
        let [w1, w2] = self.distortion;
        (R::ONE + w1 * (y - R::HALF) + w2 * (x - R::HALF)) / self.area
    }
}

/// (X, Y) at reference coordinates in \[0, 1\]².
pub fn affine<R: Real>([w1, w2]: [R; 2], reference: [R; 2]) -> [R; 2] {
    let [x, y] = reference.map(|coordinate| coordinate - R::HALF);
    [x + w1 * (x * y), y + w2 * (x * y)]
}

/// Q
fn bubble<R: Real>([w1, w2]: [R; 2], [x, y]: [R; 2]) -> R {
    let (square, eighth) = (R::ONE + R::HALF, R::HALF * R::QUARTER);
    let linear = R::QUARTER * (w2 * x - w1 * y);
    square * (x * x - y * y) + linear - R::QUARTER * eighth * (w1 * w1 - w2 * w2)
}

/// The derivatives of Σ_i means_i φ_i by x̂ and ŷ, at reference coordinates in \[0, 1\]², on a quad with this distortion;
/// with the distortion 0 they are those of the parametric element, on any quad.
pub fn reference_gradient<R: Real>(
    distortion @ [w1, w2]: [R; 2],
    reference: [R; 2],
    [u0, u1, u2, u3]: [R; 4],
) -> [R; 2] {
    let ([x, y], [hat_x, hat_y]) = (affine(distortion, reference), reference.map(|z| z - R::HALF));
    let curved = (u1 - u0) + (u3 - u2);
    let by_x = (u1 - u3) + curved * (R::THREE * x + R::QUARTER * w2);
    let by_y = (u2 - u0) - curved * (R::THREE * y + R::QUARTER * w1);
    // X = X̂ + w₁X̂Ŷ and Y = Ŷ + w₂X̂Ŷ.
    [
        by_x * (R::ONE + w1 * hat_y) + by_y * (w2 * hat_y),
        by_x * (w1 * hat_x) + by_y * (R::ONE + w2 * hat_x),
    ]
}

/// K_T without its diagonal, \[01, 02, 03, 12, 13, 23\], by Gauss–Legendre quadrature with
/// `rule`.len()² points; `tensor(p)` is A at point p, numbered row by row with x̂ running fastest.
pub fn stiffness<R: Real>(
    quad: [[R; 2]; 4],
    rule: &[[R; 2]],
    mut tensor: impl FnMut(usize, &MappedPoint<R>) -> Tensor<R>,
) -> [R; 6] {
    let axes = axes(quad);
    above_diagonal(rule, |point, reference, weight| {
        let a = tensor(point, &place(quad, reference));
        (a, weight * axes.density(reference), axes.scaled_gradients(reference))
    })
}

/// u_h at vertices 0 to 3 from its means over the sides, on a quad with this distortion.
pub fn at_vertices<R: Real>(distortion: [R; 2], &[u0, u1, u2, u3]: &[R; 4]) -> [R; 4] {
    let (mean, curved) = (R::QUARTER * ((u0 + u2) + (u1 + u3)), (u1 + u3) - (u0 + u2));
    let (zero, one) = (R::ZERO, R::ONE);
    [[zero, zero], [one, zero], [one, one], [zero, one]].map(|corner| {
        let [x, y] = affine(distortion, corner);
        mean + x * (u1 - u3) + y * (u2 - u0) + curved * bubble(distortion, [x, y])
    })
}
