//! The record in git: how much has been fuzzed so far, and what came of it.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::snapshot;

const PATH: &str = "tests/fuzz/record.json";

/// The runs of a target.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Fuzzed {
    /// Clean executions of every run so far.
    pub executions: u64,
    /// Edges of the program that the inputs of the last run reach.
    pub edges: u64,
    /// How many inputs reach them all.
    pub corpus: u64,
    /// Cases that broke an invariant once, mended and replayed since.
    pub found: u64,
    /// The day of the last run.
    pub date: String,
}

/// Targets by name.
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Record(BTreeMap<String, Fuzzed>);

impl Record {
    /// The recorded one.
    pub fn read() -> Result<Self, String> {
        snapshot::record(PATH)
    }

    /// Adds a run of a target.
    pub fn add(&mut self, target: &str, run: Fuzzed) {
        let before = self.0.get(target).map_or(0, |known| known.executions);
        let executions = before + run.executions;
        self.0.insert(target.to_owned(), Fuzzed { executions, ..run });
    }

    /// Writes it.
    pub fn write(&self) -> Result<(), String> {
        snapshot::write_record(PATH, self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn executions_add_up_and_the_rest_is_of_the_last_run() {
        let run = |executions, edges| Fuzzed { executions, edges, ..Fuzzed::default() };
        let mut record = Record::default();
        record.add("scene", run(40, 900));
        record.add("mesh", run(5, 100));
        record.add("scene", run(60, 950));
        let expected = [("mesh", run(5, 100)), ("scene", run(100, 950))];
        assert_eq!(record.0, expected.map(|(name, of)| (name.to_owned(), of)).into());
    }
}
