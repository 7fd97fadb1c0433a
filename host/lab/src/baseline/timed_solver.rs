//! Who takes part in a contest, and in what.

use crate::cycles;
use signorini_scene::error::Result;

use super::quadratic::Quadratic;

/// What a solve begins with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum InitialGuess {
    Cold,
    /// From what the last run left.
    Warm,
}

impl InitialGuess {
    pub fn name(self) -> &'static str {
        match self {
            Self::Cold => "cold",
            Self::Warm => "warm",
        }
    }
}

/// One solve.
#[derive(Debug, Clone)]
pub(super) struct Run {
    pub cycles: f64,
    pub iterations: u32,
    pub u: Vec<f64>,
}

/// A solver with its problem.
pub(super) trait TimedSolver {
    /// Solves a tick and counts its own cycles: copies of data and of the answer are not part of it.
    fn run(&mut self, tick: usize, start: InitialGuess, tolerance: f64) -> Result<Run>;

    /// The exponent of the finest tolerance that makes sense.
    fn finest(&self) -> i32 {
        -13
    }
}

impl<C: TimedSolver + ?Sized> TimedSolver for &mut C {
    fn run(&mut self, tick: usize, start: InitialGuess, tolerance: f64) -> Result<Run> {
        (**self).run(tick, start, tolerance)
    }

    fn finest(&self) -> i32 {
        (**self).finest()
    }
}

/// The cycles of `work` and what it returns.
pub(super) fn counted<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let start = cycles::now();
    let result = work();
    (cycles::now().saturating_sub(start) as f64, result)
}

/// What is being measured.
pub(super) struct Contest<'q> {
    /// `full`, `condensed`, `conforming P1`.
    pub problem: &'static str,
    pub quadratic: &'q Quadratic,
    /// The energy distance that is small enough.
    pub target: f64,
}
