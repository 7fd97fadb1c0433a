//! Fluxes inside a cell that balance what means leave out: the oscillation of data where A or the cell is stretched.
//!
//! For any ρ on a cell T with ρ·n = 0 on its sides, and any v in H¹(T),
//! ```text
//!   ∫_T (f − f̄) v = −∫_T ρ·∇v + ∫_T (f − f̄ − ∇·ρ) v ≤ (‖A^{−½}ρ‖ + (d/π) ‖f − f̄ − ∇·ρ‖) ‖A^½∇v‖.
//! ```
//! The rest has no mean, and d is the diameter of T in the metric of A⁻¹: Poincaré's inequality on the convex cell that
//! x ↦ A^{−½}x makes of T. Every ρ holds; a good one lies along the directions in which A conducts. Where A varies,
//! [`super::stretch::floor`] ≤ A stands for it on both sides.
//!
//! On a triangle e_i is the side opposite of vertex i, and
//! ```text
//!   ρ = Σ k_i λ_j λ_l e_i,   ∇·ρ = Σ (k_{i+2} − k_{i+1}) λ_i
//! ```
//! are the quadratic fields with ρ·n = 0: all linear functions without a mean are such a ∇·ρ, and the k that all three have in
//! common is free. On a quad, with Legendre's polynomials P and their integrals I, which are 0 at both ends,
//! ```text
//!   det DF (f − f̄) ≈ Σ c_ij P_i(x̂) P_j(ŷ),   ρ = DF φ/det DF   with
//!   φ = (Σ c_ij I_i(x̂) P_j(ŷ), 0) for j = 0,   (0, Σ c_ij P_i(x̂) I_j(ŷ)) for i = 0,   θ of the one and 1 − θ of the other else.
//! ```
//! k and θ are those of the least ‖A^{−½}ρ‖. Between quads ρ·n may be any [`super::profile`]: φ is linear from side to side then,
//! and what that takes from c_0j and c_i0 no longer leads around.

mod quad;
mod triangle;

use std::f64::consts::PI;

use signorini_kernel::Tensor;
use signorini_kernel::element::rannacher_turek::place;

use super::cell::Cell;
use super::conductivity::{inverse, product};
use super::legendre::{DEGREES, legendre};
use super::profile::{InRows, Sides};
use signorini_problem::quadrature::Point;

/// A flux ρ in a cell.
#[derive(Debug, Clone)]
pub struct LocalFlux {
    /// ‖A^{−½}ρ‖
    pub norm: f64,
    /// d/π, what a rest costs that ∇·ρ leaves.
    pub reach: f64,
    divergence: Divergence,
}

/// A number for each P_i(x̂) P_j(ŷ).
type Factors<T> = [[T; DEGREES]; DEGREES];

/// ∇·ρ by the factors of ρ.
#[derive(Debug, Clone)]
enum Divergence {
    /// k
    Triangle([f64; 3]),
    /// θ c_ij and (1 − θ) c_ij, with what the sides make of them.
    Quad(Box<Factors<[f64; 2]>>),
}

impl LocalFlux {
    /// The flux whose divergence is fitted to values of f − f̄ at points, those of the square of `rule` on `cell`; `a` is below
    /// A all over it. Through the sides of a quad `sides` leaves.
    pub fn fitted(
        cell: &Cell,
        a: &Tensor<f64>,
        rule: &[[f64; 2]],
        (points, values): (&[Point], &[f64]),
        sides: &Sides,
    ) -> Self {
        let metric = inverse(a);
        let corners = cell.corners().iter();
        let pairs = corners.flat_map(|a| cell.corners().iter().map(|b| [a[0] - b[0], a[1] - b[1]]));
        let diameter = pairs.map(|v| product(&metric, v, v)).fold(0.0, f64::max).sqrt();
        let (square, divergence) = match cell {
            Cell::Triangle(corners) => {
                let (square, k) = triangle::fitted(corners, &metric, points, values);
                (square, Divergence::Triangle(k))
            }
            Cell::Quad(corners) => {
                let factors = quad::of_values(rule, points, values);
                let (square, factors) = quad::fitted(*corners, &metric, rule, factors, sides);
                (square, Divergence::Quad(factors))
            }
        };
        Self { norm: square.max(0.0).sqrt(), reach: diameter / PI, divergence }
    }

    /// ‖A^{−½}ρ‖ with the same divergence on a quad, where `sides` leaves through its sides; infinite on a triangle.
    pub fn norm_through(
        &self,
        cell: &Cell,
        a: &Tensor<f64>,
        rule: &[[f64; 2]],
        sides: &Sides,
    ) -> f64 {
        let (Cell::Quad(corners), Divergence::Quad(factors)) = (cell, &self.divergence) else {
            return f64::INFINITY;
        };
        let factors = factors.map(|row| row.map(|[along, across]| along + across));
        quad::fitted(*corners, &inverse(a), rule, factors, sides).0.max(0.0).sqrt()
    }

    /// The factors by rows of a quad; nothing on a triangle.
    pub fn in_rows(&self, cell: &Cell, a: &Tensor<f64>) -> Option<InRows> {
        let (Cell::Quad(corners), Divergence::Quad(factors)) = (cell, &self.divergence) else {
            return None;
        };
        let (here, metric) = (place(*corners, [0.5, 0.5]), inverse(a));
        let weights = here.directions().map(|v| product(&metric, v, v) / here.determinant);
        let sum = |i: usize, j: usize| factors[i][j][0] + factors[i][j][1];
        let along = ([weights[0], weights[1]], std::array::from_fn(|n| sum(0, n)));
        let across = ([weights[1], weights[0]], std::array::from_fn(|n| sum(n, 0)));
        Some(InRows([along, across]))
    }

    /// ∇·ρ at a point given by its reference coordinates, where the area element is `determinant`.
    pub fn divergence(&self, reference: [f64; 3], determinant: f64) -> f64 {
        match &self.divergence {
            Divergence::Triangle(k) => {
                (0..3).map(|i| (k[(i + 2) % 3] - k[(i + 1) % 3]) * reference[i]).sum()
            }
            Divergence::Quad(factors) => {
                let [along, across] = [0, 1].map(|k| legendre(reference[k]));
                let row = |row: &[[f64; 2]]| -> f64 {
                    row.iter().zip(across).map(|([a, b], p)| (a + b) * p).sum()
                };
                let sum: f64 = factors.iter().zip(along).map(|(of, p)| p * row(of)).sum();
                sum / determinant
            }
        }
    }

    /// The largest |∇·ρ| where one reference coordinate is complex and in the ellipse of `rho`, at least 2, around the cell: there
    /// |P_n| ≤ rhoⁿ, and |λ| ≤ rho. The area element is at least `determinant` there.
    pub fn modulus(&self, rho: f64, determinant: f64) -> f64 {
        match &self.divergence {
            Divergence::Triangle(k) => {
                rho * (0..3).map(|i| (k[(i + 2) % 3] - k[(i + 1) % 3]).abs()).sum::<f64>()
            }
            Divergence::Quad(factors) => {
                let of = |i: usize, j: usize| {
                    let [a, b] = factors[i][j];
                    (a + b).abs() * rho.powi(i.max(j) as i32)
                };
                let rows = (0..DEGREES).map(|i| (0..DEGREES).map(|j| of(i, j)).sum::<f64>());
                rows.sum::<f64>() / determinant
            }
        }
    }
}

#[cfg(test)]
mod tests;
