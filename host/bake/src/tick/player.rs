//! Ticks of a scene with parts that contact alone or nothing holds.
//!
//! There whole parts may have to be shifted, which the kernel's solver does and its tick does not: each
//! tick is a solve, started from the last answer with the relaxation factor found there, and then
//! certified.

use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::{self, Row, Rows};
use signorini_kernel::solver::{Outcome, Settings, Solver, Status};
use signorini_kernel::system::System;
use signorini_kernel::{Error as KernelError, contact};

use super::Budget;
use signorini_certify::{Certified, Data, ErrorBound};
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, Parts, Problem};
use signorini_scene::error::Result;
use signorini_solve::{centre_floating, status_name, unfit};

/// Everything that stays from tick to tick.
#[derive(Debug)]
pub struct Player<'p, R: Scalar> {
    assembled: Assembled<'p, R>,
    settings: Settings<R>,
    /// The last answer; `None` before the first tick and where the last one is not finite.
    u: Option<Vec<R>>,
}

/// The answer of one tick; its numbers are not finite where `status` says so.
#[derive(Debug, Clone)]
pub struct PlayedTick {
    /// How the solve ended.
    pub status: &'static str,
    /// Sweeps spent.
    pub sweeps: u32,
    /// Mean of u_h over each edge.
    pub u: Vec<f64>,
    /// ∫_E σ·n for each edge.
    pub flux: Vec<f64>,
    /// ∫_C (τ·n − q) ≥ 0, τ within the law of contact.
    pub contact_force: f64,
    /// Σ|E| over the active contact edges.
    pub contact_length: f64,
    /// The bound on its error, where there is one.
    pub bound: Option<ErrorBound>,
    /// What it is the bound of.
    pub certified: signorini_certify::CertifiedFields,
}

impl<'p, R: Scalar> Player<'p, R> {
    /// Assembles `problem` for many ticks.
    ///
    /// # Errors
    /// Numbers that the scalar type cannot hold.
    pub fn new(problem: &'p Problem, budget: &Budget) -> Result<Self> {
        let assembled = Assembled::new(problem).map_err(unfit::<R>(&problem.scene))?;
        Ok(Self { assembled, settings: budget.settings(), u: None })
    }

    /// Solves for the loads of `problem`, which is that of [`Player::new`] at another time.
    ///
    /// # Errors
    /// No solution, numbers that the scalar type cannot hold.
    pub fn tick(&mut self, problem: &Problem) -> Result<PlayedTick> {
        let parts = Parts::examine(problem)?;
        self.assembled.set_parts(&parts);
        let mut answer = self.solve(problem).map_err(unfit::<R>(&problem.scene))?;
        if let Some(u) = &self.u {
            let assembled = &self.assembled;
            let data = Data::new(problem)?;
            let certified = Certified::new(problem, &parts, assembled, &data, u);
            let certified = certified.map_err(unfit::<R>(&problem.scene))?;
            (answer.bound, answer.certified) = (certified.bound, certified.answer);
        }
        if parts.counts.floating > 0 {
            centre_floating(problem, &parts, &mut answer.u, &mut answer.certified.vertices);
        }
        Ok(answer)
    }

    fn solve(&mut self, problem: &Problem) -> std::result::Result<PlayedTick, KernelError> {
        let counts = problem.topology.counts;
        self.assembled.set_loads(&problem.loads)?;
        let mut u = self.u.take().unwrap_or_else(|| self.assembled.start());
        u[counts.unknowns()..].copy_from_slice(self.assembled.dirichlet());
        let run = if problem.mesh.quads.is_empty() {
            sweep::<R, { rows::TRIANGLES }>
        } else {
            sweep::<R, { rows::QUADS }>
        };
        let outcome = run(&self.assembled, self.settings, &mut u)?;
        let answer = self.answer(problem, &outcome, &u)?;
        if outcome.status != Status::NotFinite {
            self.settings.relaxation = Relaxation::Adaptive(outcome.omega);
            self.u = Some(u);
        }
        Ok(answer)
    }

    fn answer(
        &self,
        problem: &Problem,
        outcome: &Outcome<R>,
        u: &[R],
    ) -> std::result::Result<PlayedTick, KernelError> {
        let (assembled, counts) = (&self.assembled, problem.topology.counts);
        let mut fluxes = vec![R::ZERO; u.len()];
        assembled.recover(u, &[], &mut fluxes)?;
        let touching =
            (0..counts.contact).filter(|&at| contact::is_active(counts, assembled.law(), u, at));
        let wide = |numbers: &[R]| numbers.iter().map(|x| x.wide()).collect();
        let force = contact::force(counts, &assembled.boundary()?, assembled.law(), u, &fluxes);
        Ok(PlayedTick {
            status: status_name(outcome.status),
            sweeps: outcome.sweeps,
            u: wide(u),
            flux: wide(&fluxes),
            contact_force: force.wide(),
            contact_length: touching.fold(0.0, |sum, at| sum + problem.lengths[counts.free + at]),
            bound: None,
            certified: signorini_certify::CertifiedFields::default(),
        })
    }
}

/// Sweeps over rows of `WIDTH` entries until the solve ends.
fn sweep<R: Scalar, const WIDTH: usize>(
    assembled: &Assembled<R>,
    settings: Settings<R>,
    u: &mut [R],
) -> std::result::Result<Outcome<R>, KernelError> {
    let system: System<R, u32> = assembled.system()?;
    let mut memory = vec![Row::<R, u32, WIDTH>::EMPTY; system.counts().unknowns()];
    let mut rows = Rows::new(assembled.edges(), &mut memory)?;
    Solver::<R>::new(settings)?.run(&system, &mut rows, u)
}
