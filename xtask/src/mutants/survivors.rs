//! The mutants that no test kills, each with a reason why it may live: `tests/mutants/survivors.json`.
//!
//! `cargo xtask mutants` writes the list, a person each reason. A mutant is known by its file, what it does and the line with its
//! place, so that lines may move.

use serde::{Deserialize, Serialize};

use crate::snapshot;

const PATH: &str = "tests/mutants/survivors.json";

/// The marks by which a mutant is known.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Key {
    /// Its file, from the root.
    pub file: String,
    /// The change that it makes.
    pub what: String,
    /// The line, its place marked.
    pub line: String,
}

/// A mutant that lives.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Survivor {
    /// The marks by which it is known.
    #[serde(flatten)]
    pub key: Key,
    /// How many have this key: equal lines of one function.
    pub count: usize,
    /// A person's words; nothing where nobody has looked.
    pub reason: String,
}

/// All survivors, in the order of their keys.
#[derive(Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Survivors(pub Vec<Survivor>);

impl Survivors {
    /// The list in git; empty where there is none.
    pub fn read() -> Result<Self, String> {
        snapshot::record(PATH)
    }

    /// Writes the list.
    pub fn write(&self) -> Result<(), String> {
        snapshot::write_record(PATH, self)
    }

    /// Puts `found` in the place of all survivors of `file`; reasons given before stay.
    pub fn replace(&mut self, file: &str, found: &[Key]) {
        let before: Vec<_> = self.0.extract_if(.., |known| known.key.file == file).collect();
        for key in found {
            if let Some(same) = self.0.iter_mut().find(|known| known.key == *key) {
                same.count += 1;
                continue;
            }
            let reason = before.iter().find(|known| known.key == *key);
            let reason = reason.map(|known| known.reason.clone()).unwrap_or_default();
            self.0.push(Survivor { key: key.clone(), count: 1, reason });
        }
        self.0.sort_by(|a, b| a.key.cmp(&b.key));
    }

    /// How many there are in `file`.
    pub fn of(&self, file: &str) -> usize {
        self.0.iter().filter(|known| known.key.file == file).map(|known| known.count).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_outlive_a_run() {
        let (file, what) = ("kernel/src/psor.rs", "replace < with <= in defect");
        let key = |line: &str| Key { file: file.into(), what: what.into(), line: line.into() };
        let mut survivors = Survivors::default();
        survivors.replace(file, &[key("c «<» d"), key("a «<» b"), key("c «<» d")]);
        assert_eq!((survivors.of(file), survivors.0.len()), (3, 2));
        survivors.0[0].reason = "equal there".to_owned();
        survivors.replace(file, &[key("a «<» b"), key("e «<» f")]);
        let reasons: Vec<_> = survivors.0.iter().map(|known| known.reason.as_str()).collect();
        assert_eq!(reasons, ["equal there", ""]);
        survivors.replace(file, &[]);
        assert_eq!(survivors, Survivors::default());
    }
}
