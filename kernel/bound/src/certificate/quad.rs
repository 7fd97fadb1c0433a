//! A quad's share of the bound.
//!
//! ```text
//!   ŝ = bilinear + Σ_k d_k 4t_k(1 − t_k)(1 − η_k)      t_k along side k, η_k the distance from it
//!   τ̂ = (τ₃(x̂ − 1) + τ₁x̂, τ₀(ŷ − 1) + τ₂ŷ)
//! ```
//! With X = x̂ − ½, Y = ŷ − ½ and P(Z) = Z² − 1/12, both ∇̂ŝ and τ̂ are combinations of 1, X, Y, XY, P(X)
//! and P(Y), orthogonal functions with the squares 1, 1/12, 1/12, 1/144, 1/180, 1/180. Where B is
//! constant, ∫(B∇̂ŝ − τ̂)·B^{−1}(B∇̂ŝ − τ̂) is a sum over these six. Elsewhere it is taken at points.

use super::factor::{self, Above, Factor, GRADIENTS, ON_QUAD};
use super::metric::{POINTS, Varying, inverse_form, of_parallelogram};
use super::parts::CellTerms;
use crate::cells::Quad;
use signorini_kernel::element::nonparametric;
use signorini_kernel::element::rannacher_turek::product;
use signorini_kernel::{Index, Real, Tensor};

/// s on a quad: values at the vertices, bubbles of the sides.
#[derive(Debug, Clone, Copy)]
pub(super) struct Values<R> {
    pub corners: [R; 4],
    pub bubbles: [R; 4],
}

/// u_h on a quad: means over the sides, and the distortion where it is nonparametric.
#[derive(Debug, Clone, Copy)]
pub(super) struct Means<R> {
    pub means: [R; 4],
    pub distortion: [R; 2],
}

/// `tau`: outward fluxes through the sides; `u`: means over them.
pub(super) fn share<R: Real, I: Index>(
    cell: &Quad<R, I>,
    s: Values<R>,
    tau: [R; 4],
    u: [R; 4],
    load: R,
) -> CellTerms<R> {
    let b = of_parallelogram(&cell.k);
    let [constant, along_x, along_y, rest] = modes(s);
    let (flux, flux_x, flux_y) = flux_modes(tau);
    let residual = [
        minus(apply(b, constant), flux),
        minus(apply(b, along_x), [flux_x, R::ZERO]),
        minus(apply(b, along_y), [R::ZERO, flux_y]),
    ];
    let [e, c] = rest;
    let twelfth = R::ONE / R::from_count(12);
    // XY has the vector −8(e, c), P(Y) has −4(c, 0), P(X) has −4(0, e).
    let mixed = R::from_count(4) / R::from_count(9) * form(b, rest);
    let arches = R::from_count(4) / R::from_count(45) * (b.xx * c * c + b.yy * e * e);
    let gap = inverse_form(b, residual[0])
        + twelfth * (inverse_form(b, residual[1]) + inverse_form(b, residual[2]))
        + mixed
        + arches;
    let large = form(b, constant) + twelfth * (form(b, along_x) + form(b, along_y));
    let spread = b.xx + b.yy;
    let terms = squares(tau, load);
    let softness = spread / (b.xx * b.yy - b.xy * b.xy);
    let algebraic = flux_energy(b, difference(cell, tau, u, load));
    let (of_u, curvature) = means_modes(u);
    let nonconforming = form(b, minus(constant, of_u))
        + twelfth * form(b, minus(along_x, [curvature, R::ZERO]))
        + twelfth * form(b, minus(along_y, [R::ZERO, -curvature]))
        + mixed
        + arches;
    // Rounding of K moves B by ε·spread, which relative to B is up to ε times this.
    let condition = spread * softness;
    let moved = moved(condition, large + gap);
    CellTerms {
        gap,
        algebraic,
        nonconforming,
        uncertainty: condition * large + softness * terms + moved,
        uncertainty_of_u: condition * (large + nonconforming) + moved,
        terms,
        open: R::ZERO,
    }
}

/// ‖A^{−½}·‖² of the Raviart–Thomas field with these outward fluxes.
pub(super) fn energy<R: Real, I: Index>(
    cell: &Quad<R, I>,
    varying: Option<Varying<R>>,
    out: [R; 4],
) -> R {
    match varying {
        None => flux_energy(of_parallelogram(&cell.k), out),
        Some(Varying::Points(points)) => {
            let (zero, none) = (R::ZERO, [R::ZERO; 4]);
            let s = Values { corners: none, bubbles: none };
            let u = Means { means: none, distortion: [zero; 2] };
            share_at_points(points, zero, s, u, cell.sides_in_mesh(out), none, zero).gap
        }
        Some(Varying::Factor(factor)) => {
            factor::energy::<R, ON_QUAD>(factor, GRADIENTS[1], &cell.sides_in_mesh(out))
        }
    }
}

