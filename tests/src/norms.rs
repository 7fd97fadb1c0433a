//! Errors against an exact solution, integrated with 16 × 16 points in each cell.

use crate::contact::Solution;
use crate::exact::Exact;
use crate::field::{apply, dot, minus};
use crate::flux::{RaviartThomas, cell_flux, cell_means};
use crate::problem::Problem;

/// Gauss points a direction; a low order misses up to 0.5 % where the gradient has a kink.
const ORDER: usize = 16;

/// The norms of the error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// |u − u_h|_{1,h}.
    pub h1: f64,
    /// ‖u − u_h‖.
    pub l2: f64,
    /// ‖σ − σ_h‖.
    pub flux: f64,
    /// ‖A^½ ∇_h(u − u_h)‖.
    pub energy: f64,
}

/// Of the discrete solution and the flux recovered from it.
pub fn errors(problem: &Problem, solution: &Solution, exact: &Exact) -> Errors {
    let mut sum = Errors::default();
    for k in 0..problem.grid.cell_count() {
        let element = problem.element(k);
        let means = cell_means(problem, solution, k);
        let flux = RaviartThomas::new(element.cell.clone(), cell_flux(problem, solution, k));
        for (r, w) in element.cell.rule(ORDER) {
            let weight = w * element.cell.determinant(r);
            let p = element.cell.map(r);
            let tensor = (exact.tensor)(p);
            let value = (exact.u)(p) - element.value(&means, r);
            let gradient = minus((exact.gradient)(p), element.gradient(&means, r));
            let sigma = minus(apply(tensor, (exact.gradient)(p)), flux.at(r));
            sum.l2 += weight * value * value;
            sum.h1 += weight * dot(gradient, gradient);
            sum.energy += weight * dot(apply(tensor, gradient), gradient);
            sum.flux += weight * dot(sigma, sigma);
        }
    }
    Errors {
        h1: sum.h1.sqrt(),
        l2: sum.l2.sqrt(),
        flux: sum.flux.sqrt(),
        energy: sum.energy.sqrt(),
    }
}
