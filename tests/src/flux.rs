//! The recovered flux: normal components from (15), the field between them from RT₀.

use std::collections::BTreeMap;

use crate::cell::Cell;
use crate::contact::Solution;
use crate::elimination::solve;
use crate::field::{Point, dot};
use crate::grid::Edge;
use crate::problem::{Boundary, Problem};
use crate::quadrature::{edge_mean, gauss_legendre};

/// u_E of the edges of a cell, in their local order.
pub fn cell_means(problem: &Problem, solution: &Solution, cell: usize) -> Vec<f64> {
    problem.grid.cell_edges(cell).iter().map(|e| solution.means[e]).collect()
}

/// |E| σ_h·n_T for the edges of a cell, outward, by (15):
/// ∫_T A∇u_h·∇φ_E − ∫_T f̄ φ_E.
pub fn cell_flux(problem: &Problem, solution: &Solution, cell: usize) -> Vec<f64> {
    let means = cell_means(problem, solution, cell);
    let load = problem.cell_load(cell);
    let product = |row: &Vec<f64>| row.iter().zip(&means).map(|(k, u)| k * u).sum::<f64>();
    problem.cell_stiffness(cell).iter().zip(load).map(|(row, b)| product(row) - b).collect()
}

/// σ_h·n_T, outward, for each cell and each of its edges.
pub fn normal_flux(problem: &Problem, solution: &Solution) -> BTreeMap<(usize, Edge), f64> {
    let mut normal = BTreeMap::new();
    for k in 0..problem.grid.cell_count() {
        let cell = Cell::of(&problem.grid, k);
        let flux = cell_flux(problem, solution, k);
        for (i, e) in problem.grid.cell_edges(k).into_iter().enumerate() {
            normal.insert((k, e), flux[i] / cell.edge_length(i));
        }
    }
    normal
}

/// ∫_C (σ_h·n − q).
pub fn contact_force(problem: &Problem, solution: &Solution) -> f64 {
    let (normal, cells) = (normal_flux(problem, solution), problem.grid.edges());
    let force = |(e, condition): (&Edge, &Boundary)| match condition {
        Boundary::Contact { flux, .. } => {
            let ends @ [a, b] = problem.grid.ends(*e);
            let mean = edge_mean(flux, ends, problem.order);
            (normal[&(cells[e][0], *e)] - mean) * (b[0] - a[0]).hypot(b[1] - a[1])
        }
        _ => 0.0,
    };
    problem.boundary.iter().map(force).sum()
}

/// The field of RT₀ on one cell: τ = DF τ̂ / det DF, where τ̂ lies in the span of (1,0), (0,1) and
/// (x̂, ŷ) on the triangle, (x̂, 0), (0, ŷ) on the square.
#[derive(Clone, Debug)]
pub struct RaviartThomas {
    cell: Cell,
    coefficients: Vec<f64>,
}

impl RaviartThomas {
    /// The field whose outward fluxes ∫_E τ·n are given, edge by edge. Piola's map keeps them,
    /// so they are conditions on τ̂.
    pub fn new(cell: Cell, fluxes: Vec<f64>) -> Self {
        let (reference, m) = (cell.reference(), fluxes.len());
        let flux = |edge: usize, k: usize| -> f64 {
            let ([a, b], normal) = (reference.edge(edge), reference.scaled_normal(edge));
            let point = |t: f64| [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
            let sample = |(t, w): (f64, f64)| w * dot(fields(m, point(t))[k], normal);
            gauss_legendre(2).into_iter().map(sample).sum()
        };
        let matrix = (0..m).map(|edge| (0..m).map(|k| flux(edge, k)).collect()).collect();
        let coefficients = solve(matrix, fluxes).expect("edge fluxes are unisolvent");
        Self { cell, coefficients }
    }

    /// τ at a reference point.
    pub fn at(&self, r: Point) -> [f64; 2] {
        let fields = fields(self.coefficients.len(), r);
        let sum =
            |i: usize| self.coefficients.iter().zip(&fields).map(|(c, v)| c * v[i]).sum::<f64>();
        let (x, y) = (sum(0), sum(1));
        let [[a, b], [c, d]] = self.cell.jacobian(r);
        let determinant = a * d - b * c;
        [(a * x + b * y) / determinant, (c * x + d * y) / determinant]
    }
}

/// The spanning fields at a reference point, three or four of them.
fn fields(count: usize, [x, y]: Point) -> Vec<[f64; 2]> {
    match count {
        3 => vec![[1.0, 0.0], [0.0, 1.0], [x, y]],
        _ => vec![[1.0, 0.0], [0.0, 1.0], [x, 0.0], [0.0, y]],
    }
}
