//! A triangle's share of the bound.
//!
//! Where A is constant no geometry is needed. With the element matrix K, the fluxes G of A∇s through the
//! sides and D = G − (τ + ∫f/3), ΣD = 0,
//! ```text
//!   ‖A^½∇s − A^{−½}τ‖² = −[K₁₂D₀² + K₂₀D₁² + K₀₁D₂² + (K₀₁ + K₁₂ + K₂₀)/2 (∫f/3)²] / (4 det A),
//! ```
//! the last term for the linear part of τ. Elsewhere the integral is taken at points. s − u_h is linear, so that
//! ‖A^½∇(s − u_h)‖² is the same form in the fluxes of A∇s less those of A∇u_h, whether A is constant or not.

use super::factor::{self, Above, Factor, GRADIENTS, ON_TRIANGLE};
use super::metric::{POINTS, Varying, inverse_form};
use super::parts::CellTerms;
use crate::cells::Triangle;
use signorini_kernel::element::crouzeix_raviart::product;
use signorini_kernel::{Index, Real, Tensor};

/// `s`: values at the vertices; `tau`: outward fluxes through the sides; `u`: means over the sides.
#[inline(always)]
pub(super) fn share<R: Real, I: Index>(
    cell: &Triangle<R, I>,
    s: [R; 3],
    tau: [R; 3],
    u: [R; 3],
    load: R,
) -> CellTerms<R> {
    let k = &cell.k;
    let third = load * R::THIRD;
    let flows = flows(k, s);
    let [t01, t12, t20] = flows;
    let tau_middle = tau.map(|flux| flux + third);
    let gap = [t01 - t20 - tau_middle[0], t12 - t01 - tau_middle[1], t20 - t12 - tau_middle[2]];
    let own = product(k, &u);
    let algebraic = [tau_middle[0] - own[0], tau_middle[1] - own[1], tau_middle[2] - own[2]];
    let jump = [gap[0] + algebraic[0], gap[1] + algebraic[1], gap[2] + algebraic[2]];
    let terms = squares(tau, load);
    CellTerms {
        gap: square(cell, gap, third),
        algebraic: cell.compliance * form(k, algebraic),
        nonconforming: cell.compliance * form(k, jump),
        uncertainty: cell.uncertainty * sum_of_squares(flows, terms),
        uncertainty_of_u: cell.uncertainty * sum_of_squares(flows, of_means(k, u)),
        terms,
        open: R::ZERO,
    }
}

/// The square of a field with these fluxes of its mean, whose outward ones leave three times `third`.
#[inline(always)]
fn square<R: Real, I: Index>(cell: &Triangle<R, I>, fluxes: [R; 3], third: R) -> R {
    cell.compliance * (form(&cell.k, fluxes) - spread(&cell.k, third))
}

/// 4 det A · ‖A^{−½}·‖² of the field that spreads three times `third` evenly over the cell, with the sign turned.
#[inline(always)]
pub(super) fn spread<R: Real>(k: &[R; 3], third: R) -> R {
    R::HALF * (k[0] + k[1] + k[2]) * third * third
}

/// K_ij (mean of s on j − mean of s on i) for 01, 12, 20, from the vertex values of s.
#[inline(always)]
pub(super) fn flows<R: Real>(k: &[R; 3], [s0, s1, s2]: [R; 3]) -> [R; 3] {
    [k[0] * (R::HALF * (s2 - s0)), k[1] * (R::HALF * (s0 - s1)), k[2] * (R::HALF * (s1 - s2))]
}

/// 4 det A · ‖A^{−½}·‖² of the constant field with these fluxes, which add up to 0.
#[inline(always)]
pub(super) fn form<R: Real>(&[k01, k12, k20]: &[R; 3], [d0, d1, d2]: [R; 3]) -> R {
    -(k12 * d0 * d0 + k20 * d1 * d1 + k01 * d2 * d2)
}

/// The squares of K_ij (mean of u on j − mean of u on i).
#[inline(always)]
pub(super) fn of_means<R: Real>(k: &[R; 3], [u0, u1, u2]: [R; 3]) -> R {
    let (t01, t12, t20) = (k[0] * (u1 - u0), k[1] * (u2 - u1), k[2] * (u0 - u2));
    t01 * t01 + t12 * t12 + t20 * t20
}

#[inline(always)]
pub(super) fn squares<R: Real>(tau: [R; 3], load: R) -> R {
    tau[0] * tau[0] + tau[1] * tau[1] + tau[2] * tau[2] + load * load
}

/// The squares of all terms of D.
#[inline(always)]
fn sum_of_squares<R: Real>([t01, t12, t20]: [R; 3], terms: R) -> R {
    terms + t01 * t01 + t12 * t12 + t20 * t20
}

/// ‖A^{−½}·‖² of the Raviart–Thomas field with these outward fluxes.
#[inline(always)]
pub(super) fn energy<R: Real, I: Index>(
    cell: &Triangle<R, I>,
    varying: Option<Varying<R>>,
    out: [R; 3],
) -> R {
    let (none, load) = ([R::ZERO; 3], -(out[0] + out[1] + out[2]));
    match varying {
        None => {
            let third = load * R::THIRD;
            square(cell, out.map(|flux| flux + third), third)
        }
        Some(Varying::Points(points)) => {
            let (k, out) = (cell.stiffness_in_mesh(), cell.sides_in_mesh(out));
            share_at_points(points, R::ZERO, (&k, cell.compliance), none, out, none, load).gap
        }
        Some(Varying::Factor(factor)) => {
            factor::energy::<R, ON_TRIANGLE>(factor, GRADIENTS[0], &cell.sides_in_mesh(out))
        }
    }
}

