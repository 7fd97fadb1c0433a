//! How a solver is measured: at equal error, cold and warm.
//!
//! * Cold: all that follows the matrix and the load, symbolic passes and factorisations included.
//! * Warm: tick after tick with new loads and bounds; what the tick before left may be used, and memory,
//!   patterns and factors stand. The median over the ticks is what counts, and the slowest is recorded.
//! * Repeats: each goes on for 100 ms and counts by its fastest pass, since a processor that has slept is slow at first
//!   and whatever else a shared machine does only adds to a pass; where a pass takes longer it is the only one. The
//!   median over the repeats is what counts. On condensed problems all solvers take turns, so that everybody has
//!   repeats in the same good and bad times; where these differ, turns are taken again, and the calmest of
//!   three rows of repeats counts, for all of them.
//! * Equal error: the loosest tolerance among 0.1, 0.01, … whose answers all lie within `target` of the
//!   discrete solution, cold and warm apart. It is found before anything is timed. Exact methods and solvers left as
//!   they come have one answer; `algebraic_error` tells how near it is.

use crate::baseline::record::Baseline;
use signorini_scene::error::Result;

use super::series::Series;
use super::timed_solver::{Contest, InitialGuess, TimedSolver};

/// Repeats of a solver alone, and of several in turns.
const REPEATS: [usize; 2] = [5, 9];
/// The mean spread of repeats that are calm.
const CALM: f64 = 0.05;

/// A solver's name, and the solver or why it cannot take part.
pub(super) type Entrant<'e> = (&'static str, Result<Box<dyn TimedSolver + 'e>>);

/// A solver on its way through the starts: `Err` once it has failed.
struct Competitor<'e> {
    name: &'e str,
    contestant: Result<Box<dyn TimedSolver + 'e>>,
    /// Of the last start.
    series: Series,
    found: Vec<Baseline>,
}

impl<'e> Competitor<'e> {
    fn new(name: &'e str, contestant: Result<Box<dyn TimedSolver + 'e>>) -> Self {
        Self { name, contestant, series: Series::default(), found: Vec::new() }
    }

    /// Has it do some `work`, unless it has failed.
    fn attempt(&mut self, work: impl FnOnce(&mut dyn TimedSolver, &mut Series) -> Result<()>) {
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
    pub fn hold(&self, solver: &str, contestant: &mut dyn TimedSolver) -> Result<Vec<Baseline>> {
        self.alone(solver, contestant, &[InitialGuess::Cold, InitialGuess::Warm])
    }

    /// These starts of one solver.
    pub fn alone(
        &self,
        solver: &str,
        contestant: &mut dyn TimedSolver,
        starts: &[InitialGuess],
    ) -> Result<Vec<Baseline>> {
        let mut one = [Competitor::new(solver, Ok(Box::new(contestant)))];
        for &start in starts {
            let found = self.measure(&mut one, start, REPEATS[0]);
            take_over(&mut one, found);
        }
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
        for start in [InitialGuess::Cold, InitialGuess::Warm] {
            let rows = || self.measure(&mut all, start, REPEATS[1]);
            let found = calmest(rows);
            take_over(&mut all, found);
        }
        names.into_iter().zip(all.into_iter().map(Competitor::result)).collect()
    }

    /// One start of all who are still there, in their order. A warm one needs more than one tick.
    fn measure(
        &self,
        all: &mut [Competitor],
        start: InitialGuess,
        repeats: usize,
    ) -> Vec<Option<Baseline>> {
        if start == InitialGuess::Warm && self.quadratic.ticks.len() < 2 {
            return Vec::new();
        }
        for one in &mut *all {
            one.attempt(|contestant, series| self.trial(contestant, start, series));
        }
        for _ in 0..repeats {
            for one in &mut *all {
                one.attempt(|contestant, series| self.repeat(contestant, start, series));
            }
        }
        let baseline = |one: &Competitor| self.baseline(one.name, start, &one.series);
        all.iter().map(|one| one.contestant.is_ok().then(|| baseline(one))).collect()
    }
}

/// Of at most three rows of repeats the calmest, or the first that is calm.
fn calmest(mut rows: impl FnMut() -> Vec<Option<Baseline>>) -> Vec<Option<Baseline>> {
    let (mut least, mut kept) = (f64::INFINITY, Vec::new());
    for _ in 0..3 {
        let row = rows();
        let spreads = row.iter().flatten().map(|found| found.cycles_spread);
        let mean = spreads.sum::<f64>() / row.len().max(1) as f64;
        if mean < least {
            (least, kept) = (mean, row);
        }
        if least <= CALM {
            break;
        }
    }
    kept
}

fn take_over(all: &mut [Competitor], found: Vec<Option<Baseline>>) {
    all.iter_mut().zip(found).for_each(|(one, found)| one.found.extend(found));
}
