//! The record in git: how much has been fuzzed so far, and what came of it.

use std::fs;

use crate::snapshot;
use signorini_image::cargo::root;

const PATH: &str = "tests/fuzz/record.txt";

const HEAD: &str = "\
Clean executions of every run so far, of which `cargo xtask fuzz --runs N` makes more; of the last run the
edges of the program that its inputs reach, and how many inputs reach them all. Found: cases that broke an
invariant once, mended and replayed since.

target          executions     edges    corpus     found  last run
";

/// A line of it.
#[derive(Debug, PartialEq)]
struct Line {
    target: String,
    executions: u64,
    numbers: [u64; 3],
    date: String,
}

/// The table.
#[derive(Debug, PartialEq)]
pub struct Record(Vec<Line>);

impl Record {
    /// The recorded one.
    pub fn read() -> Result<Self, String> {
        match fs::read_to_string(root().join(PATH)) {
            Ok(text) => Self::parse(&text),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(Self(Vec::new())),
            Err(error) => Err(format!("{PATH}: {error}")),
        }
    }

    fn parse(text: &str) -> Result<Self, String> {
        let lines = text.strip_prefix(HEAD).ok_or_else(|| format!("{PATH}: another head"))?.lines();
        let read = |line: &str| {
            let words: Vec<_> = line.split_whitespace().collect();
            let [target, executions, edges, corpus, found, date] = words[..] else { return None };
            Some(Line {
                target: target.to_owned(),
                executions: executions.parse().ok()?,
                numbers: [edges.parse().ok()?, corpus.parse().ok()?, found.parse().ok()?],
                date: date.to_owned(),
            })
        };
        lines
            .map(|line| read(line).ok_or_else(|| format!("{PATH}: `{line}`")))
            .collect::<Result<_, _>>()
            .map(Self)
    }

    /// Adds a run of a target, with the sizes of its corpus and of what was found.
    pub fn add(&mut self, target: &str, executions: u64, edges: u64, cases: [u64; 2], date: &str) {
        let [corpus, found] = cases;
        let before = self.0.iter().position(|line| line.target == target);
        let before = before.map(|at| self.0.remove(at).executions);
        self.0.push(Line {
            target: target.to_owned(),
            executions: before.unwrap_or(0) + executions,
            numbers: [edges, corpus, found],
            date: date.to_owned(),
        });
        self.0.sort_by(|a, b| a.target.cmp(&b.target));
    }

    /// Writes it.
    pub fn write(&self) -> Result<(), String> {
        snapshot::write(PATH, &self.text())
    }

    fn text(&self) -> String {
        let line = |Line { target, executions, numbers: [edges, corpus, found], date }: &Line| {
            format!("{target:<14}{executions:>12}{edges:>10}{corpus:>10}{found:>10}  {date}\n")
        };
        HEAD.to_owned() + &self.0.iter().map(line).collect::<String>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn executions_add_up_and_the_rest_is_of_the_last_run() {
        let mut record = Record(Vec::new());
        record.add("scene", 40, 900, [7, 1], "2026-11-20");
        record.add("mesh", 5, 100, [3, 0], "2026-11-20");
        record.add("scene", 60, 950, [8, 2], "2026-11-21");
        let text = record.text();
        assert!(text.ends_with(
            "mesh                     5       100         3         0  2026-11-20\n\
             scene                  100       950         8         2  2026-11-21\n"
        ));
        assert_eq!(Record::parse(&text), Ok(record));
        let refused = |text: &str| Record::parse(text).expect_err("no record");
        assert!(refused(&text.replace("950", "many")).contains("many"));
        assert!(refused("another file\n").contains("another head"));
    }
}
