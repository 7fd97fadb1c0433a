//! `cargo xtask test`: everything that must hold, in the order in which it is cheap to find out.

use std::process::Command;

use crate::cargo::{cargo, require, run as run_cargo, run_with_lines};
use crate::steps::{Steps, Tally};
use crate::{
    audit, boards, cost, cross, firmware, fuzz, mutants, no_std, oldest, ranks, sanitize, size,
};

/// Formatting, clippy, tests, ranks of MPI, documentation, the kernel without std, the images.
pub fn run(steps: &mut Steps) {
    steps.check("formatting", || {
        require("fmt", "rustfmt")?;
        run_cargo(cargo(&["fmt", "--all", "--check"]))
    });
    steps.check("formatting, tests/no_std", || {
        require("fmt", "rustfmt")?;
        run_cargo(cargo(&["fmt", "--manifest-path", no_std::MANIFEST, "--check"]))
    });
    steps.check("clippy", || {
        require("clippy", "clippy")?;
        let what = ["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"];
        run_cargo(cargo(&what))
    });
    steps.step("tests", || counted(&["test", "--workspace", "--locked", "--no-fail-fast"]));
    mutants::verify(steps);
    ranks::run(steps);
    steps.check("documentation", || {
        let mut doc = cargo(&["doc", "--workspace", "--no-deps", "--locked"]);
        doc.env("RUSTDOCFLAGS", "-D warnings");
        run_cargo(doc)
    });
    oldest::run(steps);
    no_std::run(steps);
    sanitize::run(steps);
    steps.check("formatting, tests/fuzz", || {
        run_cargo(cargo(&["fmt", "--manifest-path", fuzz::MANIFEST, "--check"]))
    });
    fuzz::check(steps);
    steps.check("formatting, tests/firmware", || {
        run_cargo(cargo(&[
            "fmt",
            "--manifest-path",
            "tests/firmware/Cargo.toml",
            "--all",
            "--check",
        ]))
    });
    cross::run(steps);
    boards::run(steps);
    firmware::check(steps);
    audit::run(steps);
    size::run(steps);
    cost::run(steps);
}

/// Runs `cargo test` with these words and counts its tests.
pub fn counted(words: &[&str]) -> (Tally, Option<String>) {
    counted_by(cargo(words))
}

/// The same for a whole command.
pub fn counted_by(command: Command) -> (Tally, Option<String>) {
    let mut tally = Tally::default();
    let ended = run_with_lines(command, |line| {
        if let Some(binary) = result_line(line) {
            tally.passed += binary.passed;
            tally.failed += binary.failed;
        }
    });
    judge(tally, ended)
}

/// The counts of a line like `test result: ok. 3 passed; 0 failed; 1 ignored; …`.
fn result_line(line: &str) -> Option<Tally> {
    let counts = line.strip_prefix("test result: ")?.split_once(". ")?.1;
    let count = |of: &str| {
        let part = counts.split("; ").find(|part| part.ends_with(of))?;
        part.split(' ').next()?.parse().ok()
    };
    Some(Tally { passed: count(" passed")?, failed: count(" failed")? })
}

/// A run that failed without a failed test (it did not compile, or crashed) counts as one failure,
/// and so does a run without tests.
fn judge(mut tally: Tally, ended: Result<(), String>) -> (Tally, Option<String>) {
    let why = match ended {
        _ if tally.failed > 0 => Some("see the failures above".to_owned()),
        Ok(()) if tally.passed == 0 => Some("no test ran".to_owned()),
        ended => ended.err(),
    };
    if why.is_some() && tally.failed == 0 {
        tally.failed = 1;
    }
    (tally, why)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_stand_in_result_lines_alone() {
        let line = "test result: FAILED. 12 passed; 3 failed; 1 ignored; 0 measured; 9 filtered out; \
                    finished in 0.01s";
        assert_eq!(result_line(line), Some(Tally { passed: 12, failed: 3 }));
        assert_eq!(result_line("test 4 passed; 5 failed ... ok"), None);
        assert_eq!(result_line("test result: ok."), None);
    }

    #[test]
    fn nothing_that_went_wrong_passes() {
        let tally = |passed, failed| Tally { passed, failed };
        assert_eq!(judge(tally(7, 0), Ok(())), (tally(7, 0), None));
        assert_eq!(judge(tally(0, 0), Ok(())).0, tally(0, 1));
        assert_eq!(judge(tally(7, 0), Err("exit status: 101".to_owned())).0, tally(7, 1));
        let (counts, why) = judge(tally(7, 2), Err("exit status: 101".to_owned()));
        assert_eq!((counts, why.is_some()), (tally(7, 2), true));
    }
}
