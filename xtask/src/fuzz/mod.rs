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

use crate::steps::{Steps, Tally};
use options::{HELP, Options};
use record::Record;
use signorini_image::cargo::{cargo, run as run_command, target_dir};
use signorini_image::toolchain::output;
use signorini_image::tools::install_packages;
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
    if words.iter().any(|word| ["--help", "-h"].contains(word)) {
        print!("{HELP}");
        return ExitCode::SUCCESS;
    }
    let options = match Options::parse(words) {
        Ok(options) => options,
        Err(why) => {
            eprintln!("error: {why}\n\n{HELP}");
            return ExitCode::from(2);
        }
    };
    match fuzz(&options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::FAILURE
        }
    }
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
    let has_compiler = || output(Command::new("c++").arg("--version"));
    if let Err(why) = has_compiler() {
        install_packages(&["g++"]).map_err(|remedy| format!("{why}; {remedy}"))?;
        has_compiler()?;
    }
    let mut command = cargo(&["build", "--release", "--locked", "--manifest-path", MANIFEST]);
    command.env("RUSTFLAGS", FLAGS).args(["--target", &host()?, "--target-dir"]);
    command.arg(target_dir("fuzz"));
    run_command(command)
}

/// The triple of this machine: named, it keeps the flags from build scripts.
fn host() -> Result<String, String> {
    let about = output(Command::new("rustc").arg("-vV"))?;
    let host = about.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| "rustc names no host".to_owned())
}

fn today() -> Result<String, String> {
    Ok(output(Command::new("date").args(["-u", "+%F"]))?.trim().to_owned())
}
