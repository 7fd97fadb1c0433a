//! A quad's share of the bound, by quadrature over the reference square: 3×3 Gauss points are exact
//! where B is constant, 8×8 are taken where it varies.
//!
//! ```text
//!   ŝ = bilinear + Σ_k d_k 4t_k(1 − t_k)(1 − η_k)      t_k along side k, η_k the distance from it
//!   τ̂ = (τ₃(x̂ − 1) + τ₁x̂, τ₀(ŷ − 1) + τ₂ŷ)
//! ```

use super::Share;
use super::metric::{Local, POINTS, inverse_form};
use crate::element::rannacher_turek::product;
use crate::real::Real;
use crate::tensor::Tensor;

/// `corners`: s at the vertices; `bubbles`: d of the sides; `tau`: outward fluxes through them; `u`:
/// means over them.
pub(super) fn share<R: Real>(
    metric: Local<R, Tensor<R>>,
    k: &[R; 6],
    corners: [R; 4],
    bubbles: [R; 4],
    tau: [R; 4],
    u: [R; 4],
    load: R,
) -> Share<R> {
    let quarter = load * R::QUARTER;
    let own = product(k, &u).map(|flow| flow - quarter);
    let [t0, t1, t2, t3] = tau;
    let difference = [t0 - own[0], t1 - own[1], t2 - own[2], t3 - own[3]];
    let (mut gap, mut algebraic, mut rounding) = (R::ZERO, R::ZERO, R::ZERO);
    each_point(metric, |at, weight, b| {
        let [gx, gy] = gradient(corners, bubbles, at);
        let field = raviart_thomas(tau, at);
        let flow = [[b.xx * gx, b.xy * gy], [b.xy * gx, b.yy * gy]];
        let residual = [flow[0][0] + flow[0][1] - field[0], flow[1][0] + flow[1][1] - field[1]];
        gap += weight * inverse_form(b, residual);
        algebraic += weight * inverse_form(b, raviart_thomas(difference, at));
        let large = flow.as_flattened().iter().chain(&field);
        let large = large.fold(R::ZERO, |sum, term| sum + term.magnitude());
        let delta = R::from_count(8) * R::EPSILON * large;
        rounding += weight * delta * delta * (b.xx + b.yy) / (b.xx * b.yy - b.xy * b.xy);
    });
    let terms = tau.iter().fold(load.magnitude(), |sum, flux| sum + flux.magnitude());
    Share { gap, algebraic, rounding, terms }
}

/// ‖A^{−½}·‖² of the Raviart–Thomas field with these outward fluxes.
pub(super) fn energy<R: Real>(metric: Local<R, Tensor<R>>, out: [R; 4]) -> R {
    let mut energy = R::ZERO;
    each_point(metric, |at, weight, b| {
        energy += weight * inverse_form(b, raviart_thomas(out, at));
    });
    energy
}

/// Calls `take` with every quadrature point, its weight and B there.
#[inline(always)]
fn each_point<R: Real>(metric: Local<R, Tensor<R>>, mut take: impl FnMut([R; 2], R, Tensor<R>)) {
    match metric {
        Local::Constant(b) => {
            for &[y, weight_y] in R::GAUSS[2] {
                for &[x, weight_x] in R::GAUSS[2] {
                    take([x, y], weight_x * weight_y, b);
                }
            }
        }
        Local::AtPoints(points) => {
            let mut tensors = points.iter();
            for &[y, weight_y] in R::GAUSS[POINTS - 1] {
                for &[x, weight_x] in R::GAUSS[POINTS - 1] {
                    let Some(&b) = tensors.next() else { break };
                    take([x, y], weight_x * weight_y, b);
                }
            }
        }
    }
}

/// ∇̂ŝ
fn gradient<R: Real>([s0, s1, s2, s3]: [R; 4], [d0, d1, d2, d3]: [R; 4], [x, y]: [R; 2]) -> [R; 2] {
    let (across_x, across_y) = (R::ONE - x, R::ONE - y);
    let four = R::TWO + R::TWO;
    let (arch_x, arch_y) = (four * x * across_x, four * y * across_y);
    let (slope_x, slope_y) = (four * (across_x - x), four * (across_y - y));
    [
        (s1 - s0) * across_y
            + (s2 - s3) * y
            + slope_x * (d0 * across_y + d2 * y)
            + arch_y * (d1 - d3),
        (s3 - s0) * across_x
            + (s2 - s1) * x
            + slope_y * (d1 * x + d3 * across_x)
            + arch_x * (d2 - d0),
    ]
}

fn raviart_thomas<R: Real>([t0, t1, t2, t3]: [R; 4], [x, y]: [R; 2]) -> [R; 2] {
    [t3 * (x - R::ONE) + t1 * x, t0 * (y - R::ONE) + t2 * y]
}
