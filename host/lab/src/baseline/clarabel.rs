//! Clarabel, an interior-point method for cone programs.
//!
//! ```text
//!   minimise ½ zᵀPz + qᵀz,  Az + s = b, s ≥ 0:   A = −C, b = −r, the rest as [`Program`] has it
//! ```
//! An interior point cannot start from an old answer: warm, new q and b go into a solver whose memory,
//! ordering and equilibration stand, and it iterates from its own start.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SupportedConeT};

use super::failed;
use super::quadratic::{Matrix, Program, Quadratic};
use super::series::{InitialGuess, Run, TimedSolver};
use crate::cycles::counted;
use signorini_scene::Result;

pub(super) struct Clarabel<'q> {
    quadratic: &'q Quadratic,
    program: Program,
    matrix: CscMatrix<f64>,
    constraints: CscMatrix<f64>,
    solver: Option<DefaultSolver<f64>>,
}

impl<'q> Clarabel<'q> {
    pub fn new(quadratic: &'q Quadratic) -> Result<Self> {
        let program = Program::new(quadratic)?;
        let columns = |rows, sign: f64, of: &Matrix| {
            let [starts, at] =
                [&of.row_ptr, &of.col_idx].map(|of| of.iter().map(|&at| at as usize).collect());
            let values = of.values.iter().map(|value| sign * value).collect();
            CscMatrix::new(rows, of.order(), starts, at, values)
        };
        let matrix = columns(program.matrix.order(), 1.0, &program.matrix);
        let constraints = columns(program.count, -1.0, &program.constraints);
        Ok(Self { quadratic, program, matrix, constraints, solver: None })
    }
}

fn settings(tolerance: f64) -> DefaultSettings<f64> {
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
        let tick = &self.quadratic.ticks[tick];
        let q = self.program.cost(tick);
        let b: Vec<f64> = self.program.least(tick).iter().map(|least| -least).collect();
        let cones = [SupportedConeT::NonnegativeConeT(self.program.count)];
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
        let mut u = solver.solution.x.clone();
        u.truncate(tick.load.len());
        let iterations = solver.solution.iterations;
        self.solver = Some(solver);
        Ok(Run { cycles, iterations, u })
    }

    fn finest(&self) -> i32 {
        -12
    }
}
