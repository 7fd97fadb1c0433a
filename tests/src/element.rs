//! The nonconforming space NC₁ of one cell and the integrals that problem (14) needs.
//!
//! On the reference cell the functions are spanned by 1, x̂, ŷ and, on quads, x̂² − ŷ². The basis
//! function φ_E has mean 1 over edge E and 0 over the others: each is found by solving these
//! conditions. F is affine along an edge, so reference means are physical means.

use crate::cell::Cell;
use crate::elimination::solve;
use crate::field::{Point, apply, dot};
use crate::quadrature::edge_mean;
use std::sync::Arc;

/// The values of 1, x̂, ŷ, x̂² − ŷ² at a reference point.
fn monomials([x, y]: Point) -> [f64; 4] {
    [1.0, x, y, x * x - y * y]
}

/// Their reference gradients.
fn monomial_gradients([x, y]: Point) -> [[f64; 2]; 4] {
    [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [2.0 * x, -2.0 * y]]
}

/// A cell with its basis.
#[derive(Clone, Debug)]
pub struct Element {
    /// The cell.
    pub cell: Cell,
    /// Row i: the coefficients of φ_i in the monomials.
    basis: Vec<Vec<f64>>,
}

impl Element {
    /// Solves (mean of monomial k over edge j) c_k = δ_ij for each i.
    pub fn new(cell: Cell) -> Self {
        let (reference, m) = (cell.reference(), cell.corners.len());
        let mean = |j, k: usize| {
            edge_mean(&(Arc::new(move |p| monomials(p)[k]) as _), reference.edge(j), 2)
        };
        let means: Vec<Vec<f64>> = (0..m).map(|j| (0..m).map(|k| mean(j, k)).collect()).collect();
        let unit = |i: usize| (0..m).map(|j| if i == j { 1.0 } else { 0.0 }).collect();
        let coefficients = |i| solve(means.clone(), unit(i)).expect("edge means are unisolvent");
        let basis = (0..m).map(coefficients).collect();
        Self { cell, basis }
    }

    /// φ_i at a reference point.
    pub fn basis(&self, i: usize, r: Point) -> f64 {
        self.basis[i].iter().zip(monomials(r)).map(|(c, m)| c * m).sum()
    }

    /// ∇φ_i (physical) at a reference point: DF^{−T} times the reference gradient.
    pub fn basis_gradient(&self, i: usize, r: Point) -> [f64; 2] {
        let gradients = monomial_gradients(r);
        let sum =
            |k: usize| self.basis[i].iter().zip(gradients).map(|(c, g)| c * g[k]).sum::<f64>();
        let (gx, gy) = (sum(0), sum(1));
        let [[a, b], [c, d]] = self.cell.jacobian(r);
        let determinant = a * d - b * c;
        [(d * gx - c * gy) / determinant, (a * gy - b * gx) / determinant]
    }

    /// Σ_i u_i φ_i at a reference point.
    pub fn value(&self, means: &[f64], r: Point) -> f64 {
        means.iter().enumerate().map(|(i, u)| u * self.basis(i, r)).sum()
    }

    /// Σ_i u_i ∇φ_i at a reference point.
    pub fn gradient(&self, means: &[f64], r: Point) -> [f64; 2] {
        means.iter().enumerate().fold([0.0, 0.0], |[x, y], (i, u)| {
            let [gx, gy] = self.basis_gradient(i, r);
            [x + u * gx, y + u * gy]
        })
    }

    /// `K_T[i][j]` = ∫_T A∇φ_j·∇φ_i, with n points a direction.
    pub fn stiffness(&self, tensor: impl Fn(Point) -> [f64; 3], n: usize) -> Vec<Vec<f64>> {
        let m = self.cell.corners.len();
        let mut matrix = vec![vec![0.0; m]; m];
        for (r, w) in self.cell.rule(n) {
            let weight = w * self.cell.determinant(r);
            let a = tensor(self.cell.map(r));
            let gradients: Vec<_> = (0..m).map(|i| self.basis_gradient(i, r)).collect();
            for (i, row) in matrix.iter_mut().enumerate() {
                for (j, entry) in row.iter_mut().enumerate() {
                    *entry += weight * dot(apply(a, gradients[j]), gradients[i]);
                }
            }
        }
        matrix
    }

    /// ∫_T f, with n points a direction.
    pub fn source_integral(&self, source: impl Fn(Point) -> f64, n: usize) -> f64 {
        self.cell.integrate(n, |r| source(self.cell.map(r)))
    }

    /// f̄ at a reference point: ∫_T f over det DF times the reference area, so that
    /// ∫_T f̄ = ∫_T f. On triangles and parallelograms the plain mean of f.
    pub fn averaged_source(&self, source_integral: f64, r: Point) -> f64 {
        source_integral / (self.cell.determinant(r) * self.cell.reference_area())
    }

    /// ∫_T f̄ φ_i for each edge, with n points a direction.
    pub fn load(&self, source: impl Fn(Point) -> f64, n: usize) -> Vec<f64> {
        let total = self.source_integral(source, n);
        let entry =
            |i| self.cell.integrate(n, |r| self.averaged_source(total, r) * self.basis(i, r));
        (0..self.cell.corners.len()).map(entry).collect()
    }
}
