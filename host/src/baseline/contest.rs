//! How a solver is measured: at equal error, cold and warm.
//!
//! * Cold: all that follows the matrix and the load, symbolic passes and factorisations included.
//! * Warm: tick after tick with new loads and bounds; what the tick before left may be used, and memory,
//!   patterns and factors stand. The median over the ticks is what counts.
//! * Repeats: each goes on for 20 ms and counts by its fastest pass, since a processor that has slept is slow at first
//!   and whatever else a shared machine does only adds to a pass; where a pass takes longer it is the only one. The
//!   median over the repeats is what counts. On condensed problems
//!   all solvers take turns for some seconds, so that everybody has repeats in the same good and bad times.
//! * Equal error: the loosest tolerance among 0.1, 0.01, … whose answers all lie within `target` of the
//!   discrete solution. It is found before anything is timed. Exact methods and solvers left as they come have one
//!   answer; `algebraic_error` tells how near it is.

use std::iter::once;
use std::time::Instant;

use crate::cycles;
use crate::error::Result;
use crate::trade::record::Baseline;

use super::quadratic::Quadratic;

/// Repeats of a measurement, and most of them where solvers take turns.
const REPEATS: [usize; 2] = [5, 200];
/// Seconds of a repeat, at least.
const REPEAT: f64 = 0.02;
/// Seconds that they take turns for.
const TURNS: f64 = 2.0;
/// Seconds after which no repeat begins.
const PATIENCE: f64 = 2.0;

/// What a solve begins with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Start {
    Cold,
    /// From what the last run left.
    Warm,
}

impl Start {
    fn name(self) -> &'static str {
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

/// Runs over a row of ticks.
struct Pass {
    cycles: f64,
    iterations: u32,
    /// The largest of all ticks.
    distance: f64,
}

/// A solver's name, and the solver or why it cannot take part.
pub(super) type Entrant<'e> = (&'static str, Result<Box<dyn Contestant + 'e>>);

/// A solver that takes turns: the tolerance of its last start, and what was found of it.
struct Ready<'e> {
    contestant: Box<dyn Contestant + 'e>,
    exponent: i32,
    found: Vec<Baseline>,
}

/// The repeats of a solver at the loosest tolerance that will do, 10^`exponent`.
struct Series {
    exponent: i32,
    passes: Vec<Pass>,
    spent: f64,
}