/// Least weight of a square of the balance in the uncertainty: about 1/A.
pub(super) fn softness<R: Real, I: Index>(cell: &Quad<R, I>, varying: Option<Varying<R>>) -> R {
    let of = |b: Tensor<R>| (b.xx + b.yy) / (b.xx * b.yy - b.xy * b.xy);
    let points = match varying {
        None => return of(of_parallelogram(&cell.k)),
        Some(Varying::Points(points)) => points,
        Some(Varying::Factor(factor)) => {
            return factor::softness::<R, ON_QUAD>(factor, GRADIENTS[1]);
        }
    };
    let rows = R::GAUSS[POINTS - 1].iter();
    let weights = rows.flat_map(|y| R::GAUSS[POINTS - 1].iter().map(move |x| x[1] * y[1]));
    points.iter().zip(weights).fold(R::ZERO, |sum, (&b, weight)| sum + weight * of(b))
}

/// B₁₁B₂₂ over det B, what it cancels to; the most of all points.
pub(super) fn obliqueness<R: Real, I: Index>(cell: &Quad<R, I>, varying: Option<Varying<R>>) -> R {
    let of = |b: Tensor<R>| match b.xx > R::ZERO && b.yy > R::ZERO {
        true => R::ONE / (R::ONE - b.xy / b.xx * (b.xy / b.yy)),
        false => R::ONE / R::ZERO,
    };
    let points = match varying {
        None => return of(of_parallelogram(&cell.k)),
        Some(Varying::Points(points)) => points,
        // Nothing is drawn from the element matrix but the algebraic part.
        Some(Varying::Factor(_)) => return R::ONE,
    };
    let worse = |most: R, b: &Tensor<R>| {
        let here = of(*b);
        if here >= R::ONE { most.or_larger(here) } else { R::ONE / R::ZERO }
    };
    points.iter().fold(R::ONE, worse)
}

/// τ − σ_h through the sides.
pub(super) fn difference<R: Real, I: Index>(
    cell: &Quad<R, I>,
    tau: [R; 4],
    u: [R; 4],
    load: R,
) -> [R; 4] {
    let quarter = load * R::QUARTER;
    let [o0, o1, o2, o3] = product(&cell.k, &u).map(|flow| flow - quarter);
    let [t0, t1, t2, t3] = tau;
    [t0 - o0, t1 - o1, t2 - o2, t3 - o3]
}

/// ∇̂ŝ: its constant, X and Y parts, and (e, c) = (d₂ − d₀, d₁ − d₃), which makes all others.
fn modes<R: Real>(s: Values<R>) -> [[R; 2]; 4] {
    let ([s0, s1, s2, s3], [d0, d1, d2, d3]) = (s.corners, s.bubbles);
    let (bottom, top, left, right) = (s1 - s0, s2 - s3, s3 - s0, s2 - s1);
    let (e, c, twist) = (d2 - d0, d1 - d3, top - bottom);
    let (two_thirds, four) = (R::TWO * R::THIRD, R::TWO + R::TWO);
    [
        [R::HALF * (bottom + top) + two_thirds * c, R::HALF * (left + right) + two_thirds * e],
        [-four * (d0 + d2), twist],
        [twist, -four * (d1 + d3)],
        [e, c],
    ]
}

/// ∇̂u_h on a parallelogram: its constant part and what x̂ has along X; ŷ has the opposite along Y.
fn means_modes<R: Real>([u0, u1, u2, u3]: [R; 4]) -> ([R; 2], R) {
    ([u1 - u3, u2 - u0], R::THREE * ((u1 - u0) + (u3 - u2)))
}

/// τ̂: its constant part, what X has in x̂ and what Y has in ŷ.
fn flux_modes<R: Real>([t0, t1, t2, t3]: [R; 4]) -> ([R; 2], R, R) {
    ([R::HALF * (t1 - t3), R::HALF * (t2 - t0)], t1 + t3, t0 + t2)
}

fn flux_energy<R: Real>(b: Tensor<R>, out: [R; 4]) -> R {
    let (flux, x, y) = flux_modes(out);
    let determinant = b.xx * b.yy - b.xy * b.xy;
    let linear = (b.yy * x * x + b.xx * y * y) / (R::from_count(12) * determinant);
    inverse_form(b, flux) + linear
}

fn apply<R: Real>(b: Tensor<R>, [x, y]: [R; 2]) -> [R; 2] {
    [b.xx * x + b.xy * y, b.xy * x + b.yy * y]
}

