//! The parametric Rannacher–Turek quad: span{1, x̂, ŷ, x̂² − ŷ²} on \[0, 1\]² through the bilinear
//! map F, with edge means as degrees of freedom.
//!
//! F is affine along a side, so means on the reference square are means on the quad, and the basis
//! is the same for all quads. With X = x̂ − ½, Y = ŷ − ½ and Q = 3/2 (X² − Y²):
//! ```text
//!   φ₀ = ¼ − Y − Q     φ₁ = ¼ + X + Q     φ₂ = ¼ + Y − Q     φ₃ = ¼ − X + Q
//! ```
//! With C the cofactor matrix of DF, ∇φ = C ∇̂φ / det DF and
//! ```text
//!   K_ij = ∫ (C∇̂φ_i)·A(C∇̂φ_j) / det DF  dx̂ dŷ.
//! ```
//! On a parallelogram with constant A a 2×2 Gauss rule is exact; elsewhere the integrand is rational,
//! and linear functions are not in the span: [`super::nonparametric`] has them.

use nalgebra::{Matrix2, Vector2};

use super::above_diagonal;
use crate::mesh::geometry::scaled_normal;
use crate::{Real, Tensor};

/// The bilinear map at one reference point.
#[derive(Debug, Clone, Copy)]
pub struct MappedPoint<R: Real> {
    /// F(x̂, ŷ)
    pub x: [R; 2],
    /// det DF > 0 in a convex quad.
    pub determinant: R,
    jacobian: Matrix2<R>,
    reference: [R; 2],
}

/// The point of `quad` at reference coordinates (x̂, ŷ) in \[0, 1\]².
pub fn place<R: Real>([a, b, c, d]: [[R; 2]; 4], [x, y]: [R; 2]) -> MappedPoint<R> {
    let point = |v: [R; 2]| Vector2::new(v[0], v[1]);
    let (bottom, top) = (point(b) - point(a), point(c) - point(d));
    let (left, right) = (point(d) - point(a), point(c) - point(b));
    let along_x = bottom * (R::ONE - y) + top * y;
    let along_y = left * (R::ONE - x) + right * x;
    let at = point(a) + bottom * x + (left * (R::ONE - x) + right * x) * y;
    MappedPoint {
        x: [at.x, at.y],
        determinant: along_x.x * along_y.y - along_x.y * along_y.x,
        jacobian: Matrix2::from_columns(&[along_x, along_y]),
        reference: [x - R::HALF, y - R::HALF],
    }
}

impl<R: Real> MappedPoint<R> {
    /// The columns of DF here: along x̂, along ŷ.
    pub fn directions(&self) -> [[R; 2]; 2] {
        let [along_x, along_y] = [self.jacobian.column(0), self.jacobian.column(1)];
        [[along_x.x, along_x.y], [along_y.x, along_y.y]]
    }

    /// φ₀ … φ₃ here.
    pub fn basis(&self) -> [R; 4] {
        let [x, y] = self.reference;
        let bubble = (R::ONE + R::HALF) * (x * x - y * y);
        let quarter = R::QUARTER;
        [quarter - y - bubble, quarter + x + bubble, quarter + y - bubble, quarter - x + bubble]
    }

    /// Σ_i means_i ∇φ_i here.
    pub fn gradient(&self, means: [R; 4]) -> Vector2<R> {
        let differences = self.scaled_gradients();
        let [_, g1, g2, g3] = differences;
        // Written with differences, since the four gradients add up to zero.
        let sum =
            g1 * (means[1] - means[0]) + g2 * (means[2] - means[0]) + g3 * (means[3] - means[0]);
        sum * (R::ONE / self.determinant)
    }

    /// The RT0 field with the outward fluxes `flux` (integrals over the sides) here, by Piola's map:
    /// σ = DF σ̂ / det DF, σ̂ = (F₃ (x̂ − 1) + F₁ x̂, F₀ (ŷ − 1) + F₂ ŷ).
    pub fn raviart_thomas(&self, flux: [R; 4]) -> Vector2<R> {
        let [x, y] = self.reference.map(|centred| centred + R::HALF);
        let reference = Vector2::new(
            flux[3] * (x - R::ONE) + flux[1] * x,
            flux[0] * (y - R::ONE) + flux[2] * y,
        );
        self.jacobian * reference * (R::ONE / self.determinant)
    }

    /// C ∇̂φ_i, that is ∇φ_i det DF.
    fn scaled_gradients(&self) -> [Vector2<R>; 4] {
        let [x, y] = self.reference.map(|centred| R::THREE * centred);
        let (along_x, along_y) = (self.jacobian.column(0), self.jacobian.column(1));
        // Rows of the cofactor matrix: the columns of DF turned by ±90°.
        let by_x = scaled_normal([R::ZERO; 2], [along_y.x, along_y.y]);
        let by_y = -scaled_normal([R::ZERO; 2], [along_x.x, along_x.y]);
        let (one, bubble) = (R::ONE, by_y * y - by_x * x);
        [bubble - by_y * one, by_x - bubble, bubble + by_y, -bubble - by_x]
    }
}

/// K_T without its diagonal, \[01, 02, 03, 12, 13, 23\], by Gauss–Legendre quadrature with
/// `rule`.len()² points; `tensor(p)` is A at point p, numbered row by row with x̂ running fastest.
pub fn stiffness<R: Real>(
    quad: [[R; 2]; 4],
    rule: &[[R; 2]],
    mut tensor: impl FnMut(usize, &MappedPoint<R>) -> Tensor<R>,
) -> [R; 6] {
    above_diagonal(rule, |point, reference, weight| {
        let place = place(quad, reference);
        (tensor(point, &place), weight / place.determinant, place.scaled_gradients())
    })
}

/// u_h at vertices 0 to 3 from its means over the sides: at a corner, a basis function is ¾ where its
/// side meets the corner, and −¼ elsewhere.
pub fn at_vertices<R: Real>(&[u0, u1, u2, u3]: &[R; 4]) -> [R; 4] {
    let corner = |near: R, far: R| R::QUARTER * (R::THREE * near - far);
    [
        corner(u3 + u0, u1 + u2),
        corner(u0 + u1, u2 + u3),
        corner(u1 + u2, u3 + u0),
        corner(u2 + u3, u0 + u1),
    ]
}

/// (K_T u)_i for each side i, `k` as from [`stiffness`].
#[inline(always)]
pub fn product<R: Real>(
    &[k01, k02, k03, k12, k13, k23]: &[R; 6],
    &[u0, u1, u2, u3]: &[R; 4],
) -> [R; 4] {
    let (t01, t02, t03) = (k01 * (u1 - u0), k02 * (u2 - u0), k03 * (u3 - u0));
    let (t12, t13, t23) = (k12 * (u2 - u1), k13 * (u3 - u1), k23 * (u3 - u2));
    [t01 + t02 + t03, t12 + t13 - t01, t23 - t12 - t02, -(t03 + t13 + t23)]
}
