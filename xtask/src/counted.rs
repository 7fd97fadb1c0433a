//! Runs of `cargo test`, with the tests of all binaries counted.

use std::process::Command;

use crate::steps::Tally;
use signorini_image::cargo::{cargo, run_with_lines};

/// Runs `cargo test` with these words and counts its tests.
pub fn counted(words: &[&str]) -> (Tally, Option<String>) {
    counted_by(cargo(words))
}

/// Runs a whole command and counts its tests.
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