impl Contest<'_> {
    /// Both starts.
    pub fn hold(&self, solver: &str, contestant: &mut dyn Contestant) -> Result<Vec<Baseline>> {
        let cold = self.series(contestant, Start::Cold, 0)?;
        let warm = self.warm_series(contestant, &cold)?;
        let warm = warm.map(|warm| self.baseline(solver, Start::Warm, &warm));
        Ok(once(self.baseline(solver, Start::Cold, &cold)).chain(warm).collect())
    }

    /// A cold start alone.
    pub fn hold_cold(&self, solver: &str, contestant: &mut dyn Contestant) -> Result<Baseline> {
        Ok(self.baseline(solver, Start::Cold, &self.series(contestant, Start::Cold, 0)?))
    }

    /// Both starts of several solvers, which take turns.
    pub fn hold_in_turns<'e>(
        &self,
        entrants: Vec<Entrant<'e>>,
    ) -> Vec<(&'static str, Result<Vec<Baseline>>)> {
        let ready = |(name, entrant): Entrant<'e>| {
            (name, entrant.map(|contestant| Ready { contestant, exponent: 0, found: Vec::new() }))
        };
        let mut all: Vec<_> = entrants.into_iter().map(ready).collect();
        self.turns(&mut all, Start::Cold);
        if self.quadratic.ticks.len() > 1 {
            self.turns(&mut all, Start::Warm);
        }
        all.into_iter().map(|(name, ready)| (name, ready.map(|ready| ready.found))).collect()
    }

    /// One start of all who are still there.
    fn turns(&self, all: &mut [(&'static str, Result<Ready>)], start: Start) {
        let trial = |(_, ready): &mut (_, Result<Ready>)| match ready {
            Ok(ready) => self.trial(&mut *ready.contestant, start, ready.exponent).map(Some),
            Err(_) => Ok(None),
        };
        let mut series: Vec<_> = all.iter_mut().map(trial).collect();
        let begin = Instant::now();
        for round in 0..REPEATS[1] {
            if round >= REPEATS[0] && begin.elapsed().as_secs_f64() > TURNS {
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

    /// Where there is more than one tick.
    fn warm_series(
        &self,
        contestant: &mut dyn Contestant,
        cold: &Series,
    ) -> Result<Option<Series>> {
        let has_ticks = self.quadratic.ticks.len() > 1;
        has_ticks.then(|| self.series(contestant, Start::Warm, cold.exponent)).transpose()
    }

    /// Finds the tolerance, below 10^`above`, then measures.
    fn series(&self, contestant: &mut dyn Contestant, start: Start, above: i32) -> Result<Series> {
        let mut series = self.trial(contestant, start, above)?;
        while series.passes.len() < REPEATS[0] && series.spent < PATIENCE {
            self.repeat(contestant, start, &mut series)?;
        }
        Ok(series)
    }

    /// Finds the tolerance, below 10^`above`. What takes long is measured with that.
    fn trial(&self, contestant: &mut dyn Contestant, start: Start, above: i32) -> Result<Series> {
        let mut exponent = above - i32::from(above == 0);
        let begin = Instant::now();
        let mut trial = self.pass(contestant, start, exponent)?;
        while trial.distance > self.target && exponent > contestant.finest() {
            exponent -= 1;
            trial = self.pass(contestant, start, exponent)?;
        }
        let spent = begin.elapsed().as_secs_f64();
        Ok(match spent < PATIENCE * REPEATS[0] as f64 {
            true => Series { exponent, passes: Vec::new(), spent: 0.0 },
            false => Series { exponent, passes: vec![trial], spent },
        })
    }

    /// One more: as many passes as time allows, the fastest of them with the largest distance of any.
    fn repeat(
        &self,
        contestant: &mut dyn Contestant,
        start: Start,
        series: &mut Series,
    ) -> Result<()> {
        let (begin, mut passes) = (Instant::now(), Vec::new());
        while passes.is_empty() || begin.elapsed().as_secs_f64() < REPEAT {
            passes.push(self.pass(contestant, start, series.exponent)?);
        }
        let distance = passes.iter().fold(0.0, |most: f64, pass| pass.distance.max(most));
        let fastest = passes.into_iter().min_by(|a, b| a.cycles.total_cmp(&b.cycles));
        series.passes.extend(fastest.map(|fastest| Pass { distance, ..fastest }));
        series.spent += begin.elapsed().as_secs_f64();
        Ok(())
    }

    fn pass(&self, contestant: &mut dyn Contestant, start: Start, exponent: i32) -> Result<Pass> {
        let tolerance = 10f64.powi(exponent);
        match start {
            Start::Cold => self.cold(contestant, tolerance),
            Start::Warm => self.warm(contestant, tolerance),
        }
    }

    fn baseline(&self, solver: &str, start: Start, series: &Series) -> Baseline {
        let Series { exponent, passes, .. } = series;
        let (cycles, cycles_spread) = median_and_spread(passes.iter().map(|pass| pass.cycles));
        Baseline {
            solver: solver.to_owned(),
            problem: self.problem.to_owned(),
            unknowns: self.quadratic.matrix.order(),
            start: start.name().to_owned(),
            tolerance: 10f64.powi(*exponent),
            cycles,
            cycles_spread,
            ratio: 1.0,
            to_condensed: None,
            algebraic_error: passes.iter().fold(0.0, |most, pass| pass.distance.max(most)),
            target: self.target,
            error: None,
            iterations: passes.last().map_or(0, |pass| pass.iterations),
        }
    }

    fn cold(&self, contestant: &mut dyn Contestant, tolerance: f64) -> Result<Pass> {
        let run = contestant.run(0, Start::Cold, tolerance)?;
        let distance = self.quadratic.distance(0, &run.u);
        Ok(Pass { cycles: run.cycles, iterations: run.iterations, distance })
    }

    /// The ticks after the first.
    fn warm(&self, contestant: &mut dyn Contestant, tolerance: f64) -> Result<Pass> {
        contestant.run(0, Start::Cold, tolerance)?;
        let (mut cycles, mut iterations, mut distance) = (Vec::new(), Vec::new(), 0.0_f64);
        for tick in 1..self.quadratic.ticks.len() {
            let run = contestant.run(tick, Start::Warm, tolerance)?;
            distance = distance.max(self.quadratic.distance(tick, &run.u));
            cycles.push(run.cycles);
            iterations.push(run.iterations);
        }
        iterations.sort_unstable();
        let iterations = iterations[iterations.len() / 2];
        Ok(Pass { cycles: median_and_spread(cycles.into_iter()).0, iterations, distance })
    }
}

/// The median, and (largest − smallest)/median.
fn median_and_spread(cycles: impl Iterator<Item = f64>) -> (f64, f64) {
    let mut sorted: Vec<f64> = cycles.collect();
    sorted.sort_unstable_by(f64::total_cmp);
    let median = sorted[sorted.len() / 2];
    (median, (sorted[sorted.len() - 1] - sorted[0]) / median.max(1.0))
}
