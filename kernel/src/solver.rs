//! The solver loop: sweeps, the stopping test, and how a solve can end.
//!
//! The stopping test is the complementarity residual of [`crate::system`], never the step from
//! one sweep to the next. It costs a matrix product, so it is taken once every block of sweeps.

use core::marker::PhantomData;

use crate::error::{Array, Error, same_length};
use crate::relaxation::{Relaxation, Search};
use crate::rows::Rows;
use crate::system::{Residual, System};
use crate::{Index, Libm, Math, Real, psor, shift};

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

/// Settings of a solve, fixed while it runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings<R> {
    /// How ω is chosen.
    pub relaxation: Relaxation<R>,
    /// Bound on [`Residual::scaled`]; 0 asks for the rounding limit.
    pub tolerance: R,
    /// Bound on the error of u, relative like the residual, as far as an adaptive ω can tell it (see
    /// `amplification` in the source); infinite where the residual alone shall decide.
    pub accuracy: R,
    /// The least size of u that the residual is related to; 0 where u itself shall tell.
    pub scale: R,
    /// Most sweeps allowed.
    pub max_sweeps: u32,
}

impl<R: Real> Default for Settings<R> {
    /// Adaptive ω, down to the rounding limit, a million sweeps.
    fn default() -> Self {
        Self {
            relaxation: Relaxation::Adaptive(R::ONE),
            tolerance: R::ZERO,
            accuracy: R::ONE / R::ZERO,
            scale: R::ZERO,
            max_sweeps: 1_000_000,
        }
    }
}

impl<R: Real> Settings<R> {
    /// How much larger than the residual the error of u may be, 1/λ_min of D⁻¹K.
    ///
    /// The best ω tells it: √(1 − μ²) = (2 − ω)/ω and λ_min = 1 − μ give λ_min ≈ (2 − ω)²/8. At a
    /// contrast of 10⁴ this reaches 10⁷, and a residual of 1e−11 is no comfort.
    pub fn amplification(&self, omega: R) -> R {
        match self.relaxation {
            Relaxation::Fixed(_) => R::ONE,
            Relaxation::Adaptive(_) => R::from_count(8) / ((R::TWO - omega) * (R::TWO - omega)),
        }
    }

    /// Whether an iterate with this residual is good enough.
    pub fn is_met(&self, residual: &Residual<R>, omega: R) -> bool {
        let scaled = residual.largest / residual.scale().or_larger(self.scale);
        scaled <= self.tolerance && scaled * self.amplification(omega) <= self.accuracy
    }
}

/// Outcome of a solve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outcome<R> {
    /// How it ended.
    pub status: Status,
    /// Sweeps done in all.
    pub sweeps: u32,
    /// Iterations of conjugate gradients among them, where sweeps alone would not have ended.
    pub conjugate: u32,
    /// The residual of the iterate.
    pub residual: Residual<R>,
    /// The last ω.
    pub omega: R,
}

/// A solve in progress: advance it one sweep at a time, or [`Solver::run`] it to its end.
#[derive(Debug, Clone, Copy)]
pub struct Solver<R, M = Libm> {
    settings: Settings<R>,
    search: Search<R>,
    sweeps: u32,
    next_look: u32,
    last_look: u32,
    best: Best<R>,
    math: PhantomData<M>,
}

