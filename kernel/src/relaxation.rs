//! The relaxation factor ω: given, or found while the solver runs.
//!
//! A tuned ω is worth a factor 20 in sweeps. For a consistently ordered matrix Young's relation ties
//! the observed convergence factor R of a run with ω below the optimum to the spectral radius μ of
//! the Jacobi matrix, and μ to the best ω:
//! ```text
//!   (R + ω − 1)² = R ω² μ²,        ω_best = 2 / (1 + √(1 − μ²)).
//! ```
//! The matrices here are only nearly so ordered; the relation still finds a good ω in a few stages,
//! after Hageman and Young: start at ω = 1, observe R over a block of sweeps, and move up when R is
//! worse than (ω − 1)^¾, a factor that an ω near the optimum would not show. Any ω in (0, 2)
//! converges, and ω moves a bounded number of times, so convergence is never at stake. The memory
//! is a handful of scalars.

use crate::math::Math;
use crate::real::Real;

/// How ω is chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Relaxation<R> {
    /// This value, inside (0, 2).
    Fixed(R),
    /// Estimated from the convergence observed, starting from this value in \[1, 2).
    Adaptive(R),
}

/// The state of the estimate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Estimate<R> {
    pub(crate) omega: R,
    adaptive: bool,
    previous: Option<(R, u32)>,
    moves: u32,
}

/// ω moves at most this often; each move shortens 2 − ω, and twelve reach its lower limit.
const MOVES: u32 = 24;

impl<R: Real> Estimate<R> {
    pub(crate) fn new(relaxation: Relaxation<R>) -> Self {
        let (omega, adaptive) = match relaxation {
            Relaxation::Fixed(omega) => (omega, false),
            Relaxation::Adaptive(start) => (start, true),
        };
        Self { omega, adaptive, previous: None, moves: 0 }
    }

    /// Sweeps until the next look: long enough for the transient of a new ω, whose length is
    /// 1/(2 − ω), to have passed; always a power of two.
    pub(crate) fn block(&self) -> u32 {
        let mut sweeps = 4;
        let mut time = R::TWO + R::TWO;
        while sweeps < 1024 && time * (R::TWO - self.omega) < R::TWO {
            sweeps *= 2;
            time *= R::TWO;
        }
        sweeps
    }

    /// Looks at the size of the residual after a block of `sweeps` (a power of two).
    pub(crate) fn observe<M: Math<R>>(&mut self, size: R, active: u32, sweeps: u32) {
        let before = self.previous.replace((size, active));
        let Some((earlier, active_earlier)) = before.filter(|_| self.adaptive) else { return };
        if active != active_earlier || self.moves >= MOVES || !(size < earlier) {
            return;
        }
        let mut factor = size / earlier;
        for _ in 0..sweeps.trailing_zeros() {
            factor = M::sqrt(factor);
        }
        if let Some(omega) = better::<R, M>(self.omega, factor) {
            self.omega = omega;
            self.moves += 1;
            self.previous = None;
        }
    }
}

/// The ω that the observed convergence factor asks for, where that is a real step upwards.
fn better<R: Real, M: Math<R>>(omega: R, factor: R) -> Option<R> {
    let over = omega - R::ONE;
    let root = M::sqrt(over);
    let expected = root * M::sqrt(root);
    if !(factor > expected && factor < R::ONE) {
        return None;
    }
    let sum = factor + over;
    let radius_squared = sum * sum / (factor * omega * omega);
    if !(radius_squared < R::ONE) {
        return None;
    }
    let best = R::TWO / (R::ONE + M::sqrt(R::ONE - radius_squared));
    let least = R::QUARTER * R::QUARTER * (R::TWO - omega);
    if best > omega + least { Some(best) } else { None }
}
