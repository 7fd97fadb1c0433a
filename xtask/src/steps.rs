//! Named steps in order: each says how long it took, failures are repeated at the end, and the last
//! line is the count.

use std::fs;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use crate::stamps::Stamp;
use clap::Args;
use signorini_image::cargo::building;

/// How many checks of a step passed and failed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Tally {
    /// Checks that passed.
    pub passed: usize,
    /// Checks that failed.
    pub failed: usize,
}

/// The tally of a step and, where something failed, why.
pub type Outcome = (Tally, Option<String>);

/// The outcome of one check that passed.
const ONE: Outcome = (Tally { passed: 1, failed: 0 }, None);

/// The kind of work that a step's time counts for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Work {
    Compiling,
    Linting,
    Testing,
}

/// How a verb was called.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Args)]
pub struct Mode {
    /// Writes records anew, whole ones, instead of comparing
    #[arg(long)]
    pub bless: bool,
    /// Runs steps that need not run each time, too; no stamp counts
    #[arg(long = "all", conflicts_with = "bless")]
    pub is_whole: bool,
}

/// The steps so far.
#[derive(Debug, Default)]
pub struct Steps {
    done: Vec<Step>,
    mode: Mode,
}

#[derive(Debug)]
struct Step {
    name: String,
    work: Work,
    time: Duration,
    tally: Tally,
    failure: Option<String>,
}

impl Steps {
    /// No steps yet.
    pub fn new(mode: Mode) -> Self {
        Self { done: Vec::new(), mode }
    }

    /// Whether records are to be written anew.
    pub fn blesses(&self) -> bool {
        self.mode.bless
    }

    /// Whether steps run that need not run each time; a record is written whole.
    pub fn is_whole(&self) -> bool {
        self.mode.is_whole || self.mode.bless
    }

    /// Runs a step that several verbs need once only.
    pub fn check_once(&mut self, name: &str, check: impl FnOnce() -> Result<(), String>) {
        if !self.has(name) {
            self.check(name, check);
        }
    }

    /// Whether a step of this name has run.
    pub fn has(&self, name: &str) -> bool {
        self.done.iter().any(|step| step.name == name)
    }

    /// Runs a step that is one check.
    pub fn check(&mut self, name: &str, check: impl FnOnce() -> Result<(), String>) {
        self.run(name, Work::Testing, || check().map(|()| ONE));
    }

    /// Runs a step that reads the sources.
    pub fn lint(&mut self, name: &str, check: impl FnOnce() -> Result<(), String>) {
        self.run(name, Work::Linting, || check().map(|()| ONE));
    }

    /// Runs a step that builds what others need.
    pub fn compile(&mut self, name: &str, build: impl FnOnce() -> Result<(), String>) {
        self.run(name, Work::Compiling, || build().map(|()| ONE));
    }

    /// Runs a step that counts for itself; it has failed where it says why.
    pub fn step(&mut self, name: &str, step: impl FnOnce() -> Result<Outcome, String>) {
        self.run(name, Work::Testing, step);
    }

    fn run(&mut self, name: &str, work: Work, step: impl FnOnce() -> Result<Outcome, String>) {
        println!("\n=== {name}");
        let start = Instant::now();
        let failed = |why| (Tally { passed: 0, failed: 1 }, Some(why));
        let (tally, failure) = step().unwrap_or_else(failed);
        self.finished(Step { name: name.to_owned(), work, time: start.elapsed(), tally, failure });
    }

    fn finished(&mut self, step: Step) {
        println!("{}", step.line());
        self.done.push(step);
    }

    /// Runs the steps of a group, unless they passed with all that they read as it is now.
    pub fn group(&mut self, name: &str, reads: &[&str], steps: impl FnOnce(&mut Self)) {
        let stamp = if self.mode == Mode::default() { Stamp::of(name, reads) } else { None };
        if let Some(passed) = stamp.as_ref().and_then(Stamp::passed) {
            let (name, tally) = (format!("{name}, as before"), Tally { passed, failed: 0 });
            let work = Work::Testing;
            return self.finished(Step { name, work, time: Duration::ZERO, tally, failure: None });
        }
        let before = self.done.len();
        steps(self);
        let total = total(&self.done[before..]);
        if let Some(stamp) = stamp.filter(|_| total.failed == 0) {
            stamp.keep(total.passed);
        }
    }

    /// Runs two lists of steps side by side.
    pub fn beside(
        &mut self,
        one: impl FnOnce(&mut Self) + Send,
        other: impl FnOnce(&mut Self) + Send,
    ) {
        let (mut first, mut second) = (Self::new(self.mode), Self::new(self.mode));
        std::thread::scope(|scope| {
            scope.spawn(|| other(&mut second));
            one(&mut first);
        });
        self.done.extend(first.done.into_iter().chain(second.done));
    }

    /// Prints the summary; success only where every step passed, and there was one.
    pub fn finish(self) -> ExitCode {
        println!("\n=== summary");
        for step in &self.done {
            println!("{}", step.line());
        }
        println!("{}", self.times());
        let total = total(&self.done);
        println!("{} passed, {} failed", total.passed, total.failed);
        if total.failed == 0 && total.passed > 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
    }

    /// Seconds by kind of work, of which two may pass at the same time, and those of all processors.
    fn times(&self) -> String {
        let of = |work| -> f64 {
            let steps = self.done.iter().filter(|step| step.work == work);
            steps.map(|step| step.time).sum::<Duration>().as_secs_f64()
        };
        let images = building().as_secs_f64();
        let cpu = processors().map_or_else(String::new, |seconds| {
            format!("; {:.1} minutes of processors", seconds / 60.0)
        });
        format!(
            "compiling {:.0} s (and images within the steps {images:.0} s), linting {:.0} s, testing {:.0} s{cpu}",
            of(Work::Compiling),
            of(Work::Linting),
            of(Work::Testing)
        )
    }
}

/// The seconds of all processors for this program and all that it has started; none where the system does not tell.
fn processors() -> Option<f64> {
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    let times = stat.rsplit_once(") ")?.1.split(' ').skip(11).take(4);
    let ticks: Option<u64> = times.map(|ticks| ticks.parse::<u64>().ok()).sum();
    // Linux tells hundredths to every program.
    ticks.map(|ticks| ticks as f64 / 100.0)
}

fn total(steps: &[Step]) -> Tally {
    steps.iter().fold(Tally::default(), |sum, step| Tally {
        passed: sum.passed + step.tally.passed,
        failed: sum.failed + step.tally.failed,
    })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_steps_count_those_beside_each_other_too() {
        let mut steps = Steps::new(Mode { is_whole: true, ..Mode::default() });
        steps.check("one", || Ok(()));
        steps.check_once("one", || Err("again".to_owned()));
        steps.beside(
            |steps| steps.lint("two", || Err("wrong".to_owned())),
            |steps| steps.step("three", || Ok((Tally { passed: 4, failed: 0 }, None))),
        );
        assert_eq!(total(&steps.done), Tally { passed: 5, failed: 1 });
        assert!(steps.done[1].line().contains("FAILED") && steps.done[1].line().ends_with("wrong"));
        assert_eq!(steps.finish(), ExitCode::FAILURE);
        assert_eq!(Steps::default().finish(), ExitCode::FAILURE);
    }
}
