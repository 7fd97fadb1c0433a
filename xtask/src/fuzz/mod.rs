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

mod options;
mod record;
mod target;

use std::process::{Command, ExitCode};

use crate::command::command;
use crate::steps::{Steps, Tally};
use options::{HELP, Options};
use record::Record;
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

/// The verb.
pub fn run(words: &[&str]) -> ExitCode {
    command(words, HELP, Options::parse, |options| Ok(fuzz(&options)?))
}

/// Corpora and found cases, and a bounded run of each target, as a step of `cargo xtask test`.
pub fn check(steps: &mut Steps) {
    steps.step("fuzzing, corpora and a bounded run", || {
        let passed = |failed| Tally { passed: Target::ALL.len() - failed, failed };
        match build() {
            Err(why) => (passed(Target::ALL.len()), Some(why)),
            Ok(()) => {
                let failures: Vec<_> =
                    Target::ALL.iter().filter_map(|target| target.bounded(BOUNDED).err()).collect();
                (passed(failures.len()), (!failures.is_empty()).then(|| failures.join("; ")))
            }
        }
    });
}

fn fuzz(options: &Options) -> Result<(), String> {
    build()?;
    for target in &options.targets {
        match options.runs {
            None => {
                target.bounded(BOUNDED)?;
            }
            Some(runs) => {
                let Run { executions, edges } = target.long(runs)?;
                let mut record = Record::read()?;
                record.add(target.name, executions, edges, target.cases()?, &today()?);
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
