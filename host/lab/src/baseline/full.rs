//! The full problem of a scene over some ticks: in the kernel's hands, and as a [`Quadratic`].

use signorini_kernel::system::System;

use super::failed;
use super::psor::TickLoads;
use super::quadratic::{Matrix, Quadratic, QuadraticLoads};
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, Loads, Parts, Problem};
use signorini_reference::Factor;
use signorini_scene::Result;
use signorini_solve::Reduced;

/// The kernel's system in the scalar `R`.
pub(super) struct Full<'p, R: Scalar> {
    assembled: Assembled<'p, R>,
    pub ticks: Vec<TickLoads<R>>,
}

impl<'p, R: Scalar> Full<'p, R> {
    /// Assembles the matrix once and the load of every moment.
    pub fn new(problem: &'p Problem, parts: &Parts, moments: &[Loads]) -> Result<Self> {
        let mut assembled = Assembled::new(problem).map_err(failed)?;
        assembled.set_parts(parts);
        let mut ticks = Vec::new();
        for moment in moments {
            assembled.set_loads(moment).map_err(failed)?;
            let system = assembled.system().map_err(failed)?;
            ticks.push(TickLoads {
                load: system.load().to_vec(),
                lower: system.law().lower().to_vec(),
                spans: system.law().spans().lengths().to_vec(),
                dirichlet: assembled.dirichlet().to_vec(),
                start: assembled.start(),
            });
        }
        Ok(Self { assembled, ticks })
    }

    /// Its matrix, with the data of the last moment.
    pub fn system(&self) -> Result<System<'_, R, u32>> {
        self.assembled.system().map_err(failed)
    }
}

/// The problem with given values moved to the right-hand side, solved.
pub(super) fn quadratic(
    problem: &Problem,
    parts: &Parts,
    moments: &[Loads],
) -> Result<(Quadratic, Factor)> {
    let mut assembled = Assembled::<f64>::new(problem).map_err(failed)?;
    let (mut matrix, mut floating, mut ticks) = (Matrix::new(), Vec::new(), Vec::new());
    for moment in moments {
        assembled.set_loads(moment).map_err(failed)?;
        let reduced = Reduced::new(problem, parts, &assembled, &assembled.start());
        let Reduced { row_ptr, col_idx, values, load, floating: held } = reduced.map_err(failed)?;
        let law = assembled.law();
        let (lower, spans) = (law.lower().to_vec(), law.spans().lengths().to_vec());
        ticks.push(QuadraticLoads::new(load, lower, spans));
        (matrix, floating) = (Matrix { row_ptr, col_idx, values }, held);
    }
    Quadratic::new(matrix, floating, ticks)
}
