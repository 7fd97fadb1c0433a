//! From the text of a scene to its bound and the errors that it bounds.

use signorini_certify::ErrorBound;
use signorini_problem::Problem;
use signorini_scene::mesh::Mesh;
use signorini_solve::energy_norm::nonconformity;
use signorini_solve::norms::{Errors, errors, of_solution};
use signorini_solve::{Options, ScalarKind, Solution, solve};

use crate::standard;

/// A solved scene.
pub struct Run {
    pub problem: Problem,
    pub solution: Solution,
}

/// The bound, and the truth.
#[derive(Clone, Copy, Debug)]
pub struct Certified {
    pub bound: ErrorBound,
    pub combined: f64,
    pub identity: f64,
    /// ‖A^½∇_h(u − u_h)‖
    pub energy: f64,
    /// ‖A^½∇_h(s − u_h)‖
    pub nonconformity: f64,
}

/// In `scalar`, after at most `sweeps` sweeps.
pub fn options(scalar: ScalarKind, sweeps: Option<u32>) -> Options {
    Options { scalar, max_sweeps: sweeps, ..Options::default() }
}

/// A scene on its mesh.
pub fn posed(text: &str, mesh: Mesh) -> Problem {
    standard::posed(text, mesh).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Solves a scene that has a solution.
pub fn run(text: &str, mesh: Mesh, options: &Options) -> Run {
    let problem = posed(text, mesh);
    let solution = solve(&problem, options).unwrap_or_else(|error| panic!("{error}"));
    Run { problem, solution }
}

impl Run {
    /// The bound and all that it is compared with; `None` where there is no bound.
    pub fn certified(&self) -> Option<Certified> {
        let bound = self.solution.bound?;
        let found = of_solution(&self.problem, &self.solution).expect("finite");
        let Errors { combined, identity, energy, .. } = found.expect("an exact solution");
        let s = self.solution.certified.admissible();
        let nonconformity = nonconformity(&self.problem, &s, &self.solution.u);
        let nonconformity = nonconformity.expect("finite");
        Some(Certified { bound, combined: combined?, identity: identity?, energy, nonconformity })
    }

    /// ‖A^½∇_h(u − u_h)‖ alone, in half of the time.
    pub fn energy(&self) -> f64 {
        self.errors().energy
    }

    /// The errors of u_h and σ_h.
    pub fn errors(&self) -> Errors {
        let Self { problem, solution } = self;
        let exact = problem.scene.exact.as_ref().expect("an exact solution");
        errors(exact, problem, &solution.u, &solution.flux).expect("finite")
    }
}
