//! The full problem of a scene over some ticks: as a [`Quadratic`], and for the projected SOR of the kernel.

use super::failed;
use super::quadratic::{Matrix, Quadratic, QuadraticLoads};
use super::series::{InitialGuess, Run, TimedSolver};
use crate::cycles::counted;
use signorini_kernel::flux_range::Spans;
use signorini_kernel::law::Law;
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::{Row, Rows};
use signorini_kernel::solver::{Outcome, Settings, Solver};
use signorini_kernel::system::System;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, Loads, Parts, Problem};
use signorini_reference::Factor;
use signorini_scene::Result;
use signorini_solve::Reduced;

/// Sweeps after which a solver is given up.
const MOST_SWEEPS: u32 = 100_000;
/// The residual at which trials of ω end.
const TRIAL: f64 = 1e-6;

/// The data of a tick as [`System`] takes them.
#[derive(Debug, Clone)]
pub(super) struct TickLoads<R> {
    pub load: Vec<R>,
    pub lower: Vec<R>,
    /// How far it is to the other end of each flux; nothing where none has a limit.
    pub spans: Vec<R>,
    /// Given values, behind the unknowns in u.
    pub dirichlet: Vec<R>,
    /// Where a cold start begins.
    pub start: Vec<R>,
}

impl<R: Scalar> TickLoads<R> {
    /// The law on the contact edges.
    pub fn law(&self) -> std::result::Result<Law<'_, R>, signorini_kernel::Error> {
        Ok(Law::above(&self.lower).with_spans(Spans::new(&self.spans)?))
    }
}

/// Sweeps over rows of `WIDTH` entries.
pub(super) struct Psor<'a, R: Scalar, const WIDTH: usize> {
    /// Its load and bounds are replaced every tick.
    system: System<'a, R, u32>,
    ticks: &'a [TickLoads<R>],
    /// Where a cold search for ω begins, or the ω itself.
    relaxation: Relaxation<R>,
    rows: Vec<Row<R, u32, WIDTH>>,
    u: Vec<R>,
    omega: R,
}

impl<'a, R: Scalar, const WIDTH: usize> Psor<'a, R, WIDTH> {
    /// With ω found while sweeping; a warm tick goes on from the one of the tick before.
    pub fn adaptive(system: System<'a, R, u32>, ticks: &'a [TickLoads<R>]) -> Self {
        let rows = vec![Row::EMPTY; system.counts().unknowns()];
        let relaxation = Relaxation::Adaptive(R::ONE);
        Self { system, ticks, relaxation, rows, u: Vec::new(), omega: R::ONE }
    }

    /// With the best of some fixed ω, tried on the first tick beforehand.
    pub fn tuned(system: System<'a, R, u32>, ticks: &'a [TickLoads<R>]) -> Result<Self> {
        let mut psor = Self::adaptive(system, ticks);
        let lines = (system.counts().unknowns() as f64).sqrt();
        let mut best = (u32::MAX, R::ONE);
        for distance in [2.0, 3.0, 4.0, 5.0, 6.5, 8.0, 11.0] {
            let omega = R::narrow((2.0 - distance / lines).max(1.0));
            psor.relaxation = Relaxation::Fixed(omega);
            let run = psor.run(0, InitialGuess::Cold, TRIAL)?;
            if run.iterations < best.0 {
                best = (run.iterations, omega);
            }
        }
        psor.relaxation = Relaxation::Fixed(best.1);
        Ok(psor)
    }

    fn relaxation(&self, start: InitialGuess) -> Relaxation<R> {
        match (start, self.relaxation) {
            (InitialGuess::Warm, Relaxation::Adaptive(_)) => Relaxation::Adaptive(self.omega),
            (_, relaxation) => relaxation,
        }
    }
}

impl<R: Scalar, const WIDTH: usize> TimedSolver for Psor<'_, R, WIDTH> {
    fn run(&mut self, tick: usize, start: InitialGuess, tolerance: f64) -> Result<Run> {
        let given = &self.ticks[tick];
        let law = given.law().map_err(failed)?;
        let system = self.system.with_data(&given.load, law).map_err(failed)?;
        let relaxation = self.relaxation(start);
        let unknowns = system.counts().unknowns();
        let (rows, u) = (&mut self.rows, &mut self.u);
        let (cycles, outcome) = match start {
            InitialGuess::Cold => counted(|| {
                u.clone_from(&given.start);
                let mut rows = Rows::of_matrix(system.matrix(), system.counts(), rows)?;
                solve(&system, &mut rows, relaxation, tolerance, u)
            }),
            InitialGuess::Warm => {
                let mut rows =
                    Rows::of_matrix(system.matrix(), system.counts(), rows).map_err(failed)?;
                counted(|| {
                    u[unknowns..].copy_from_slice(&given.dirichlet);
                    solve(&system, &mut rows, relaxation, tolerance, u)
                })
            }
        };
        let outcome = outcome.map_err(failed)?;
        self.omega = outcome.omega;
        let u = self.u[..unknowns].iter().map(|u| u.wide()).collect();
        Ok(Run { cycles, iterations: outcome.sweeps, u })
    }

    fn finest(&self) -> i32 {
        if R::EPSILON.wide() > 1e-10 { -8 } else { -13 }
    }
}

/// Sweeps until the scaled residual is below `tolerance`.
pub(super) fn solve<R: Scalar, const WIDTH: usize>(
    system: &System<R, u32>,
    rows: &mut Rows<R, u32, WIDTH>,
    relaxation: Relaxation<R>,
    tolerance: f64,
    u: &mut [R],
) -> std::result::Result<Outcome<R>, signorini_kernel::Error> {
    let settings = Settings {
        relaxation,
        tolerance: R::narrow(tolerance),
        max_sweeps: MOST_SWEEPS,
        ..Settings::default()
    };
    Solver::new(settings)?.run(system, rows, u)
}

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
