//! A table of figures in git: the same versions must count the same, up to a tolerance.
//!
//! The first line names the versions that the figures belong to. With other versions the table is
//! printed and nothing is compared, since another compiler makes other code.

use std::process::Command;

use crate::snapshot;
use signorini_image::board::emulator;
use signorini_image::toolchain::{Toolchain, first_words, output};

/// The part that may be lost before a check fails.
const TOLERANCE: f64 = 0.02;

/// The versions that counts on boards depend on.
pub fn versions() -> Result<String, String> {
    Ok(format!("{}, {}", Toolchain::find("thumbv7em-none-eabihf")?.version()?, emulator()?))
}

/// The versions that counts on boards depend on, and that of GCC.
pub fn versions_with_gcc() -> Result<String, String> {
    let gcc = output(Command::new("arm-none-eabi-gcc").arg("-dumpfullversion"))?;
    Ok(format!("{}, GCC {}", versions()?, first_words(&gcc, 1)))
}

/// Whether the record is one of these versions.
pub fn is_of(path: &str, versions: &str) -> Result<bool, String> {
    let recorded = snapshot::read(path)?;
    Ok(recorded.lines().next().is_some_and(|by| by.trim() == versions))
}

/// Compares `table` with the record, or writes it. `false`: the record is one of other versions.
pub fn compare(path: &str, versions: &str, table: &str, bless: bool) -> Result<bool, String> {
    if bless {
        return snapshot::write(path, &format!("{versions}\n\n{table}")).map(|()| true);
    }
    compared(path, versions, table, str::to_owned)
}

/// Compares a table that is a part of the record: some of its blocks, or some rows of one.
pub fn compare_part(path: &str, versions: &str, table: &str) -> Result<bool, String> {
    compared(path, versions, table, |figures| part(figures, table))
}

fn compared(
    path: &str,
    versions: &str,
    table: &str,
    of: impl Fn(&str) -> String,
) -> Result<bool, String> {
    let recorded = snapshot::read(path)?;
    let (by, figures) = recorded.split_once('\n').unwrap_or_default();
    if !(by.starts_with("rustc ") && by.contains(", QEMU ")) {
        return Err(format!("{path} does not begin with versions; --bless writes it anew"));
    }
    if by.trim() != versions {
        println!("{path} is a record of `{by}`, this is `{versions}`: nothing is compared");
        return Ok(false);
    }
    let worse = regressions(&of(figures), table)?;
    if worse.is_empty() { Ok(true) } else { Err(format!("{path}: {}", worse.join("; "))) }
}

/// The blocks of `record` that begin with the lines that those of `table` begin with, and of each the rows that are in that one.
pub fn part(record: &str, table: &str) -> String {
    let blocks = |text: &str| -> Vec<Vec<String>> {
        let blocks = text.trim().split("\n\n");
        blocks.map(|block| block.lines().map(str::to_owned).collect()).collect()
    };
    let mut recorded = blocks(record).into_iter();
    let kept = blocks(table).into_iter().filter_map(|now| {
        let old = recorded.find(|old| old.first() == now.first())?;
        let is_there = |line: &String| now.iter().any(|now| cells(now).0 == cells(line).0);
        Some(old.into_iter().filter(is_there).collect::<Vec<_>>().join("\n"))
    });
    kept.collect::<Vec<_>>().join("\n\n")
}

/// The figures of two tables that differ by more than the tolerance.
pub fn differences(old: &str, new: &str) -> Result<Vec<String>, String> {
    Ok([regressions(old, new)?, regressions(new, old)?].concat())
}

/// The figures of `new` that exceed those of `old` by more than the tolerance.
fn regressions(old: &str, new: &str) -> Result<Vec<String>, String> {
    let (old, new) = (lines(old), lines(new));
    if old.len() != new.len() {
        return Err(format!("{} lines are recorded, now there are {}", old.len(), new.len()));
    }
    let mut worse = Vec::new();
    for (old, new) in old.into_iter().zip(new) {
        let (of, figures) = cells(old);
        let (is, now) = cells(new);
        if of != is || figures.len() != now.len() {
            return Err(format!("recorded is `{old}`, now `{new}`; --bless where that is meant"));
        }
        for (was, now) in figures.into_iter().zip(now) {
            if now > was * (1.0 + TOLERANCE) || now.is_nan() {
                worse.push(format!("{is}: {now}, recorded {was}"));
            }
        }
    }
    Ok(worse)
}

fn lines(table: &str) -> Vec<&str> {
    table.lines().map(str::trim).filter(|line| !line.is_empty()).collect()
}

/// The words of a line, and the numbers.
fn cells(line: &str) -> (String, Vec<f64>) {
    let (numbers, words): (Vec<_>, Vec<_>) =
        line.split_whitespace().partition(|word| word.parse::<f64>().is_ok());
    (words.join(" "), numbers.iter().filter_map(|word| word.parse().ok()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_percent_pass_and_more_does_not() {
        let old = "sweep unknown 22.90 34.00\n";
        assert_eq!(regressions(old, "sweep unknown 23.30 30.00\n"), Ok(Vec::new()));
        let worse = regressions(old, "sweep unknown 23.40 34.00\n").unwrap();
        assert_eq!(worse, ["sweep unknown: 23.4, recorded 22.9"]);
    }

    #[test]
    fn a_part_is_compared_with_its_own_blocks_and_rows() {
        let record = "\nM4F x\nsweep 1\n\nM7 x\nsweep 2\n\nM4F x\nflux 3\nload 4\n";
        assert_eq!(
            part(record, "M4F x\nsweep 9\n\nM4F x\nload 9\n"),
            "M4F x\nsweep 1\n\nM4F x\nload 4"
        );
        assert_eq!(part(record, "M8 x\nsweep 9\n"), "");
    }

    #[test]
    fn another_table_is_not_compared_in_silence() {
        let refused = |new| regressions("sweep 1.0\n", new).expect_err("another table");
        assert!(refused("flux 1.0\n").contains("recorded is `sweep 1.0`, now `flux 1.0`"));
        assert!(refused("sweep 1.0 2.0\n").contains("now `sweep 1.0 2.0`"));
        assert_eq!(refused(""), "1 lines are recorded, now there are 0");
        assert!(!regressions("sweep 1.0\n", "sweep NaN\n").unwrap_or_default().is_empty());
    }
}