/// Weight of a square of the balance in the uncertainty: about 1/A.
pub(super) fn softness<R: Real, I: Index>(cell: &Triangle<R, I>, varying: Option<Varying<R>>) -> R {
    match varying {
        None => cell.uncertainty,
        Some(Varying::Points(points)) => {
            let (k, none) = (cell.stiffness_in_mesh(), [R::ZERO; 3]);
            let (unit, mean) = ([R::ONE, R::ZERO, R::ZERO], (&k, cell.compliance));
            share_at_points(points, R::ZERO, mean, none, unit, none, R::ZERO).uncertainty
        }
        Some(Varying::Factor(factor)) => factor::softness::<R, ON_TRIANGLE>(factor, GRADIENTS[0]),
    }
}

/// τ − σ_h through the sides.
pub(super) fn difference<R: Real>(k: &[R; 3], tau: [R; 3], u: [R; 3], load: R) -> [R; 3] {
    let third = load * R::THIRD;
    let [o0, o1, o2] = product(k, &u).map(|flow| flow - third);
    let [t0, t1, t2] = tau;
    [t0 - o0, t1 - o1, t2 - o2]
}

/// The terms of 4 det A = ab + bc + ca, with the entries a, b, c of the element matrix, over what they cancel to.
pub(super) fn obliqueness<R: Real>(k: &[R; 3]) -> R {
    let size = k.iter().fold(R::ZERO, |most, entry| most.or_larger(entry.magnitude()));
    let [a, b, c] = k.map(|entry| entry / size);
    let [ab, bc, ca] = [a * b, b * c, c * a];
    (ab.magnitude() + bc.magnitude() + ca.magnitude()) / (ab + bc + ca)
}

/// The share by quadrature over the collapsed square, x̂ = ξ(1 − η), ŷ = η; everything in the order of
/// the mesh, the element matrix with the compliance of the mean of A.
#[inline(never)]
pub(super) fn share_at_points<R: Real>(
    points: &[Tensor<R>; POINTS * POINTS],
    open: R,
    (k, mean): (&[R; 3], R),
    s: [R; 3],
    tau: [R; 3],
    u: [R; 3],
    load: R,
) -> CellTerms<R> {
    let flows = flows(k, s);
    let own = product(k, &u);
    let [t01, t12, t20] = flows;
    let jump = [t01 - t20 - own[0], t12 - t01 - own[1], t20 - t12 - own[2]];
    let difference = difference(k, tau, u, load);
    let gradient = [s[1] - s[0], s[2] - s[0]];
    let (mut gap, mut algebraic, mut compliance) = (R::ZERO, R::ZERO, R::ZERO);
    let mut tensors = points.iter();
    for &[y, weight_y] in R::GAUSS[POINTS - 1] {
        for &[x, weight_x] in R::GAUSS[POINTS - 1] {
            let Some(&b) = tensors.next() else { break };
            let weight = weight_x * weight_y * (R::ONE - y);
            let at = [x * (R::ONE - y), y];
            let field = raviart_thomas(tau, at);
            let residual = [
                b.xx * gradient[0] + b.xy * gradient[1] - field[0],
                b.xy * gradient[0] + b.yy * gradient[1] - field[1],
            ];
            gap += weight * inverse_form(b, residual);
            algebraic += weight * inverse_form(b, raviart_thomas(difference, at));
            compliance += weight / (R::TWO * (b.xx * b.yy - b.xy * b.xy));
        }
    }
    let terms = squares(tau, load);
    let size = k.iter().fold(R::ZERO, |sum, entry| sum + entry.magnitude());
    let uncertainty = compliance * size * sum_of_squares(flows, terms);
    let uncertainty_of_u = compliance * size * sum_of_squares(flows, of_means(k, u));
    let nonconforming = mean * form(k, jump);
    // ∫A∇s·∇s, by the fluxes of Ā∇s.
    let energy = mean * form(k, [t01 - t20, t12 - t01, t20 - t12]);
    let open = open * energy;
    CellTerms { gap, algebraic, nonconforming, uncertainty, uncertainty_of_u, terms, open }
}

/// The share by a factor of all integrals ([`super::factor`]), in the order of the mesh.
#[inline(never)]
pub(super) fn share_by_factor<R: Real>(
    of: &Factor<R>,
    above: Above<R>,
    [s0, s1, s2]: [R; 3],
    [u0, u1, u2]: [R; 3],
    [tau, difference]: [[R; 3]; 2],
    load: R,
) -> CellTerms<R> {
    // u_h at a vertex is the sum of the means beside it less the one opposite.
    let values = [[s1 - s0, s2 - s0], [R::TWO * (u1 - u2), R::TWO * (u1 - u0)]];
    factor::share::<R, ON_TRIANGLE, 2>(of, above, values, [&tau, &difference], load)
}

/// τ̂ = Σ_k τ_k (x̂ − opposite vertex) on the reference triangle.
fn raviart_thomas<R: Real>([t0, t1, t2]: [R; 3], [x, y]: [R; 2]) -> [R; 2] {
    let sum = t0 + t1 + t2;
    [sum * x - t2, sum * y - t0]
}
