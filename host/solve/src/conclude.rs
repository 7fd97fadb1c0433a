//! From a problem to an iterate and on to a solution: assembly, then fluxes, the bound, and what is read off.

use std::time::Instant;

use signorini_kernel::solver::{Outcome, Status};
use signorini_kernel::{Error as KernelError, Real, contact};

use super::{
    Ending, Factored, Options, Ran, ScalarKind, Seconds, Solution, centre_floating, overflow, unfit,
};
use signorini_certify::{Certified, Data};
use signorini_problem::progress::stage;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, Parts, Problem};
use signorini_scene::error::Result;

/// A request to a solver.
#[derive(Clone, Copy)]
pub(super) struct Task<'t> {
    pub problem: &'t Problem,
    pub parts: &'t Parts,
    pub options: &'t Options,
    /// u to begin with; empty for a start of the solver's own.
    pub start: &'t [f64],
    /// Whether the loads are those of the scene, so that they can be had on another mesh.
    pub is_posed: bool,
}

/// A problem in the hands of a solver: assembled in its scalar.
pub(super) struct Attempt<'p, R: Scalar> {
    pub task: Task<'p>,
    pub assembled: Assembled<'p, R>,
    /// Seconds that it took.
    assembly: f64,
    /// Started after the assembly.
    clock: Clock,
}

/// An iterate, and how it was found.
pub(super) struct Solved<R> {
    pub outcome: Outcome<R>,
    pub ran: Ran,
    pub factored: Option<Factored>,
    pub u: Vec<R>,
    /// The low part of u, or nothing.
    pub low: Vec<R>,
}

impl<'p, R: Scalar> Attempt<'p, R> {
    /// Assembles the problem.
    pub fn new(task: &Task<'p>) -> Result<Self> {
        let (mut clock, scene) = (Clock::start(), &task.problem.scene);
        let assembled = Assembled::new(task.problem).map_err(unfit::<R>(scene))?;
        Ok(Self { task: *task, assembled, assembly: clock.lap(), clock })
    }

    /// u to begin with: what Dirichlet data and the start say, and 0.
    pub fn started(&self) -> Vec<R> {
        let unknowns = self.assembled.edges().counts().unknowns();
        let mut u = self.assembled.start();
        let own = u.iter_mut().take(unknowns).zip(self.task.start);
        own.for_each(|(u, &start)| *u = R::narrow(start));
        u
    }

    /// Fluxes, certificate and what is read off.
    pub fn conclude(self, solved: Solved<R>) -> Result<Solution> {
        let Self { task, assembled, assembly, mut clock } = self;
        let Task { problem, parts, options, .. } = task;
        let unfit = unfit::<R>(&problem.scene);
        let Solved { outcome, ran, factored, u, low } = solved;
        if outcome.status == Status::NotFinite {
            return Err(overflow::<R>(&problem.scene));
        }
        let solve = clock.lap();
        stage("fluxes and error bound");
        let data = Data::new(problem)?;
        let certified = Certified::new(problem, parts, &assembled, (&data, options.averages), &u);
        let certified = certified.map_err(&unfit)?;
        let certificate = clock.lap();
        let read = read_off(problem, parts, &assembled, &outcome, [&u, &low], certified);
        let read = read.map_err(&unfit)?;
        let seconds = Seconds { assembly, solve, flux: clock.lap(), certificate };
        Ok(Solution { scalar: ScalarKind::of::<R>(), ran, factored, seconds, ..read })
    }
}

/// Everything that is read off the iterate `u` with the low part `low` (may be empty): fluxes, force, active edges.
///
/// # Errors
/// Slices of the wrong length.
pub fn read_off<R: Scalar>(
    problem: &Problem,
    parts: &Parts,
    assembled: &Assembled<R>,
    outcome: &Outcome<R>,
    [u, low]: [&[R]; 2],
    certified: Certified,
) -> std::result::Result<Solution, KernelError> {
    let (counts, law) = (problem.topology.counts, assembled.law());
    let mut flux = vec![R::ZERO; u.len()];
    let found = assembled.recover(u, low, &mut flux)?;
    let force = contact::force(counts, &assembled.boundary()?, law, u, &flux).wide();
    let mismatch = found.mismatch.wide() / found.largest.wide().max(f64::TINY);
    let mut solution = Solution {
        status: Ending::Solve(outcome.status),
        sweeps: outcome.sweeps,
        conjugate: outcome.conjugate,
        algebraic_residual: outcome.residual.scaled().wide(),
        omega: outcome.omega.wide(),
        u: u.iter().map(|x| x.wide()).collect(),
        flux: flux.iter().map(|x| x.wide()).collect(),
        mismatch,
        contact_force: force,
        parts: parts.counts,
        bound: certified.bound,
        no_bound: certified.no_bound,
        certified: certified.answer,
        ..Solution::default()
    }
    .with_active(problem, (0..counts.contact).map(|at| contact::is_active(counts, law, u, at)));
    if parts.counts.floating > 0 {
        let (u, vertices) = (&mut solution.u, &mut solution.certified.vertices);
        centre_floating(problem, parts, u, vertices);
    }
    Ok(solution)
}

/// Seconds from lap to lap.
struct Clock(Instant);

impl Clock {
    fn start() -> Self {
        Self(Instant::now())
    }

    fn lap(&mut self) -> f64 {
        let lap = self.0.elapsed().as_secs_f64();
        self.0 = Instant::now();
        lap
    }
}
