//! Checks of the error bound on every scene, beside its exact solution where one is known.

use serde::Serialize;

use super::checks::Check;
use signorini_certify::{ErrorBound, eigenvalues};
use signorini_problem::Problem;
use signorini_scene::Result;
use signorini_solve::Solution;
use signorini_solve::norms::{Errors, of_solution};

/// Slack for total ≥ combined: the error itself is integrated with 16×16 points per cell, which near
/// kinks of the exact gradient leaves 1e−5 of it.
const INTEGRATED: f64 = 1e-5;
/// gap / identity: 1 up to that quadrature, which may miss more of the terms along C, of either sign.
const IDENTITY: [f64; 2] = [1.0 - 2e-3, 1.02];
/// gap / combined at convergence on grids with 16 squares across: what is lost where contact ends.
const SHARP: f64 = 1.06;
/// gap / ‖A^½∇_h(u − u_h)‖ at convergence: √2 where s and σ_h err alike.
const EFFICIENT: f64 = 2.0;
/// Beyond this condition number of A in a cell, s is a poor average and the ratio is only reported.
const OBLIQUE: f64 = 10.0;
/// gap / ‖A^½∇_h(u − u_h)‖ of any iterate.
const CUT_OFF: f64 = 8.0;
/// A gap below this part of the energy is rounding: the exact solution lies in the discrete space.
const ROUNDING: f64 = 1e-5;

/// The bound of one iterate, and how wrong it is.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub struct Certified {
    pub sweeps: u32,
    /// `None`: contact alone holds a part, and cannot take its surplus.
    pub bound: Option<ErrorBound>,
    /// Distance to the exact solution, where one is known.
    pub errors: Option<Errors>,
}

impl Certified {
    pub fn new(problem: &Problem, solution: &Solution) -> Result<Self> {
        let errors = of_solution(problem, solution)?;
        Ok(Self { sweeps: solution.sweeps, bound: solution.bound, errors })
    }

    /// The distance of what the bound is about.
    pub fn error(&self) -> Option<f64> {
        self.errors.and_then(|errors| errors.combined)
    }

    /// gap over the energy error of u_h, where both are more than rounding of a solution of this energy.
    pub fn efficiency(&self, energy: f64) -> Option<f64> {
        let bound = self.bound.filter(|bound| bound.duality_gap >= ROUNDING * energy)?;
        Some(bound.duality_gap / self.errors?.energy)
    }

    fn guarantee(&self, subject: &str, energy: f64) -> Vec<Check> {
        let (Some(bound), Some(errors)) = (self.bound, self.errors) else { return Vec::new() };
        let (Some(combined), Some(identity)) = (errors.combined, errors.identity) else {
            return Vec::new();
        };
        let safe = "the true error is at most the bound: total / error";
        let mut checks =
            vec![Check::at_least(subject, safe, bound.total / combined, 1.0 - INTEGRATED)];
        if bound.duality_gap >= ROUNDING * energy {
            let claim =
                "the bound is what its terms in the exact solution add up to: gap / identity";
            checks.push(Check::between(subject, claim, bound.duality_gap / identity, IDENTITY));
        }
        checks
    }

    pub fn when_cut_off(&self, subject: &str, energy: f64) -> Vec<Check> {
        let mut checks = self.guarantee(subject, energy);
        checks.extend(self.efficiency(energy).map(|ratio| {
            Check::at_most(subject, "cut off: gap / energy error of u_h", ratio, CUT_OFF)
        }));
        checks
    }

    pub fn when_converged(
        &self,
        subject: &str,
        problem: &Problem,
        solution: &Solution,
    ) -> Vec<Check> {
        let energy = solution.energy(problem);
        let mut checks = self.guarantee(subject, energy);
        let parts = solution.parts;
        if parts.contact + parts.floating == 0 {
            let found =
                self.bound.map_or("none".to_owned(), |bound| format!("{:.2e}", bound.total));
            let finite = self.bound.is_some_and(|bound| bound.total.is_finite());
            checks.push(Check::holds(subject, "a held domain has a bound", finite, &found));
        }
        let Some(efficiency) = self.efficiency(energy) else { return checks };
        if let (Some(bound), Some(combined)) = (self.bound, self.error()) {
            let claim = "the bound is sharp: gap / error";
            checks.push(Check::at_most(subject, claim, bound.duality_gap / combined, SHARP));
        }
        if condition(problem) <= OBLIQUE {
            let claim = "gap / energy error of u_h where cond A ≤ 10";
            checks.push(Check::at_most(subject, claim, efficiency, EFFICIENT));
        }
        checks
    }
}

/// The largest condition number of A over the cells.
fn condition(problem: &Problem) -> f64 {
    let of_cell = |cell| {
        let [low, high] = eigenvalues(&problem.mean_conductivity(cell));
        high / low
    };
    (0..problem.cells()).map(of_cell).fold(1.0, f64::max)
}
