//! No tolerance of the tests is far looser than what they see: a looser one would hide errors.
//!
//! Each comparison of the tests by the table (`tests/tolerances`) writes down how far it was off:
//! ```text
//!   kernel::PATCH  1e-12  0e0  3.1e-14      entry, value, worst of longer runs, seen; tabs between
//! ```

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::Command;

use crate::steps::{Steps, Tally};
use signorini_image::cargo::target_dir;
use signorini_image::files;

/// The variable that names the folder for what the tests write.
const FOLDER: &str = "SIGNORINI_SEEN";
/// How much looser than the largest deviation a tolerance may be.
const LOOSEST: f64 = 100.0;
/// Another compiler or processor may round the last digit of what agrees here in all digits.
const LEAST: f64 = f64::EPSILON;

/// An entry of the table.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Entry {
    /// The largest deviation allowed.
    value: f64,
    /// The largest one, in these tests or a longer run.
    seen: f64,
}

/// Entries by name.
type Entries = BTreeMap<String, Entry>;

/// Removes what the tests of earlier runs have written down.
pub fn emptied() -> Result<(), String> {
    files::emptied(&folder()).map(drop)
}

/// Has the tests that `command` runs write down what they see.
pub fn told(mut command: Command) -> Command {
    command.env(FOLDER, folder());
    command
}

/// The step: a check for each entry of the table.
pub fn run(steps: &mut Steps) {
    steps.step("tolerances against what was seen", || Ok(judge(&read()?)));
}

fn folder() -> PathBuf {
    target_dir("seen")
}

fn read() -> Result<Entries, String> {
    let mut entries = Entries::new();
    for file in files::within(&folder())? {
        files::text(&file)?.lines().try_for_each(|line| add(&mut entries, line))?;
    }
    Ok(entries)
}

/// Adds what a line tells.
fn add(entries: &mut Entries, line: &str) -> Result<(), String> {
    let wrong = || format!("a test says `{line}`");
    let [name, numbers @ ..] = &line.split('\t').collect::<Vec<_>>()[..] else {
        return Err(wrong());
    };
    let numbers: Result<Vec<f64>, _> = numbers.iter().map(|number| number.parse()).collect();
    let [value, worst, seen] = numbers.map_err(|_| wrong())?[..] else { return Err(wrong()) };
    let entry = entries.entry((*name).to_owned()).or_insert(Entry { value, seen: worst });
    entry.seen = entry.seen.max(seen);
    Ok(())
}

/// Counts the entries, and names those that are too loose, the loosest first.
fn judge(entries: &Entries) -> (Tally, Option<String>) {
    let factor = |entry: &Entry| entry.value / entry.seen.max(LEAST);
    let mut loose: Vec<_> = entries.iter().filter(|(_, entry)| factor(entry) > LOOSEST).collect();
    loose.sort_by(|(_, a), (_, b)| factor(b).total_cmp(&factor(a)));
    for (name, Entry { value, seen }) in &loose {
        println!("{name} allows {value:e}, seen is {seen:.1e}");
    }
    let tally = Tally { passed: entries.len() - loose.len(), failed: loose.len() };
    let why = match (entries.len(), &loose[..]) {
        (0, _) => Some("no test has written down what it sees".to_owned()),
        (_, []) => None,
        (_, [(name, _), ..]) => Some(format!(
            "{} tolerances are more than {LOOSEST} times what is seen, first {name}: take about 10 times that, or \
             `assert_eq!` where both are the same",
            loose.len()
        )),
    };
    let failed = tally.failed.max(usize::from(why.is_some()));
    (Tally { failed, ..tally }, why)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judged(lines: &[&str]) -> (Tally, Option<String>) {
        let mut entries = Entries::new();
        lines.iter().for_each(|line| add(&mut entries, line).expect("a line"));
        judge(&entries)
    }

    #[test]
    fn the_largest_deviation_of_all_processes_counts() {
        let lines = ["a\t1e-9\t0e0\t0e0", "a\t1e-9\t0e0\t2e-11", "a\t1e-9\t0e0\t1e-13"];
        assert_eq!(judged(&lines), (Tally { passed: 1, failed: 0 }, None));
        assert_eq!(judged(&["a\t1e-9\t3e-11\t0e0"]), (Tally { passed: 1, failed: 0 }, None));
    }

    #[test]
    fn a_loose_entry_is_named() {
        let (tally, why) = judged(&["a\t1e-9\t0e0\t1e-10", "solve::KNOWN\t1e-9\t0e0\t9e-12"]);
        assert_eq!(tally, Tally { passed: 1, failed: 1 });
        assert!(why.expect("a reason").contains("first solve::KNOWN"));
    }

    #[test]
    fn exact_agreement_leaves_room_for_the_last_digits_alone() {
        assert_eq!(judged(&["a\t1e-14\t0e0\t0e0"]).0, Tally { passed: 1, failed: 0 });
        assert_eq!(judged(&["a\t1e-12\t0e0\t0e0"]).0, Tally { passed: 0, failed: 1 });
    }

    #[test]
    fn silence_is_no_success() {
        let (tally, why) = judged(&[]);
        assert_eq!((tally.failed, why.is_some()), (1, true));
        assert_eq!(add(&mut Entries::new(), "a\t1").err(), Some("a test says `a\t1`".to_owned()));
    }
}
