//! Storage in the products of a step in time: the residuals of its equation and of that of the weights.
//!
//! ```text
//!   R = ∇·τ + f − k(s − s_old),   R_z = ∇·ζ + j − kz,   ∫R z + ∫R_z (u − s)     beside the products of the fluxes
//! ```
//! A mean over a cell is R̄, and R′ = R − R̄. Where k > 0 the means are products of their own, ⟨a, b⟩ = |T| a b/k of R̄, kz̄ + R̄_z and
//! kz̄. R′z is known, but for what f varies by, which is the oscillation of data. R_z′ is bounded ([`super`]).

use super::goal::Goal;
use super::squares::Products;
use signorini_certify::admissible::Admissible;
use signorini_certify::cell::Cell;
use signorini_certify::stored::stored_cells;
use signorini_problem::field::CellField;
use signorini_problem::quadrature::{DATA_POINTS, Point, gauss};
use signorini_problem::{Problem, Step};
use signorini_solve::ScalarKind;

/// Roundings of the terms of a sum over a cell.
const ROUNDINGS: f64 = 32.0;

/// The storage of a step's cells.
pub(super) struct Stored<'p> {
    problem: &'p Problem,
    step: &'p Step,
    /// k|T| of each cell, and k/(k + π²α/h²).
    cells: Vec<[f64; 2]>,
    /// Rounding of the terms of R in the scalar of s and τ: a cell that is in balance but for that counts as such.
    rounding: f64,
}

/// R and R_z at a point of a cell, z there, the size of what R is summed from, and the area that they stand for.
struct AtPoint {
    weight: f64,
    residual: f64,
    terms: f64,
    of_z: f64,
    z: f64,
}

impl<'p> Stored<'p> {
    /// Of a step; nothing where the problem is none.
    pub fn of(problem: &'p Problem, scalar: ScalarKind) -> Option<Self> {
        let step = problem.loads.step.as_ref()?;
        let cells = stored_cells(problem, step, &vec![0.0; problem.cells()]);
        let cells = cells.into_iter().map(|of| [of.content, of.shed]).collect();
        Some(Self { problem, step, cells, rounding: ROUNDINGS * scalar.epsilon() })
    }

    /// The products of cell `at` for s and τ, z and ζ.
    pub fn products(&self, at: usize, goal: &Goal, [s, z]: [&Admissible; 2]) -> Products {
        let [content, shed] = self.cells[at];
        if content <= 0.0 {
            return Products::default();
        }
        let points = self.points(at, goal, [s, z]);
        let sum = |of: &dyn Fn(&AtPoint) -> f64| -> f64 {
            points.iter().map(|point| point.weight * of(point)).sum()
        };
        let area = sum(&|_| 1.0);
        let k = content / area;
        let [residual, of_z] = [sum(&|at| at.residual), sum(&|at| at.of_z)].map(|x| x / area);
        let inside = sum(&|at| (at.of_z - of_z).powi(2)) / k;
        let rounded = self.rounding * sum(&|at| at.terms) / area;
        let surely = (residual.abs() - rounded).max(0.0);
        let terms = |at: &AtPoint| at.terms * at.z.abs();
        Products {
            residual: area * surely * surely / k,
            weights: area * of_z * of_z / k,
            both: 2.0 * sum(&|at| at.residual * at.z) + area * residual * of_z / k,
            off: ROUNDINGS * f64::EPSILON * sum(&terms) + area * rounded * of_z.abs() / k,
            sizes: [sum(&|at| k * at.z * at.z), sum(&|at| (k * at.z + at.of_z).powi(2) / k)],
            inside: [inside, shed * inside],
        }
    }

    fn points(&self, at: usize, goal: &Goal, [s, z]: [&Admissible; 2]) -> Vec<AtPoint> {
        let problem = self.problem;
        let (cell, begin) = (Cell::of(problem, at), &self.step.begin);
        let old = Admissible { vertices: &begin.vertices, bubbles: &begin.bubbles, ..*s };
        let [s_here, old_here, z_here] = [s, &old, z].map(|of| of.chordal(problem, at));
        let load = problem.loads.of_cell(at);
        let source = goal.sources.get(at).copied().unwrap_or(0.0);
        let [out, out_z] = [(s.tau, load), (z.tau, source)]
            .map(|(flux, load)| CellField::new(problem, at, flux, flux).surplus(load, &[]));
        let fluxes = problem.topology.edges_of(at).iter().map(|&edge| s.tau[edge as usize].abs());
        let size = load.abs() + fluxes.sum::<f64>();
        let points = if cell.is_affine() { 3 } else { DATA_POINTS };
        let points = cell.points(&gauss(points));
        let area: f64 = points.iter().map(|point| point.weight).sum();
        let k = self.cells[at][0] / area;
        let here = |point: &Point| {
            let local = cell.local(point.reference);
            // Divergences go with the inverse of the area element.
            let density = match cell {
                Cell::Triangle(_) => 1.0 / area,
                Cell::Quad(_) => 1.0 / local.determinant,
            };
            let [s, old, z] = [&s_here, &old_here, &z_here].map(|of| of.at(&local).value);
            AtPoint {
                weight: point.weight,
                residual: out * density - k * (s - old),
                terms: size * density + k * (s.abs() + old.abs()),
                of_z: out_z * density - k * z,
                z,
            }
        };
        points.iter().map(here).collect()
    }
}
