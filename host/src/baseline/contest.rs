//! How a solver is measured: at equal error, cold and warm.
//!
//! * Cold: all that follows the matrix and the load, symbolic passes and factorisations included.
//! * Warm: tick after tick with new loads and bounds; what the tick before left may be used, and memory,
//!   patterns and factors stand. The median over the ticks is what counts, and the slowest is recorded.
//! * Repeats: each goes on for 100 ms and counts by its fastest pass, since a processor that has slept is slow at first
//!   and whatever else a shared machine does only adds to a pass; where a pass takes longer it is the only one. The
//!   median over the repeats is what counts. On condensed problems all solvers take turns, so that everybody has
//!   repeats in the same good and bad times.
//! * Equal error: the loosest tolerance among 0.1, 0.01, … whose answers all lie within `target` of the
//!   discrete solution; warm starts begin the search with that of the cold one. It is found before anything is timed. Exact
//!   methods and solvers left as they come have one answer; `algebraic_error` tells how near it is.

use crate::cycles;
use crate::error::Result;
use crate::trade::record::Baseline;

use super::quadratic::Quadratic;
use super::series::Series;

/// Repeats of a solver alone, and of several in turns.
const REPEATS: [usize; 2] = [5, 9];

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

/// A solver on its way through the starts: `Err` once it has failed.
struct Competitor<'e> {
    name: &'e str,
    contestant: Result<Box<dyn Contestant + 'e>>,
    /// Of the last start.
    series: Series,
    found: Vec<Baseline>,
}

impl<'e> Competitor<'e> {
    fn new(name: &'e str, contestant: Result<Box<dyn Contestant + 'e>>) -> Self {
        Self { name, contestant, series: Series::default(), found: Vec::new() }
    }

    /// Has it do some `work`, unless it has failed.
    fn attempt(&mut self, work: impl FnOnce(&mut dyn Contestant, &mut Series) -> Result<()>) {
        let Ok(contestant) = &mut self.contestant else { return };
        if let Err(error) = work(&mut **contestant, &mut self.series) {
            self.contestant = Err(error);
        }
    }

    fn result(self) -> Result<Vec<Baseline>> {
        self.contestant.map(|_| self.found)
    }
}

impl Contest<'_> {
    /// Cold and warm.
    pub fn hold(&self, solver: &str, contestant: &mut dyn Contestant) -> Result<Vec<Baseline>> {
        self.alone(solver, contestant, &[Start::Cold, Start::Warm])
    }

    /// These starts of one solver.
    pub fn alone(
        &self,
        solver: &str,
        contestant: &mut dyn Contestant,
        starts: &[Start],
    ) -> Result<Vec<Baseline>> {
        let mut one = [Competitor::new(solver, Ok(Box::new(contestant)))];
        starts.iter().for_each(|&start| self.measure(&mut one, start, REPEATS[0]));
        let [one] = one;
        one.result()
    }

    /// Both starts of several solvers, which take turns.
    pub fn hold_in_turns<'e>(
        &self,
        entrants: Vec<Entrant<'e>>,
    ) -> Vec<(&'static str, Result<Vec<Baseline>>)> {
        let (names, mut all): (Vec<_>, Vec<_>) = entrants
            .into_iter()
            .map(|(name, contestant)| (name, Competitor::new(name, contestant)))
            .unzip();
        self.measure(&mut all, Start::Cold, REPEATS[1]);
        self.measure(&mut all, Start::Warm, REPEATS[1]);
        names.into_iter().zip(all.into_iter().map(Competitor::result)).collect()
    }

    /// One start of all who are still there. A warm one needs more than one tick.
    fn measure(&self, all: &mut [Competitor], start: Start, repeats: usize) {
        if start == Start::Warm && self.quadratic.ticks.len() < 2 {
            return;
        }
        for one in &mut *all {
            one.attempt(|contestant, series| self.trial(contestant, start, series));
        }
        for _ in 0..repeats {
            for one in &mut *all {
                one.attempt(|contestant, series| self.repeat(contestant, start, series));
            }
        }
        for one in all.iter_mut().filter(|one| one.contestant.is_ok()) {
            one.found.push(self.baseline(one.name, start, &one.series));
        }
    }
}