fn minus<R: Real>(a: [R; 2], b: [R; 2]) -> [R; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// v·Bv
fn form<R: Real>(b: Tensor<R>, v: [R; 2]) -> R {
    let image = apply(b, v);
    v[0] * image[0] + v[1] * image[1]
}

fn squares<R: Real>([t0, t1, t2, t3]: [R; 4], load: R) -> R {
    t0 * t0 + t1 * t1 + t2 * t2 + t3 * t3 + load * load
}

/// Uncertainty that an error of `condition` · ε in B, relative to B, adds about a form of this size.
fn moved<R: Real>(condition: R, size: R) -> R {
    R::HALF * R::QUARTER * condition * condition * size
}

/// Relative to B, an error of ε in each of its entries is up to ε times this.
fn sensitivity<R: Real>(b: Tensor<R>) -> R {
    let (straight, oblique) = (b.xx * b.yy, b.xy * b.xy);
    R::TWO * (straight + oblique) / (straight - oblique)
}

/// Share of a cell by quadrature; everything in the order of the mesh, `difference` = τ − σ_h.
#[inline(never)]
pub(super) fn share_at_points<R: Real>(
    points: &[Tensor<R>; POINTS * POINTS],
    open: R,
    s: Values<R>,
    u: Means<R>,
    tau: [R; 4],
    difference: [R; 4],
    load: R,
) -> CellTerms<R> {
    let terms = squares(tau, load);
    let (mut gap, mut algebraic, mut uncertainty) = (R::ZERO, R::ZERO, R::ZERO);
    let (mut nonconforming, mut uncertainty_of_u, mut energies) = (R::ZERO, R::ZERO, R::ZERO);
    let mut tensors = points.iter();
    for &[y, weight_y] in R::GAUSS[POINTS - 1] {
        for &[x, weight_x] in R::GAUSS[POINTS - 1] {
            let Some(&b) = tensors.next() else { break };
            let weight = weight_x * weight_y;
            let slope = gradient(s, [x, y]);
            let flow = apply(b, slope);
            let square = inverse_form(b, minus(flow, raviart_thomas(tau, [x, y])));
            gap += weight * square;
            algebraic += weight * inverse_form(b, raviart_thomas(difference, [x, y]));
            let large = terms + flow[0] * flow[0] + flow[1] * flow[1];
            let softness = weight * (b.xx + b.yy) / (b.xx * b.yy - b.xy * b.xy);
            uncertainty += softness * large;
            let energy = (slope[0] * flow[0] + slope[1] * flow[1]).magnitude();
            energies += weight * energy;
            uncertainty += weight * moved(sensitivity(b), energy + square);
            let of_u = nonparametric::reference_gradient(u.distortion, [x, y], u.means);
            let jump = form(b, minus(slope, of_u));
            let own = apply(b, of_u);
            nonconforming += weight * jump;
            uncertainty_of_u += softness * (large + own[0] * own[0] + own[1] * own[1]);
            uncertainty_of_u += weight * moved(sensitivity(b), energy + jump);
        }
    }
    let open = open * energies;
    CellTerms { gap, algebraic, nonconforming, uncertainty, uncertainty_of_u, terms, open }
}

/// The share by a factor of all integrals ([`super::factor`]), in the order of the mesh.
#[inline(never)]
pub(super) fn share_by_factor<R: Real>(
    of: &Factor<R>,
    above: Above<R>,
    s: Values<R>,
    u: Means<R>,
    [tau, difference]: [[R; 4]; 2],
    load: R,
) -> CellTerms<R> {
    let ([s0, s1, s2, s3], [d0, d1, d2, d3]) = (s.corners, s.bubbles);
    let [u0, u1, u2, u3] = u.means;
    // X and Y at a vertex less what they are at the first one.
    let [zero, one] = [R::ZERO, R::ONE];
    let [origin, corners @ ..] = [[zero, zero], [one, zero], [one, one], [zero, one]]
        .map(|at| nonparametric::affine(u.distortion, at));
    let linear = |[x, y]: [R; 2]| (u1 - u3) * (x - origin[0]) + (u2 - u0) * (y - origin[1]);
    let ([a, b, c], curved) = (corners.map(linear), (u1 - u0) + (u3 - u2));
    let values = [
        [s1 - s0, s2 - s0, s3 - s0, d0, d1, d2, d3, zero],
        [a, b, c, zero, zero, zero, zero, curved],
    ];
    factor::share::<R, ON_QUAD, 8>(of, above, values, [&tau, &difference], load)
}

/// ∇̂ŝ
fn gradient<R: Real>(s: Values<R>, [x, y]: [R; 2]) -> [R; 2] {
    let ([s0, s1, s2, s3], [d0, d1, d2, d3]) = (s.corners, s.bubbles);
    let (across_x, across_y, four) = (R::ONE - x, R::ONE - y, R::TWO + R::TWO);
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
