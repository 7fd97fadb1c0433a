//! How a solver is measured: at equal error, cold and warm.
//!
//! * Cold: all that follows the matrix and the load, symbolic passes and factorisations included.
//! * Warm: tick after tick with new loads and bounds; what the tick before left may be used, and memory,
//!   patterns and factors stand. The median over the ticks is what counts, and the slowest is recorded.
//! * Repeats: each goes on for 100 ms and counts by its fastest pass, since a processor that has slept is slow at first
//!   and whatever else a shared machine does only adds to a pass; where a pass takes longer it is the only one. The
//!   median over the repeats is what counts. On condensed problems all solvers take turns, so that all have
//!   repeats in the same good and bad times; where these differ, turns are taken again, and the calmest of
//!   three rows of repeats counts, for all of them.
//! * Equal error: the loosest tolerance among 0.1, 0.01, … whose answers all lie within `target` of the
//!   discrete solution, cold and warm apart. It is found before anything is timed. Exact methods and solvers left as
//!   they come have one answer; `algebraic_error` tells how near it is.

use signorini_scene::Result;

use super::series::{Baseline, InitialGuess, Series, Task, TimedSolver};

/// Repeats of a solver alone, and of several in turns; tests ask for no times.
const REPEATS: [usize; 2] = if cfg!(test) { [1, 2] } else { [5, 9] };
/// Rows of repeats in turns, of which the calmest counts.
const ROWS: usize = 3;
/// The mean spread of repeats that are calm.
const CALM: f64 = 0.05;

/// A solver on its way through its starts.
pub(super) struct Entrant<'e> {
    name: String,
    /// `Err` where it cannot take part, or once it has failed.
    solver: Result<Box<dyn TimedSolver + 'e>>,
    /// Repeats of the last start.
    series: Series,
    found: Vec<Baseline>,
}

/// The name of a solver, and what was found of it or why it failed.
pub(super) type Outcome = (String, Result<Vec<Baseline>>);

impl<'e> Entrant<'e> {
    pub fn new(name: &str, solver: Result<impl TimedSolver + 'e>) -> Self {
        let solver = solver.map(|solver| -> Box<dyn TimedSolver> { Box::new(solver) });
        Self { name: name.to_owned(), solver, series: Series::default(), found: Vec::new() }
    }

    fn has(&self, start: InitialGuess) -> bool {
        self.solver.as_ref().is_ok_and(|solver| solver.starts().contains(&start))
    }

    /// Begins a series or adds a repeat to it, unless it has failed or has no such start.
    fn go_on(&mut self, task: &Task, start: InitialGuess, begins: bool) {
        let is_there = self.has(start);
        let Ok(solver) = &mut self.solver else { return };
        let done = match begins {
            _ if !is_there => Ok(()),
            true => task.trial(&mut **solver, start).map(|series| self.series = series),
            false => task.repeat(&mut **solver, start, &mut self.series),
        };
        if let Err(error) = done {
            self.solver = Err(error);
        }
    }

    fn outcome(self) -> Outcome {
        (self.name, self.solver.map(|_| self.found))
    }
}

impl Task<'_> {
    pub fn alone(&self, entrant: Entrant) -> Outcome {
        let mut one = [entrant];
        self.hold(&mut one, REPEATS[0], 1);
        let [one] = one;
        one.outcome()
    }

    pub fn in_turns(&self, mut all: Vec<Entrant>) -> Vec<Outcome> {
        self.hold(&mut all, REPEATS[1], ROWS);
        all.into_iter().map(Entrant::outcome).collect()
    }

    /// All starts; of each the calmest of so many rows of repeats, or the first that is calm.
    fn hold(&self, all: &mut [Entrant], repeats: usize, rows: usize) {
        for start in [InitialGuess::Cold, InitialGuess::Warm] {
            // A warm start needs more than one tick.
            if start == InitialGuess::Warm && self.quadratic.ticks.len() < 2 {
                continue;
            }
            let (mut least, mut kept) = (f64::INFINITY, Vec::new());
            for _ in 0..rows {
                let row = self.measure(all, start, repeats);
                let spreads = row.iter().flatten().map(|found| found.cycles_spread);
                let mean = spreads.sum::<f64>() / row.len().max(1) as f64;
                if mean < least {
                    (least, kept) = (mean, row);
                }
                if least <= CALM {
                    break;
                }
            }
            all.iter_mut().zip(kept).for_each(|(one, found)| one.found.extend(found));
        }
    }

    /// One row of repeats of one start, of all that have it, in their order.
    fn measure(
        &self,
        all: &mut [Entrant],
        start: InitialGuess,
        repeats: usize,
    ) -> Vec<Option<Baseline>> {
        for pass in 0..=repeats {
            all.iter_mut().for_each(|one| one.go_on(self, start, pass == 0));
        }
        let baseline = |one: &Entrant| self.baseline(&one.name, start, &one.series);
        all.iter().map(|one| one.has(start).then(|| baseline(one))).collect()
    }
}
