//! A cold start from coarse to fine: the coarsest grid is solved, and each answer is where the next
//! finer grid begins.
//!
//! The best ω is about 2 − c/n on a grid with n lines: what a grid has found tells the next one half of
//! that distance from 2 to begin its search with. All grids are solved to the same residual; all of them
//! and the prolongations are counted, the search for the coarse cells is not: it belongs to the meshes.

use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::{Row, Rows, TRIANGLES};
use signorini_kernel::system::System;
use signorini_kernel::{Error as KernelError, Real};
use signorini_solve::prolongation::{Origin, prolong};

use super::failed;
use super::psor::{Full, TickLoads, solve};
use super::series::{InitialGuess, Run, TimedSolver};
use crate::cycles::counted;
use signorini_problem::Problem;
use signorini_scene::Result;
use signorini_session::coarse;

struct Level<'a> {
    system: System<'a, f64, u32>,
    given: &'a TickLoads<f64>,
    /// Where its edges lie in the grid before; none for the coarsest.
    origins: Vec<Origin<f64, u32>>,
    rows: Vec<Row<f64, u32, TRIANGLES>>,
}

/// Nested grids, the coarsest first.
pub(super) struct Cascade<'a> {
    levels: Vec<Level<'a>>,
}

impl<'a> Cascade<'a> {
    /// Of problems of triangles and their systems, the coarsest first.
    pub fn new(grids: &'a [(&Problem, &Full<f64>)]) -> Result<Self> {
        let mut levels = Vec::new();
        for (at, (problem, full)) in grids.iter().enumerate() {
            let origins = match at.checked_sub(1) {
                None => Vec::new(),
                Some(before) => coarse::origins(problem, grids[before].0)?,
            };
            let system = full.system()?;
            let rows = vec![Row::EMPTY; system.counts().unknowns()];
            levels.push(Level { system, given: &full.ticks[0], origins, rows });
        }
        Ok(Self { levels })
    }
}

impl TimedSolver for Cascade<'_> {
    fn starts(&self) -> &'static [InitialGuess] {
        &[InitialGuess::Cold]
    }

    /// Solves the first tick, whichever is asked for.
    fn run(&mut self, _: usize, _: InitialGuess, tolerance: f64) -> Result<Run> {
        let (cycles, outcome) = counted(|| {
            let (mut u, mut omega, mut sweeps) = (Vec::new(), 1.0, 0);
            for level in &mut self.levels {
                let outcome = level.solve(&mut u, omega, tolerance)?;
                omega = 2.0 - f64::HALF * (2.0 - outcome.0);
                sweeps = outcome.1;
            }
            Ok::<_, KernelError>((u, sweeps))
        });
        let (mut u, iterations) = outcome.map_err(failed)?;
        let unknowns = self.levels.last().map_or(0, |level| level.system.counts().unknowns());
        u.truncate(unknowns);
        Ok(Run { cycles, iterations, u })
    }
}

impl Level<'_> {
    /// Takes u of the grid before and leaves its own; returns ω and the sweeps.
    fn solve(
        &mut self,
        u: &mut Vec<f64>,
        omega: f64,
        tolerance: f64,
    ) -> std::result::Result<(f64, u32), KernelError> {
        let system = self.system.with_data(&self.given.load, self.given.law()?)?;
        let unknowns = system.counts().unknowns();
        let mut fine = self.given.start.clone();
        if !self.origins.is_empty() {
            prolong(&self.origins, u, &mut fine)?;
            fine[unknowns..].copy_from_slice(&self.given.dirichlet);
        }
        let mut rows = Rows::of_matrix(system.matrix(), system.counts(), &mut self.rows)?;
        let relaxation = Relaxation::Adaptive(omega);
        let outcome = solve(&system, &mut rows, relaxation, tolerance, &mut fine)?;
        *u = fine;
        Ok((outcome.omega, outcome.sweeps))
    }
}
