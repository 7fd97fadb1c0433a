//! A mutant is judged by the tests that reach it until one fails; first by those that have failed most for
//! their time so far.

use std::sync::Mutex;
use std::time::{Duration, Instant};

use serde::Serialize;

use crate::error::Result;
use crate::mutant::Mutant;
use crate::shared::each;
use crate::suite::{Ended, Test};

/// The fate of a mutant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// A test failed.
    Caught,
    /// A test did not end.
    Timeout,
    /// All tests passed.
    Missed,
    /// No test comes past it.
    Unreached,
    /// The mutant does not compile.
    Unviable,
    /// The mutant has no switch.
    Unswitched,
}

/// The record of a test.
#[derive(Debug, Clone, Copy, Default)]
struct Merit {
    kills: u32,
    spent: Duration,
}

/// The tests, and what each has been good for.
pub struct Judge<'a> {
    tests: &'a [Test],
    merits: Mutex<Vec<Merit>>,
}

impl<'a> Judge<'a> {
    /// Knows nothing yet.
    pub fn new(tests: &'a [Test]) -> Self {
        Self { tests, merits: Mutex::new(vec![Merit::default(); tests.len()]) }
    }

    /// Judges mutants that have a switch, several at a time; the outcomes are in the same order.
    pub fn all(&self, mutants: &[&Mutant], workers: usize) -> Result<Vec<(Outcome, String)>> {
        each(mutants, workers, |_, mutant| self.one(mutant))
    }

    /// The outcome and the test that decided.
    fn one(&self, mutant: &Mutant) -> Result<(Outcome, String)> {
        let mut outcome = Outcome::Unreached;
        for at in self.order(mutant) {
            let (test, start) = (&self.tests[at], Instant::now());
            outcome = Outcome::Missed;
            let ended = test.run(mutant.id, None, 10 * test.takes + Duration::from_secs(2))?;
            let merit = &mut self.merits.lock().unwrap()[at];
            merit.spent += start.elapsed();
            merit.kills += u32::from(ended != Ended::Passed);
            match ended {
                Ended::Passed => {}
                Ended::Failed => return Ok((Outcome::Caught, test.name.clone())),
                Ended::TimedOut => return Ok((Outcome::Timeout, test.name.clone())),
            }
        }
        Ok((outcome, String::new()))
    }

    /// The tests that reach a mutant, in the order in which they shall be run.
    fn order(&self, mutant: &Mutant) -> Vec<usize> {
        let merits = self.merits.lock().unwrap();
        let reach = |at: &usize| self.tests[*at].reached.contains(&mutant.id);
        let mut order: Vec<_> = (0..self.tests.len()).filter(reach).collect();
        let price = |at: usize| (self.tests[at].takes + merits[at].spent) / (merits[at].kills + 1);
        order.sort_by_key(|&at| price(at));
        order
    }
}
