//! Clarabel, an interior-point method for cone programs.
//!
//! ```text
//!   minimise ½ uᵀPu + qᵀu,  Au + s = b, s ≥ 0:   P = K, q = −b, A = −1 on the contact unknowns, b = −ψ
//! ```
//! An interior point cannot start from an old answer: warm, new q and b go into a solver whose memory,
//! ordering and equilibration stand, and it iterates from its own start.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SupportedConeT};

use super::failed;
use super::quadratic::{Quadratic, QuadraticLoads};
use super::timed_solver::{InitialGuess, Run, TimedSolver, counted};
use signorini_scene::error::Result;

/// The solver on its problem.
pub(super) struct Clarabel<'q> {
    quadratic: &'q Quadratic,
    matrix: CscMatrix<f64>,
    constraints: CscMatrix<f64>,
    solver: Option<DefaultSolver<f64>>,
}

impl<'q> Clarabel<'q> {
    pub fn new(quadratic: &'q Quadratic) -> Self {
        let (n, contact, free) = (quadratic.matrix.order(), quadratic.contact(), quadratic.free());
        let (starts, rows, values) = quadratic.matrix.upper();
        let ends = (0..=n).map(|column| column.saturating_sub(free)).collect();
        let constraints =
            CscMatrix::new(contact, n, ends, (0..contact).collect(), vec![-1.0; contact]);
        let matrix = CscMatrix::new(n, n, starts, rows, values);
        Self { quadratic, matrix, constraints, solver: None }
    }
}

/// q and b.
fn vectors(tick: &QuadraticLoads) -> [Vec<f64>; 2] {
    [&tick.load, &tick.lower].map(|vector| vector.iter().map(|entry| -entry).collect())
}

pub(super) fn settings(tolerance: f64) -> DefaultSettings<f64> {
    DefaultSettings {
        verbose: false,
        max_threads: 1,
        presolve_enable: false,
        input_sparse_dropzeros: false,
        tol_gap_abs: tolerance,
        tol_gap_rel: tolerance,
        tol_feas: tolerance,
        ..DefaultSettings::default()
    }
}

impl TimedSolver for Clarabel<'_> {
    fn run(&mut self, tick: usize, start: InitialGuess, tolerance: f64) -> Result<Run> {
        let [q, b] = vectors(&self.quadratic.ticks[tick]);
        let cones = [SupportedConeT::NonnegativeConeT(self.quadratic.contact())];
        let (matrix, constraints) = (&self.matrix, &self.constraints);
        let kept = self.solver.take().filter(|_| start == InitialGuess::Warm);
        let (cycles, solver) = counted(|| {
            let mut solver = match kept {
                Some(mut solver) => {
                    solver.update_q(&q).map_err(failed)?;
                    solver.update_b(&b).map_err(failed)?;
                    solver
                }
                None => {
                    DefaultSolver::new(matrix, &q, constraints, &b, &cones, settings(tolerance))
                        .map_err(failed)?
                }
            };
            solver.solve();
            Ok::<_, signorini_scene::error::Error>(solver)
        });
        let solver = solver?;
        let (iterations, u) = (solver.solution.iterations, solver.solution.x.clone());
        self.solver = Some(solver);
        Ok(Run { cycles, iterations, u })
    }

    fn finest(&self) -> i32 {
        -12
    }
}
