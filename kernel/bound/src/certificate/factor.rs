//! A cell whose own points do not resolve A: all integrals of its share as a triangular factor.
//!
//! ```text
//!   ‖p^{−½}(τ − p∇v)‖² = |F c|²,   c = (coefficients of v, outward fluxes of τ),   F upper triangular
//! ```
//! with p ≤ A, worked out once from as many points as A asks for. Functions of v, whose gradients these are in reference coordinates:
//! on a triangle ŝ at the second and third vertex less that at the first; on a quad three such differences, the four bubbles and the
//! function of u_h with the means 0, ½, 0, ½ over its sides.

use super::parts::CellTerms;
use signorini_kernel::Real;

/// Coefficients on a quad: eight of v, then four fluxes.
pub const ON_QUAD: usize = 12;
/// Coefficients on a triangle: two of v, then three fluxes.
pub const ON_TRIANGLE: usize = 5;
/// Those of v.
pub const GRADIENTS: [usize; 2] = [2, 8];
/// Entries of F and M on a quad; a triangle has 18.
pub const ENTRIES: usize = ON_QUAD * (ON_QUAD + 1) / 2 + GRADIENTS[1] * (GRADIENTS[1] + 1) / 2;

/// F, its columns one after the other, and then M of v alone: ‖A^{−½}(A − p)∇v‖ ≤ |M v|.
pub type Factor<R> = [R; ENTRIES];

/// What A has above what it is taken for: of points the most of ‖A^{−½}(A − p)∇v‖² over ‖A^½∇v‖²; of a factor ‖A^½∇v‖² is no more
/// than 1 plus the second times |F (v, 0)|².
pub type Above<R> = [R; 2];

/// |F c|², and the same of the sums of the moduli.
fn squares<R: Real, const N: usize>(factor: &[R], c: &[R; N]) -> [R; 2] {
    let mut rows = [[R::ZERO; 2]; N];
    let mut entries = factor.iter();
    for (column, &value) in c.iter().enumerate() {
        for (row, &entry) in rows.iter_mut().zip(entries.by_ref().take(column + 1)) {
            let term = entry * value;
            row[0] += term;
            row[1] += term.magnitude();
        }
    }
    let mut sums = [R::ZERO; 2];
    for [sum, size] in rows {
        sums[0] += sum * sum;
        sums[1] += size * size;
    }
    sums
}

/// The square of the norm of the columns of fluxes: softness, the weight of a square of the balance in the uncertainty.
pub(super) fn softness<R: Real, const N: usize>(factor: &Factor<R>, gradients: usize) -> R {
    let first = gradients * (gradients + 1) / 2;
    let count = N * (N + 1) / 2 - first;
    factor.iter().skip(first).take(count).fold(R::ZERO, |sum, &entry| sum + entry * entry)
}

/// Coefficients with these ones of v, then these fluxes.
fn coefficients<R: Real, const N: usize>(v: &[R], tau: &[R]) -> [R; N] {
    let mut c = [R::ZERO; N];
    c.iter_mut().zip(v.iter().chain(tau)).for_each(|(to, from)| *to = *from);
    c
}

/// ‖p^{−½}·‖² of the Raviart–Thomas field with these outward fluxes, behind so many coefficients of v.
pub(super) fn energy<R: Real, const N: usize>(
    factor: &Factor<R>,
    gradients: usize,
    out: &[R],
) -> R {
    let none = [R::ZERO; ON_QUAD];
    let (v, _) = none.split_at(gradients.min(ON_QUAD));
    squares(factor, &coefficients::<R, N>(v, out))[0]
}

/// The share of a cell: coefficients of s and u_h, fluxes of τ and τ − σ_h.
pub(super) fn share<R: Real, const N: usize, const V: usize>(
    factor: &Factor<R>,
    [_, beyond]: Above<R>,
    [s, u]: [[R; V]; 2],
    [tau, difference]: [&[R]; 2],
    load: R,
) -> CellTerms<R> {
    let none = [R::ZERO; ON_QUAD];
    let of = |v: &[R], tau: &[R]| squares(factor, &coefficients::<R, N>(v, tau));
    let [gap, size] = of(&s, tau);
    let ([_, size_of_s], [_, size_of_u]) = (of(&s, &[]), of(&u, &[]));
    let (_, above) = factor.split_at((N * (N + 1) / 2).min(ENTRIES));
    let mut jump = s;
    jump.iter_mut().zip(u).for_each(|(s, u)| *s -= u);
    let [nonconforming, _] = of(&jump, &[]);
    let [algebraic, _] = of(none.split_at(V.min(ON_QUAD)).0, difference);
    let terms = tau.iter().fold(load * load, |sum, &flux| sum + flux * flux);
    let (four, scale) = (R::from_count(4), R::ONE + beyond);
    CellTerms {
        gap,
        algebraic,
        nonconforming: scale * nonconforming,
        // A sum of twelve products loses eight ε of their moduli at most; the bound takes four.
        uncertainty: four * size + softness::<R, N>(factor, V) * terms,
        uncertainty_of_u: four * R::TWO * scale * (size_of_s + size_of_u),
        terms,
        open: squares(above, &s)[0],
    }
}
