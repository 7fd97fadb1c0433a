//! The geometry of one cell: the map F from the reference triangle or unit square.

use crate::field::{Point, minus};
use crate::grid::Grid;
use crate::quadrature::{self, Rule2};

/// A triangle or a convex quadrilateral, corners counterclockwise.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Three or four corners; edge i runs from corner i to corner i + 1, cyclically.
    pub corners: Vec<Point>,
}

impl Cell {
    /// A cell of a mesh.
    pub fn of(grid: &Grid, cell: usize) -> Self {
        let corners = grid.cell(cell).iter().map(|&v| grid.vertices[v as usize]).collect();
        Self { corners }
    }

    /// The reference cell of the same shape: (0,0), (1,0), (0,1) or the unit square.
    pub fn reference(&self) -> Self {
        let corners = match self.corners.len() {
            3 => vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
            _ => vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        };
        Self { corners }
    }

    /// The area of the reference cell.
    pub fn reference_area(&self) -> f64 {
        if self.corners.len() == 3 { 0.5 } else { 1.0 }
    }

    /// The vertex functions (barycentric or bilinear) at a reference point.
    fn vertex_functions(&self, [x, y]: Point) -> Vec<f64> {
        match self.corners.len() {
            3 => vec![1.0 - x - y, x, y],
            _ => vec![(1.0 - x) * (1.0 - y), x * (1.0 - y), x * y, (1.0 - x) * y],
        }
    }

    /// Their reference gradients.
    fn vertex_gradients(&self, [x, y]: Point) -> Vec<[f64; 2]> {
        match self.corners.len() {
            3 => vec![[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]],
            _ => vec![[y - 1.0, x - 1.0], [1.0 - y, -x], [y, x], [-y, 1.0 - x]],
        }
    }

    /// F(x̂) = Σ_v N_v(x̂) v.
    pub fn map(&self, reference: Point) -> Point {
        let weights = self.vertex_functions(reference);
        let sum = |k: usize| weights.iter().zip(&self.corners).map(|(w, v)| w * v[k]).sum();
        [sum(0), sum(1)]
    }

    /// DF(x̂); entry `[i][j]` is ∂F_i/∂x̂_j.
    pub fn jacobian(&self, reference: Point) -> [[f64; 2]; 2] {
        let gradients = self.vertex_gradients(reference);
        let sum = |i: usize, j: usize| {
            gradients.iter().zip(&self.corners).map(|(g, v)| g[j] * v[i]).sum()
        };
        [[sum(0, 0), sum(0, 1)], [sum(1, 0), sum(1, 1)]]
    }

    /// det DF(x̂), positive in a convex counterclockwise cell.
    pub fn determinant(&self, reference: Point) -> f64 {
        let [[a, b], [c, d]] = self.jacobian(reference);
        a * d - b * c
    }

    /// The end points of edge i, in the direction that keeps the cell on the left.
    pub fn edge(&self, i: usize) -> [Point; 2] {
        [self.corners[i], self.corners[(i + 1) % self.corners.len()]]
    }

    /// |E| n for edge i: its direction turned clockwise by 90°, which points outward.
    pub fn scaled_normal(&self, i: usize) -> [f64; 2] {
        let [a, b] = self.edge(i);
        let [x, y] = minus(b, a);
        [y, -x]
    }

    /// |E| for edge i.
    pub fn edge_length(&self, i: usize) -> f64 {
        let [x, y] = self.scaled_normal(i);
        x.hypot(y)
    }

    /// A rule on the reference cell with n points a direction.
    pub fn rule(&self, n: usize) -> Rule2 {
        if self.corners.len() == 3 { quadrature::triangle(n) } else { quadrature::square(n) }
    }

    /// ∫_T f dx with n points a direction; f is given the reference point.
    pub fn integrate(&self, n: usize, f: impl Fn(Point) -> f64) -> f64 {
        self.rule(n).into_iter().map(|(r, w)| w * self.determinant(r) * f(r)).sum()
    }
}
