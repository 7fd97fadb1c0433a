//! The Crouzeix–Raviart triangle: P1, one degree of freedom a side.
//!
//! With N_k = |E_k| n_k the scaled outward normal of side k, the basis function of that side is
//! φ_k = 1 − 2λ_opposite with the constant gradient ∇φ_k = N_k / |T|, so that
//! ```text
//!   K_ij = ∫_T A∇φ_j·∇φ_i = N_i · Ā N_j / |T|,      Ā the mean of A over T: exact.
//! ```

use nalgebra::Vector2;

use crate::mesh::geometry::{doubled_area, scaled_normal};
use crate::{Real, Tensor};

/// K_T without its diagonal, \[01, 12, 20\]; `a` is the mean of A over the triangle.
pub fn stiffness<R: Real>([a, b, c]: [[R; 2]; 3], mean: Tensor<R>) -> [R; 3] {
    let (n0, n1) = (scaled_normal(a, b), scaled_normal(b, c));
    let n2 = -(n0 + n1);
    // Twice the area, from differences that the normals hold already.
    let per_area = R::TWO / (n0.x * n1.y - n0.y * n1.x);
    let (a0, a1) = (mean.apply(n0) * per_area, mean.apply(n1) * per_area);
    [a0.dot(&n1), a1.dot(&n2), a0.dot(&n2)]
}

/// (K_T u)_i for each side i, `k` as from [`stiffness`].
#[inline(always)]
pub fn product<R: Real>(&[k01, k12, k20]: &[R; 3], &[u0, u1, u2]: &[R; 3]) -> [R; 3] {
    let (t01, t12, t20) = (k01 * (u1 - u0), k12 * (u2 - u1), k20 * (u0 - u2));
    [t01 - t20, t12 - t01, t20 - t12]
}

/// u_h at vertices 0, 1, 2 from its means over the sides: side k runs from vertex k to k + 1, and a
/// basis function is −1 at the vertex opposite of its side and 1 at the others.
pub fn at_vertices<R: Real>(&[u0, u1, u2]: &[R; 3]) -> [R; 3] {
    [u0 - u1 + u2, u0 + u1 - u2, u1 + u2 - u0]
}

/// ∇u_h on the triangle from the means of u_h over its sides.
pub fn gradient<R: Real>([a, b, c]: [[R; 2]; 3], means: [R; 3]) -> Vector2<R> {
    // Written with differences, since N₀ + N₁ + N₂ = 0.
    let (n1, n2) = (scaled_normal(b, c), scaled_normal(c, a));
    (n1 * (means[1] - means[0]) + n2 * (means[2] - means[0])) * (R::TWO / doubled_area(a, b, c))
}

/// φ₀, φ₁, φ₂ at the point with the barycentric coordinates `lambda` of vertices 0, 1, 2.
pub fn basis<R: Real>(lambda: [R; 3]) -> [R; 3] {
    [lambda[2], lambda[0], lambda[1]].map(|opposite| R::ONE - R::TWO * opposite)
}

/// The RT0 field with the outward fluxes `flux` (integrals over the sides) at a point `x`:
/// σ = Σ_k F_k (x − opposite vertex) / (2|T|).
pub fn raviart_thomas<R: Real>([a, b, c]: [[R; 2]; 3], flux: [R; 3], x: [R; 2]) -> Vector2<R> {
    let from = |vertex: [R; 2]| Vector2::new(x[0] - vertex[0], x[1] - vertex[1]);
    let sum = from(c) * flux[0] + from(a) * flux[1] + from(b) * flux[2];
    sum * (R::ONE / doubled_area(a, b, c))
}
