//! `cargo xtask fuzz`: coverage-guided fuzzing on the stable toolchain.
//!
//! ```text
//!   tests/fuzz/corpus ─┐
//!   tests/fuzz/found  ─┴─► libFuzzer, built by stable rustc ─┬─► clean: with --runs the record and the
//!                                                            │   smallest corpus of the same coverage
//!                                                            └─► a case: tests/fuzz/found
//! ```
//! `cargo fuzz` wants a nightly toolchain for its sanitizers alone; without them the flags that it passes
//! are those of a stable compiler.

mod record;
mod target;

use std::process::Command;

use clap::Args;

use crate::baked::Failure;
use crate::steps::{Steps, Tally};
use record::{Fuzzed, Record};
use signorini_image::cargo::{cargo, run as run_command, target_dir};
use signorini_image::toolchain::{host, output};
use signorini_image::tools::{answer, ensured};
use target::{Run, Target};

/// Executions of each target where nothing else is asked for.
const BOUNDED: u64 = 10_000;

/// The package of the targets.
pub const MANIFEST: &str = "tests/fuzz/Cargo.toml";

/// Coverage that libFuzzer reads: a counter each branch, a table of their places, operands of comparisons.
const FLAGS: &str = "-Cpasses=sancov-module \
    -Cllvm-args=-sanitizer-coverage-level=4 \
    -Cllvm-args=-sanitizer-coverage-inline-8bit-counters \
    -Cllvm-args=-sanitizer-coverage-pc-table \
    -Cllvm-args=-sanitizer-coverage-trace-compares \
    --cfg fuzzing \
    -Ccodegen-units=1";

/// The targets, and how often each runs.
#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub struct Options {
    /// mesh, scene, expression, constructors, tick; all of them without one
    #[arg(value_name = "TARGET", value_parser = Target::named)]
    targets: Vec<Target>,
    /// Executions of each target; adds them to tests/fuzz/record.json and keeps the smallest corpus of the coverage reached
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    runs: Option<u64>,
}

const MORE: &str = "\
Examples:
  cargo xtask fuzz
  cargo xtask fuzz --runs 1000000 mesh scene
  target/fuzz/…/release/mesh tests/fuzz/found/mesh/crash-…    runs one case

What is found stands in tests/fuzz/found/TARGET. The exit status is 0 where nothing is, 2 for a wrong command
line. `cargo fuzz` works in tests too, with a nightly toolchain and its sanitizers.";

/// Corpora and found cases, and a bounded run of each target, as a step of `cargo xtask test`.
pub fn check(steps: &mut Steps) {
    steps.step("fuzzing, corpora and a bounded run", || {
        build()?;
        let failures = Target::ALL.iter().filter_map(|target| target.bounded(BOUNDED).err());
        let failures: Vec<_> = failures.collect();
        let failed = failures.len();
        let tally = Tally { passed: Target::ALL.len() - failed, failed };
        Ok((tally, (failed > 0).then(|| failures.join("; "))))
    });
}

/// The verb.
pub fn run(options: &Options) -> Result<(), Failure> {
    build()?;
    let all = &Target::ALL[..];
    for target in if options.targets.is_empty() { all } else { &options.targets } {
        match options.runs {
            None => {
                target.bounded(BOUNDED)?;
            }
            Some(runs) => {
                let Run { executions, edges } = target.long(runs)?;
                let ([corpus, found], date) = (target.cases()?, today()?);
                let mut record = Record::read()?;
                record.add(target.name, Fuzzed { executions, edges, corpus, found, date });
                record.write()?;
            }
        }
    }
    Ok(())
}

fn build() -> Result<(), String> {
    ensured(&["g++"], || answer(&["c++"]))?;
    let mut command = cargo(&["build", "--release", "--locked", "--manifest-path", MANIFEST]);
    // Named, the target keeps the flags from build scripts.
    command.env("RUSTFLAGS", FLAGS).args(["--target", &host()?, "--target-dir"]);
    command.arg(target_dir("fuzz"));
    run_command(command)
}

fn today() -> Result<String, String> {
    Ok(output(Command::new("date").args(["-u", "+%F"]))?.trim().to_owned())
}
