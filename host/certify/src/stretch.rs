//! Cells that A or their shape stretches, and a tensor below A all over a cell.

use signorini_kernel::Tensor;

use super::cell::Cell;
use super::conductivity::{Conductivity, eigenvalues, product, smallest_eigenvalue};
use signorini_problem::Problem;
use signorini_problem::tensors::scaled;

/// Where d²/|T| in the metric of A is larger than for squares and their halves by no more than what their distortion makes of it,
/// Poincaré's inequality costs a factor of 2 at most. On triangles ρ is not much better where they are longer either: a v that
/// changes along them alone sees f − f̄ in its means across.
const EVEN: [f64; 2] = [8.0, 2.25];

/// Whether a cell, triangles first, is about as wide as long, seen with the least eigenvalue of A in its middle.
pub fn is_even(problem: &Problem, at: usize) -> bool {
    let cell = Cell::of(problem, at);
    let a = Conductivity::of(problem, at).at(cell.middle());
    let (determinant, even) = match cell {
        Cell::Triangle(_) => (cell.determinant([1.0 / 3.0; 3]), EVEN[0]),
        Cell::Quad(_) => (cell.determinant([0.5, 0.5, 0.0]), EVEN[1]),
    };
    let [least, most] = eigenvalues(&a);
    let ratio = cell.diameter().powi(2) / determinant * (most / least).sqrt();
    // What is no number keeps the plain inequality.
    ratio <= even || ratio.is_nan()
}

/// A tensor below A all over a cell, triangles first: A itself where it is constant, else a part of A in the middle.
pub fn floor(problem: &Problem, at: usize) -> Tensor<f64> {
    let a = Conductivity::of(problem, at);
    let middle = a.at(Cell::of(problem, at).middle());
    if a.is_constant() {
        return middle;
    }
    let floors = a.floors().into_iter();
    let parts = floors.map(|floor| smallest_eigenvalue(&relative(&floor, &middle)));
    scaled(&middle, parts.fold(1.0, f64::min))
}

/// L⁻¹ A L⁻ᵀ, LLᵀ = `to`: its eigenvalues λ are those of A v = λ `to` v.
fn relative(a: &Tensor<f64>, to: &Tensor<f64>) -> Tensor<f64> {
    let first = to.xx.sqrt();
    let below = to.xy / first;
    let last = ((to.xx * to.yy - to.xy * to.xy) / to.xx).sqrt();
    // Columns of L⁻ᵀ.
    let [p, q] = [[1.0 / first, 0.0], [-below / (first * last), 1.0 / last]];
    Tensor { xx: product(a, p, p), xy: product(a, p, q), yy: product(a, q, q) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Never above A in a rotated frame: v·Fv ≤ v·Av at every point, and equal to it somewhere.
    #[test]
    fn a_floor_is_below_as_forms() {
        let [a, b] =
            [Tensor { xx: 40.0, xy: 17.0, yy: 9.0 }, Tensor { xx: 30.0, xy: 14.0, yy: 11.0 }];
        let part = smallest_eigenvalue(&relative(&a, &b));
        let least = (0..1000).map(|k| {
            let v = [(f64::from(k) * PI / 1000.0).cos(), (f64::from(k) * PI / 1000.0).sin()];
            product(&a, v, v) / product(&b, v, v)
        });
        let least = least.fold(f64::INFINITY, f64::min);
        assert!(least >= part * (1.0 - 1e-12) && least < part * (1.0 + 1e-3), "{least} {part}");
    }
}
