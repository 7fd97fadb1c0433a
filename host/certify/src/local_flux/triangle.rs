//! Quadratic fluxes inside a triangle.

use super::super::conductivity::product;
use signorini_kernel::Tensor;
use signorini_problem::quadrature::Point;

/// ‖A^{−½}ρ‖² and k on a triangle.
pub(super) fn fitted(
    corners: &[[f64; 2]; 3],
    metric: &Tensor<f64>,
    points: &[Point],
    values: &[f64],
) -> (f64, [f64; 3]) {
    let mut moments = [0.0; 3];
    let mut area = 0.0;
    for (point, value) in points.iter().zip(values) {
        area += point.weight;
        (0..3).for_each(|i| moments[i] += point.weight * value * point.reference[i]);
    }
    // ∫λ_i λ_j = |T|/12 (1 + δ_ij), and the values at the corners of a linear function without a mean add up to 0.
    let mean = moments.iter().sum::<f64>() / 3.0;
    let linear = moments.map(|moment| 12.0 / area * (moment - mean));
    let sides =
        [0, 1, 2].map(|i| [0, 1].map(|k| corners[(i + 2) % 3][k] - corners[(i + 1) % 3][k]));
    // 180/|T| ∫λ_jλ_l λ_mλ_n = 2 of one product, 1 of two.
    let form = |k: [f64; 3], m: [f64; 3]| {
        let pair = |i: usize, j: usize| if i == j { 2.0 } else { 1.0 };
        let of =
            |i: usize, j: usize| pair(i, j) * k[i] * m[j] * product(metric, sides[i], sides[j]);
        let sum: f64 = (0..9).map(|at| of(at / 3, at % 3)).sum();
        area / 180.0 * sum
    };
    let k = [0.0, linear[2], -linear[1]];
    let common = form([1.0; 3], k) / form([1.0; 3], [1.0; 3]);
    let k = k.map(|k| k - common);
    (form(k, k), k)
}
