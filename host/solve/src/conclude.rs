//! From an iterate to a solution: fluxes, the bound, and what is read off.

use std::time::Instant;

use signorini_kernel::solver::{Outcome, Status};
use signorini_kernel::{Error as KernelError, Real, contact};

use super::{Factored, Ran, ScalarKind, Seconds, Solution, centre_floating, overflow, unfit};
use signorini_certify::{Certified, Data};
use signorini_problem::progress::stage;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, Parts, Problem};
use signorini_scene::error::Result;
use signorini_scene::scene::units::Units;

/// An iterate, and the time up to its assembly.
pub(super) struct Solved<R> {
    pub outcome: Outcome<R>,
    pub ran: Ran,
    pub factored: Option<Factored>,
    pub u: Vec<R>,
    /// The low part of u, or nothing.
    pub low: Vec<R>,
    pub scalar: ScalarKind,
    pub assembly: f64,
    /// Started after the assembly.
    pub clock: Clock,
}

/// Fluxes, certificate and what is read off.
pub(super) fn conclude<R: Scalar>(
    problem: &Problem,
    parts: &Parts,
    assembled: &Assembled<R>,
    solved: Solved<R>,
) -> Result<Solution> {
    let unfit = unfit::<R>(&problem.scene);
    let Solved { outcome, ran, factored, u, low, scalar, assembly, mut clock } = solved;
    if outcome.status == Status::NotFinite {
        return Err(overflow::<R>(&problem.scene));
    }
    let solve = clock.lap();
    stage("fluxes and error bound");
    let Fluxes { flux, mismatch, force } = Fluxes::recover(assembled, &u, &low).map_err(&unfit)?;
    let fluxes = clock.lap();
    let data = Data::new(problem)?;
    let certified = Certified::new(problem, parts, assembled, &data, &u).map_err(&unfit)?;
    let seconds = Seconds { assembly, solve, flux: fluxes, certificate: clock.lap() };
    let (active, free) = (active(problem, assembled, &u), problem.topology.counts.free);
    let mut solution = Solution {
        scalar,
        status: outcome.status,
        sweeps: outcome.sweeps,
        conjugate: outcome.conjugate,
        ran,
        factored,
        units: Units::default(),
        scaled: None,
        algebraic_residual: outcome.residual.scaled().wide(),
        omega: outcome.omega.wide(),
        u: u.iter().map(|x| x.wide()).collect(),
        flux: flux.iter().map(|x| x.wide()).collect(),
        mismatch,
        contact_force: force,
        contact_length: active.iter().fold(0.0, |sum, at| sum + problem.lengths[free + at]),
        contact_active: active.len(),
        parts: parts.counts,
        bound: certified.bound,
        no_bound: certified.no_bound,
        certified: certified.answer,
        seconds,
    };
    if parts.counts.floating > 0 {
        let (u, vertices) = (&mut solution.u, &mut solution.certified.vertices);
        centre_floating(problem, parts, u, vertices);
    }
    Ok(solution)
}

/// The contact edges on which u = ψ.
fn active<R: Scalar>(problem: &Problem, assembled: &Assembled<R>, u: &[R]) -> Vec<usize> {
    let (counts, law) = (problem.topology.counts, assembled.law());
    (0..counts.contact).filter(|&at| contact::is_active(counts, law, u, at)).collect()
}

struct Fluxes<R> {
    flux: Vec<R>,
    mismatch: f64,
    force: f64,
}

impl<R: Scalar> Fluxes<R> {
    fn recover(
        assembled: &Assembled<R>,
        u: &[R],
        low: &[R],
    ) -> std::result::Result<Self, KernelError> {
        let edges = assembled.edges();
        let mut flux = vec![R::ZERO; u.len()];
        let found = assembled.recover(u, low, &mut flux)?;
        let (boundary, law) = (assembled.boundary()?, assembled.law());
        let force = contact::force(edges.counts(), &boundary, law, u, &flux).wide();
        let mismatch = found.mismatch.wide() / found.largest.wide().max(f64::TINY);
        Ok(Self { flux, mismatch, force })
    }
}

/// Seconds from lap to lap.
pub(super) struct Clock(Instant);

impl Clock {
    pub fn start() -> Self {
        Self(Instant::now())
    }

    pub fn lap(&mut self) -> f64 {
        let lap = self.0.elapsed().as_secs_f64();
        self.0 = Instant::now();
        lap
    }
}
