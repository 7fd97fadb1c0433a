//! Named steps in order: each says how long it took, failures are repeated at the end, and the last
//! line is the count.

use std::process::ExitCode;
use std::time::{Duration, Instant};

/// How many checks of a step passed and failed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Tally {
    /// Checks that passed.
    pub passed: usize,
    /// Checks that failed.
    pub failed: usize,
}

/// What became of a step: its tally and, where something failed, why.
type Outcome = (Tally, Option<String>);

/// The steps so far.
#[derive(Debug, Default)]
pub struct Steps {
    done: Vec<Step>,
    bless: bool,
}

#[derive(Debug)]
struct Step {
    name: String,
    time: Duration,
    tally: Tally,
    failure: Option<String>,
}

impl Steps {
    /// No steps yet; with `bless`, records are written anew instead of compared.
    pub fn new(bless: bool) -> Self {
        Self { bless, ..Self::default() }
    }

    /// Whether records are to be written anew.
    pub fn blesses(&self) -> bool {
        self.bless
    }

    /// Runs a step that several verbs need once only.
    pub fn check_once(&mut self, name: &str, check: impl FnOnce() -> Result<(), String>) {
        if !self.done.iter().any(|step| step.name == name) {
            self.check(name, check);
        }
    }

    /// Runs a step that is one check.
    pub fn check(&mut self, name: &str, check: impl FnOnce() -> Result<(), String>) {
        self.step(name, || match check() {
            Ok(()) => (Tally { passed: 1, failed: 0 }, None),
            Err(why) => (Tally { passed: 0, failed: 1 }, Some(why)),
        });
    }

    /// Runs a step that counts for itself; it has failed where it says why.
    pub fn step(&mut self, name: &str, step: impl FnOnce() -> Outcome) {
        println!("\n=== {name}");
        let start = Instant::now();
        let (tally, failure) = step();
        let step = Step { name: name.to_owned(), time: start.elapsed(), tally, failure };
        println!("{}", step.line());
        self.done.push(step);
    }

    /// Prints the summary; success only where every step passed, and there was one.
    pub fn finish(self) -> ExitCode {
        println!("\n=== summary");
        for step in &self.done {
            println!("{}", step.line());
        }
        let total = self.done.iter().fold(Tally::default(), |sum, step| Tally {
            passed: sum.passed + step.tally.passed,
            failed: sum.failed + step.tally.failed,
        });
        println!("{} passed, {} failed", total.passed, total.failed);
        if total.failed == 0 && total.passed > 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
    }
}

impl Step {
    fn line(&self) -> String {
        let verdict = if self.failure.is_none() { "ok" } else { "FAILED" };
        let Tally { passed, failed } = self.tally;
        let counts = match passed + failed {
            1 => String::new(),
            _ => format!(" ({passed} passed, {failed} failed)"),
        };
        let why = self.failure.iter().map(|why| format!(": {why}")).collect::<String>();
        let seconds = self.time.as_secs_f64();
        format!("{verdict:<6} {seconds:>7.1} s  {}{counts}{why}", self.name)
    }
}
