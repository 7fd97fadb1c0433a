//! How a solver is measured: at equal error, cold and warm.
//!
//! * Cold: all that follows the matrix and the load, symbolic passes and factorisations included.
//! * Warm: tick after tick with new loads and bounds; what the tick before left may be used, and memory,
//!   patterns and factors stand. The median over the ticks is what counts.
//! * Equal error: the loosest tolerance among 0.1, 0.01, … whose answers all lie within `target` of the
//!   discrete solution. It is found before anything is timed. Exact methods and solvers left as they come have one
//!   answer; `algebraic_error` tells how near it is.

use std::time::Instant;

use crate::cycles;
use crate::error::Result;
use crate::trade::record::Baseline;

use super::quadratic::Quadratic;

/// Repeats of a measurement.
const REPEATS: usize = 5;
/// Seconds after which no repeat begins.
const PATIENCE: f64 = 2.0;

/// What a solve begins with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Start {
    Cold,
    /// From what the last run left.
    Warm,
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
    /// The largest of all.
    distance: f64,
}

impl Contest<'_> {
    /// Both starts.
    pub fn hold(&self, solver: &str, contestant: &mut dyn Contestant) -> Result<Vec<Baseline>> {
        let (cold, tolerance) = self.start(solver, "cold", contestant, 0, Self::cold)?;
        if self.quadratic.ticks.len() < 2 {
            return Ok(vec![cold]);
        }
        let (warm, _) = self.start(solver, "warm", contestant, tolerance, Self::warm)?;
        Ok(vec![cold, warm])
    }

    /// A cold start alone.
    pub fn hold_cold(&self, solver: &str, contestant: &mut dyn Contestant) -> Result<Baseline> {
        Ok(self.start(solver, "cold", contestant, 0, Self::cold)?.0)
    }

    /// Finds the tolerance, below 10^`above`, then measures.
    fn start(
        &self,
        solver: &str,
        start: &str,
        contestant: &mut dyn Contestant,
        above: i32,
        pass: impl Fn(&Self, &mut dyn Contestant, f64) -> Result<Pass>,
    ) -> Result<(Baseline, i32)> {
        let mut exponent = above - i32::from(above == 0);
        let begin = Instant::now();
        let mut trial = pass(self, contestant, 10f64.powi(exponent))?;
        while trial.distance > self.target && exponent > contestant.finest() {
            exponent -= 1;
            trial = pass(self, contestant, 10f64.powi(exponent))?;
        }
        let mut passes = vec![trial];
        if begin.elapsed().as_secs_f64() < PATIENCE * REPEATS as f64 {
            passes.clear();
        }
        let begin = Instant::now();
        while passes.len() < REPEATS
            && (passes.is_empty() || begin.elapsed().as_secs_f64() < PATIENCE)
        {
            passes.push(pass(self, contestant, 10f64.powi(exponent))?);
        }
        let (cycles, cycles_spread) = median_and_spread(passes.iter().map(|pass| pass.cycles));
        let baseline = Baseline {
            solver: solver.to_owned(),
            problem: self.problem.to_owned(),
            unknowns: self.quadratic.matrix.order(),
            start: start.to_owned(),
            tolerance: 10f64.powi(exponent),
            cycles,
            cycles_spread,
            ratio: 1.0,
            to_condensed: None,
            algebraic_error: passes.iter().fold(0.0, |most, pass| pass.distance.max(most)),
            target: self.target,
            error: None,
            iterations: passes.last().map_or(0, |pass| pass.iterations),
        };
        Ok((baseline, exponent))
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
