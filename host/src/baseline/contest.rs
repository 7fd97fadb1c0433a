//! How a solver is measured: at equal error, cold and warm.
//!
//! * Cold: all that follows the matrix and the load, symbolic passes and factorisations included.
//! * Warm: tick after tick with new loads and bounds; what the tick before left may be used, and memory,
//!   patterns and factors stand. The median over the ticks is what counts.
//! * Repeats: each goes on for 100 ms and counts by its fastest pass, since a processor that has slept is slow at first
//!   and whatever else a shared machine does only adds to a pass; where a pass takes longer it is the only one. The
//!   median over the repeats is what counts. On condensed problems
//!   all solvers take turns for some seconds, so that everybody has repeats in the same good and bad times.
//! * Equal error: the loosest tolerance among 0.1, 0.01, … whose answers all lie within `target` of the
//!   discrete solution. It is found before anything is timed. Exact methods and solvers left as they come have one
//!   answer; `algebraic_error` tells how near it is.

use std::time::Instant;

use crate::cycles;
use crate::error::Result;
use crate::trade::record::Baseline;

use super::quadratic::Quadratic;

/// Repeats of a measurement, and most of them where solvers take turns.
pub(super) const REPEATS: [usize; 2] = [5, 200];
/// Seconds that they take turns for.
const TURNS: f64 = 2.0;
/// Seconds after which no repeat begins.
pub(super) const PATIENCE: f64 = 2.0;

/// What a solve begins with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Start {
    Cold,
    /// From what the last run left.
    Warm,
}

impl Start {
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
pub(super) trait Contestant {
    /// Solves a tick and counts its own cycles: copies of data and of the answer are not part of it.
    fn run(&mut self, tick: usize, start: Start, tolerance: f64) -> Result<Run>;

    /// The exponent of the finest tolerance that makes sense.
    fn finest(&self) -> i32 {
        -13
    }
}

impl<C: Contestant + ?Sized> Contestant for &mut C {
    fn run(&mut self, tick: usize, start: Start, tolerance: f64) -> Result<Run> {
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

/// A solver's name, and the solver or why it cannot take part.
pub(super) type Entrant<'e> = (&'static str, Result<Box<dyn Contestant + 'e>>);

/// A solver that takes turns: the tolerance of its last start, and what was found of it.
struct Ready<'e> {
    contestant: Box<dyn Contestant + 'e>,
    exponent: i32,
    found: Vec<Baseline>,
}

impl<'e> Ready<'e> {
    fn new(contestant: Box<dyn Contestant + 'e>) -> Self {
        Self { contestant, exponent: 0, found: Vec::new() }
    }
}

impl Contest<'_> {
    /// Both starts.
    pub fn hold(&self, solver: &str, contestant: &mut dyn Contestant) -> Result<Vec<Baseline>> {
        let mut one = [(solver, Ok(Ready::new(Box::new(contestant))))];
        self.both(&mut one, 0.0);
        let [(_, ready)] = one;
        ready.map(|ready| ready.found)
    }

    /// A cold start alone.
    pub fn hold_cold(
        &self,
        solver: &str,
        contestant: &mut dyn Contestant,
    ) -> Result<Vec<Baseline>> {
        let mut one = [(solver, Ok(Ready::new(Box::new(contestant))))];
        self.turns(&mut one, Start::Cold, 0.0);
        let [(_, ready)] = one;
        ready.map(|ready| ready.found)
    }

    /// Both starts of several solvers, which take turns for some seconds.
    pub fn hold_in_turns<'e>(
        &self,
        entrants: Vec<Entrant<'e>>,
    ) -> Vec<(&'static str, Result<Vec<Baseline>>)> {
        let ready = |(name, entrant): Entrant<'e>| (name, entrant.map(Ready::new));
        let mut all: Vec<_> = entrants.into_iter().map(ready).collect();
        self.both(&mut all, TURNS);
        all.into_iter().map(|(name, ready)| (name, ready.map(|ready| ready.found))).collect()
    }

    /// A warm start needs more than one tick.
    fn both(&self, all: &mut [(&str, Result<Ready>)], seconds: f64) {
        self.turns(all, Start::Cold, seconds);
        if self.quadratic.ticks.len() > 1 {
            self.turns(all, Start::Warm, seconds);
        }
    }

    /// One start of all who are still there.
    fn turns(&self, all: &mut [(&str, Result<Ready>)], start: Start, seconds: f64) {
        let trial = |(_, ready): &mut (&str, Result<Ready>)| match ready {
            Ok(ready) => self.trial(&mut *ready.contestant, start, ready.exponent).map(Some),
            Err(_) => Ok(None),
        };
        let mut series: Vec<_> = all.iter_mut().map(trial).collect();
        let begin = Instant::now();
        for round in 0..REPEATS[1] {
            if round >= REPEATS[0] && begin.elapsed().as_secs_f64() >= seconds {
                break;
            }
            for ((_, ready), series) in all.iter_mut().zip(&mut series) {
                let (Ok(ready), Ok(Some(own))) = (ready, &mut *series) else { continue };
                if own.spent >= PATIENCE {
                    continue;
                }
                if let Err(error) = self.repeat(&mut *ready.contestant, start, own) {
                    *series = Err(error);
                }
            }
        }
        for ((name, ready), series) in all.iter_mut().zip(series) {
            match (&mut *ready, series) {
                (Ok(ready), Ok(Some(series))) => {
                    ready.exponent = series.exponent;
                    ready.found.push(self.baseline(name, start, &series));
                }
                (Ok(_), Err(error)) => *ready = Err(error),
                _ => {}
            }
        }
    }
}
