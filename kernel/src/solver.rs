//! The solver loop: sweeps, the stopping test, and how a solve can end.
//!
//! The stopping test is the complementarity residual of [`crate::signorini`], never the step from
//! one sweep to the next. It costs a matrix product, so it is taken once every block of sweeps.

use core::marker::PhantomData;

use crate::error::Error;
use crate::index::Index;
use crate::math::{Libm, Math};
use crate::psor;
use crate::real::Real;
use crate::relaxation::{Estimate, Relaxation};
use crate::signorini::{Residual, System};

/// How a solve ended. The iterate is the answer in every case but the last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// The scaled residual is below the tolerance.
    Converged,
    /// The residual is down to what rounding makes of it and falls no further.
    RoundingLimit,
    /// The sweeps allowed are used up; the iterate is feasible and can be carried on.
    OutOfSweeps,
    /// The residual has long stopped falling, far above rounding.
    Stalled,
    /// The iterate is infinite or NaN: the input was too large for the scalar type.
    NotFinite,
}

/// What to do, fixed during a solve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings<R> {
    /// How ω is chosen.
    pub relaxation: Relaxation<R>,
    /// Bound on [`Residual::scaled`]; 0 asks for the rounding limit.
    pub tolerance: R,
    /// Most sweeps allowed.
    pub max_sweeps: u32,
}

impl<R: Real> Default for Settings<R> {
    /// Adaptive ω, down to the rounding limit, a million sweeps.
    fn default() -> Self {
        Self { relaxation: Relaxation::Adaptive(R::ONE), tolerance: R::ZERO, max_sweeps: 1_000_000 }
    }
}

/// What came of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outcome<R> {
    /// How it ended.
    pub status: Status,
    /// Sweeps done in all.
    pub sweeps: u32,
    /// The residual of the iterate.
    pub residual: Residual<R>,
    /// The last ω.
    pub omega: R,
}

/// A solve in progress: advance it one sweep at a time, or [`Solver::run`] it to its end.
#[derive(Debug, Clone, Copy)]
pub struct Solver<R, M = Libm> {
    settings: Settings<R>,
    estimate: Estimate<R>,
    sweeps: u32,
    next_look: u32,
    last_look: u32,
    best: Best<R>,
    math: PhantomData<M>,
}

/// A residual below this multiple of [`Residual::rounding`] may be all rounding. It has ended only
/// when a third of all sweeps brought no further fall: slow, smooth parts of the error can hide
/// below the rounding of the others and still be a thousand times larger in u.
const ROUNDING_MULTIPLE: u32 = 32;

/// Sweeps without a fall of the residual after which a solve far above rounding has stalled.
const PATIENCE: u32 = 50_000;

/// The smallest residual so far and when it was seen.
#[derive(Debug, Clone, Copy)]
struct Best<R> {
    largest: Option<R>,
    sweeps: u32,
}

impl<R: Real> Solver<R> {
    /// A solver with correctly rounded square roots.
    ///
    /// # Errors
    /// [`Error::Relaxation`] where ω is not inside (0, 2), or a starting ω not in \[1, 2).
    pub fn new(settings: Settings<R>) -> Result<Self, Error> {
        Self::with_math(settings)
    }
}

impl<R: Real, M: Math<R>> Solver<R, M> {
    /// A solver whose ω is estimated with the square root of `M`.
    ///
    /// # Errors
    /// As for [`Solver::new`].
    pub fn with_math(settings: Settings<R>) -> Result<Self, Error> {
        let valid = match settings.relaxation {
            Relaxation::Fixed(omega) => omega > R::ZERO && omega < R::TWO,
            Relaxation::Adaptive(start) => start >= R::ONE && start < R::TWO,
        };
        if !valid {
            return Err(Error::Relaxation);
        }
        let estimate = Estimate::new(settings.relaxation);
        let best = Best { largest: None, sweeps: 0 };
        let next_look = estimate.block();
        Ok(Self { settings, estimate, sweeps: 0, next_look, last_look: 0, best, math: PhantomData })
    }

    /// One sweep; says how the solve ended where this was its last one.
    pub fn step<I: Index>(&mut self, system: &System<R, I>, u: &mut [R]) -> Option<Outcome<R>> {
        if self.sweeps >= self.settings.max_sweeps {
            return Some(self.outcome(Status::OutOfSweeps, system.residual(u)));
        }
        psor::sweep(system, u, self.estimate.omega);
        self.sweeps += 1;
        if self.sweeps < self.next_look.min(self.settings.max_sweeps) {
            return None;
        }
        self.look(system, u)
    }

    /// Sweeps until the solve ends. `u` is the start (any values; the gap lifts it) and the answer.
    pub fn run<I: Index>(&mut self, system: &System<R, I>, u: &mut [R]) -> Outcome<R> {
        system.make_feasible(u);
        let start = system.residual(u);
        if let Some(status) = self.judge(&start) {
            return self.outcome(status, start);
        }
        loop {
            if let Some(outcome) = self.step(system, u) {
                return outcome;
            }
        }
    }

    fn look<I: Index>(&mut self, system: &System<R, I>, u: &[R]) -> Option<Outcome<R>> {
        let residual = system.residual(u);
        if let Some(status) = self.judge(&residual) {
            return Some(self.outcome(status, residual));
        }
        let block = self.sweeps - self.last_look;
        if block.is_power_of_two() {
            self.estimate.observe::<M>(residual.sum, residual.active, block);
        }
        self.last_look = self.sweeps;
        self.next_look = self.sweeps.saturating_add(self.estimate.block());
        None
    }

    fn judge(&mut self, residual: &Residual<R>) -> Option<Status> {
        if !(residual.largest.finite() && residual.range.finite()) {
            return Some(Status::NotFinite);
        }
        if residual.scaled() <= self.settings.tolerance {
            return Some(Status::Converged);
        }
        let noticeably = R::ONE - R::QUARTER * R::HALF;
        if self.best.largest.is_none_or(|best| residual.largest < best * noticeably) {
            self.best = Best { largest: Some(residual.largest), sweeps: self.sweeps };
        }
        let waited = self.sweeps - self.best.sweeps;
        let at_limit = residual.largest <= R::from_count(ROUNDING_MULTIPLE) * residual.rounding;
        if at_limit && waited > self.sweeps / 3 && waited >= 4 * self.estimate.block() {
            return Some(Status::RoundingLimit);
        }
        if waited > PATIENCE {
            return Some(Status::Stalled);
        }
        if self.sweeps >= self.settings.max_sweeps { Some(Status::OutOfSweeps) } else { None }
    }

    fn outcome(&self, status: Status, residual: Residual<R>) -> Outcome<R> {
        Outcome { status, sweeps: self.sweeps, residual, omega: self.estimate.omega }
    }
}
