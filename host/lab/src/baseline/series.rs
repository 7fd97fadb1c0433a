//! A solver as a contest runs it, its repeats, and their record: the tolerance that will do, passes over the ticks.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use crate::cycles::median_and_spread;
use crate::record_file::word;
use signorini_scene::Result;

use super::quadratic::Quadratic;

/// A solver on the matrices of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Baseline {
    /// `kernel PSOR`, `Clarabel`, …
    pub solver: String,
    /// `full`, `condensed`.
    pub problem: String,
    pub unknowns: usize,
    /// `cold`, `warm`.
    pub start: String,
    /// Cycles of a solve on this machine, the median; setup that a loop does once is not in it.
    pub cycles: f64,
    /// (largest − smallest)/median of the repeats.
    pub cycles_spread: f64,
    /// Cycles of the slowest tick, the median over the repeats.
    pub worst: f64,
    /// The loosest tolerance, in powers of ten, at which `algebraic_error` comes to lie within `target`.
    pub tolerance: f64,
    /// Cycles over those of the kernel's best answer in f64 for the same problem and start.
    pub ratio: f64,
    /// Cycles over those of the kernel's condensed model in f64, same start.
    pub to_condensed: Option<f64>,
    /// Energy distance to the solution of the discrete problem, the largest of all ticks.
    pub algebraic_error: f64,
    /// Largest `algebraic_error` that will do: 1 % of the discretisation error.
    pub target: f64,
    pub iterations: u32,
}

/// The state that a solve begins with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum InitialGuess {
    Cold,
    /// From what the last run left.
    Warm,
}

#[derive(Debug, Clone)]
pub(super) struct Run {
    pub cycles: f64,
    pub iterations: u32,
    pub u: Vec<f64>,
}

pub(super) trait TimedSolver {
    /// Solves a tick and counts its own cycles: copies of data and of the answer are not part of it.
    fn run(&mut self, tick: usize, start: InitialGuess, tolerance: f64) -> Result<Run>;

    fn starts(&self) -> &'static [InitialGuess] {
        &[InitialGuess::Cold, InitialGuess::Warm]
    }

    /// The exponent of the finest tolerance that makes sense.
    fn finest(&self) -> i32 {
        -13
    }
}

/// Seconds of a repeat, at least; tests ask for no times.
const REPEAT: f64 = if cfg!(test) { 0.0 } else { 0.1 };
/// Seconds after which no repeat begins.
const ENOUGH: f64 = 2.0;
/// Seconds after which the trial itself is the measurement.
const LONG: f64 = 10.0;

/// Runs over a row of ticks.
pub(super) struct Pass {
    /// The median of all ticks.
    cycles: f64,
    /// The slowest tick.
    worst: f64,
    iterations: u32,
    /// The largest of all ticks.
    distance: f64,
}

/// The repeats of a solver at the loosest tolerance that will do, 10^`exponent`.
#[derive(Default)]
pub(super) struct Series {
    exponent: i32,
    passes: Vec<Pass>,
    spent: f64,
}

/// A problem that solvers are measured on.
pub(super) struct Task<'q> {
    /// `full`, `condensed`.
    pub problem: &'static str,
    pub quadratic: &'q Quadratic,
    /// The energy distance that is small enough.
    pub target: f64,
}

impl Task<'_> {
    /// Begins a series: finds its tolerance.
    pub(super) fn trial(
        &self,
        solver: &mut dyn TimedSolver,
        start: InitialGuess,
    ) -> Result<Series> {
        let begin = Instant::now();
        let mut exponent = -1;
        let mut trial = self.pass(solver, start, exponent)?;
        while trial.distance > self.target && exponent > solver.finest() {
            exponent -= 1;
            trial = self.pass(solver, start, exponent)?;
        }
        let spent = begin.elapsed().as_secs_f64();
        Ok(match spent < LONG {
            true => Series { exponent, ..Series::default() },
            false => Series { exponent, passes: vec![trial], spent },
        })
    }

    /// One more: as many passes as time allows, the fastest of them with the largest distance of any.
    pub(super) fn repeat(
        &self,
        solver: &mut dyn TimedSolver,
        start: InitialGuess,
        series: &mut Series,
    ) -> Result<()> {
        if series.spent >= ENOUGH {
            return Ok(());
        }
        let (begin, mut passes) = (Instant::now(), Vec::new());
        while passes.is_empty() || begin.elapsed().as_secs_f64() < REPEAT {
            passes.push(self.pass(solver, start, series.exponent)?);
        }
        let distance = passes.iter().fold(0.0, |most: f64, pass| pass.distance.max(most));
        let fastest = passes.into_iter().min_by(|a, b| a.cycles.total_cmp(&b.cycles));
        series.passes.extend(fastest.map(|fastest| Pass { distance, ..fastest }));
        series.spent += begin.elapsed().as_secs_f64();
        Ok(())
    }

    /// The first tick from a cold start, or all others, warm, after it.
    fn pass(
        &self,
        solver: &mut dyn TimedSolver,
        start: InitialGuess,
        exponent: i32,
    ) -> Result<Pass> {
        let tolerance = 10f64.powi(exponent);
        let ticks = match start {
            InitialGuess::Cold => 0..1,
            InitialGuess::Warm => {
                solver.run(0, InitialGuess::Cold, tolerance)?;
                1..self.quadratic.ticks.len()
            }
        };
        let (mut cycles, mut iterations, mut distance) = (Vec::new(), Vec::new(), 0.0_f64);
        for tick in ticks {
            let run = solver.run(tick, start, tolerance)?;
            distance = distance.max(self.quadratic.distance(tick, &run.u));
            cycles.push(run.cycles);
            iterations.push(f64::from(run.iterations));
        }
        let iterations = median_and_spread(iterations).0 as u32;
        let worst = cycles.iter().fold(0.0, |most: f64, &cycles| most.max(cycles));
        let (cycles, _) = median_and_spread(cycles);
        Ok(Pass { cycles, worst, iterations, distance })
    }

    pub(super) fn baseline(&self, name: &str, start: InitialGuess, series: &Series) -> Baseline {
        let Series { exponent, passes, .. } = series;
        let (cycles, cycles_spread) = median_and_spread(passes.iter().map(|pass| pass.cycles));
        Baseline {
            solver: name.to_owned(),
            problem: self.problem.to_owned(),
            unknowns: self.quadratic.matrix.order(),
            start: word(&start),
            tolerance: 10f64.powi(*exponent),
            cycles,
            cycles_spread,
            worst: median_and_spread(passes.iter().map(|pass| pass.worst)).0,
            ratio: 1.0,
            to_condensed: None,
            algebraic_error: passes.iter().fold(0.0, |most, pass| pass.distance.max(most)),
            target: self.target,
            iterations: passes.last().map_or(0, |pass| pass.iterations),
        }
    }
}