/// A residual up to this multiple of [`Residual::rounding`] may be all rounding. Slow, smooth parts of
/// the error can hide below it and still be a thousand times larger in u, so a solve has ended
/// there only when a third of all its sweeps brought no further fall.
const ROUNDING: u32 = 4;

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
        let search = Search::checked(settings.relaxation)?;
        let best = Best { largest: None, sweeps: 0 };
        let next_look = search.block();
        Ok(Self { settings, search, sweeps: 0, next_look, last_look: 0, best, math: PhantomData })
    }

    /// Makes `u` feasible and `rows` those of `system`; says so where nothing is left to do. To be
    /// called once before [`Solver::step`].
    ///
    /// # Errors
    /// Arrays that do not belong to the same mesh.
    pub fn start<I: Index, const WIDTH: usize>(
        &mut self,
        system: &System<R, I>,
        rows: &mut Rows<R, I, WIDTH>,
        u: &mut [R],
    ) -> Result<Option<Outcome<R>>, Error> {
        same_length(Array::Unknowns, u.len(), system.counts().edges())?;
        system.make_feasible(u);
        rows.set(system, self.search.omega)?;
        let residual = system.residual(u);
        Ok(self.judge(&residual).map(|status| self.outcome(status, residual)))
    }

    /// One sweep; says how the solve ended where this was its last one.
    ///
    /// # Errors
    /// Arrays that do not belong to the same mesh.
    pub fn step<I: Index, const WIDTH: usize>(
        &mut self,
        system: &System<R, I>,
        rows: &mut Rows<R, I, WIDTH>,
        u: &mut [R],
    ) -> Result<Option<Outcome<R>>, Error> {
        if self.sweeps >= self.settings.max_sweeps {
            return Ok(Some(self.outcome(Status::OutOfSweeps, system.residual(u))));
        }
        psor::sweep(rows, system.law(), u)?;
        self.sweeps += 1;
        if self.sweeps < self.next_look.min(self.settings.max_sweeps) {
            return Ok(None);
        }
        let ended = self.look(system, u);
        if self.search.omega != rows.omega() {
            rows.set(system, self.search.omega)?;
        }
        Ok(ended)
    }

    /// Sweeps until the solve ends. `u` is the start (any values; the gap lifts it) and the answer;
    /// `rows` is memory to sweep over, of the numbering that `system` has.
    ///
    /// # Errors
    /// Arrays that do not belong to the same mesh.
    pub fn run<I: Index, const WIDTH: usize>(
        &mut self,
        system: &System<R, I>,
        rows: &mut Rows<R, I, WIDTH>,
        u: &mut [R],
    ) -> Result<Outcome<R>, Error> {
        let mut ended = self.start(system, rows, u)?;
        loop {
            match ended {
                Some(outcome) => return Ok(outcome),
                None => ended = self.step(system, rows, u)?,
            }
        }
    }

    fn look<I: Index>(&mut self, system: &System<R, I>, u: &mut [R]) -> Option<Outcome<R>> {
        shift::all(system, u);
        let residual = system.residual(u);
        if let Some(status) = self.judge(&residual) {
            return Some(self.outcome(status, residual));
        }
        let block = self.sweeps - self.last_look;
        // Near the rounding limit the residual falls slowly whatever ω is.
        if block.is_power_of_two() && !self.at_limit(&residual) {
            self.search.look::<M>(residual.sum, residual.active, block);
        }
        self.last_look = self.sweeps;
        self.next_look = self.sweeps.saturating_add(self.search.block());
        None
    }

    fn judge(&mut self, residual: &Residual<R>) -> Option<Status> {
        // Next to an infinite size everything is small.
        let Residual { largest, range, load, rounding, .. } = residual;
        if [largest, range, load, rounding].iter().any(|size| !size.finite()) {
            return Some(Status::NotFinite);
        }
        if self.settings.is_met(residual, self.search.omega) {
            return Some(Status::Converged);
        }
        let noticeably = R::ONE - R::QUARTER * R::HALF;
        if self.best.largest.is_none_or(|best| residual.largest < best * noticeably) {
            self.best = Best { largest: Some(residual.largest), sweeps: self.sweeps };
        }
        let waited = self.sweeps - self.best.sweeps;
        let blocks = if self.at_limit(residual) { 4 } else { 16 };
        let long = waited > self.sweeps / 3 && waited >= blocks * self.search.block();
        // An ω close to 2 keeps rounding errors alive for 1/(2 − ω) sweeps: they add up.
        let kept = residual.largest * (R::TWO - self.search.omega);
        let only_rounding = kept <= R::from_count(ROUNDING) * residual.rounding;
        let patience = PATIENCE.max(8 * self.search.block());
        if waited > patience || long && only_rounding {
            return Some(if only_rounding { Status::RoundingLimit } else { Status::Stalled });
        }
        if self.sweeps >= self.settings.max_sweeps { Some(Status::OutOfSweeps) } else { None }
    }

    fn at_limit(&self, residual: &Residual<R>) -> bool {
        residual.largest <= R::from_count(ROUNDING) * residual.rounding
    }

    fn outcome(&self, status: Status, residual: Residual<R>) -> Outcome<R> {
        Outcome { status, sweeps: self.sweeps, conjugate: 0, residual, omega: self.search.omega }
    }
}
