//! A solver as a contest runs it.

use crate::cycles;
use signorini_scene::error::Result;

/// The state that a solve begins with.
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

    /// The starts that the solver has.
    fn starts(&self) -> &'static [InitialGuess] {
        &[InitialGuess::Cold, InitialGuess::Warm]
    }

    /// The exponent of the finest tolerance that makes sense.
    fn finest(&self) -> i32 {
        -13
    }
}

/// The cycles of `work` and what it returns.
pub(super) fn counted<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let start = cycles::now();
    let result = work();
    (cycles::now().saturating_sub(start) as f64, result)
}
