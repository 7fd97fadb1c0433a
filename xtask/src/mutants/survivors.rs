//! The mutants that no test kills, each with a reason why it may live: `tests/mutants/survivors.txt`.
//!
//! ```text
//!   kernel/src/psor.rs | defect | replace < with <= in defect
//!       include(if own - lower «<» -step { own - lower } else { step }.magnitude());
//!       reason: both are the same number there
//! ```
//! A mutant is known by its file, what it does and the line with its place, so that lines may move.

use std::collections::BTreeMap;
use std::fs;

use serde::Deserialize;

use crate::snapshot::write;
use signorini_image::cargo::root;

const PATH: &str = "tests/mutants/survivors.txt";
const HEAD: &str = "\
# Mutants of the kernel that no test kills; `cargo xtask mutants` writes the list, a person each reason.
# Equal lines of one function share an entry: xN counts them.
";
const REASON: &str = "reason:";

/// What a mutant is known by.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
pub struct Key {
    /// Its file, from the root.
    pub file: String,
    /// What it does.
    pub what: String,
    /// The line, its place marked.
    pub line: String,
}

/// How many there are of a kind, and the reason why they may live, if any is given.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Entry {
    /// Mutants with the same key.
    pub count: usize,
    /// A person's words; nothing where nobody has looked.
    pub reason: String,
}

/// All survivors.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Survivors(pub BTreeMap<Key, Entry>);

impl Survivors {
    /// The list in git; empty where there is none.
    pub fn read() -> Result<Self, String> {
        Self::parse(&fs::read_to_string(root().join(PATH)).unwrap_or_default())
    }

    fn parse(text: &str) -> Result<Self, String> {
        let mut lines = text.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
        let mut survivors = Self::default();
        while let Some(head) = lines.next() {
            let wrong = || format!("{PATH}: `{head}` does not begin an entry");
            let (file, what) = head.split_once(" | ").ok_or_else(wrong)?;
            let (what, count) = match what.rsplit_once(" | x") {
                Some((what, count)) => (what, count.parse().map_err(|_| wrong())?),
                None => (what, 1),
            };
            let line = lines.next().ok_or_else(wrong)?.trim().to_owned();
            let reason = lines.next().and_then(|line| line.trim().strip_prefix(REASON));
            let reason = reason.ok_or_else(wrong)?.trim().to_owned();
            let key = Key { file: file.to_owned(), what: what.to_owned(), line };
            survivors.0.insert(key, Entry { count, reason });
        }
        Ok(survivors)
    }

    fn text(&self) -> String {
        let entry = |(key, entry): (&Key, &Entry)| {
            let count =
                if entry.count > 1 { format!(" | x{}", entry.count) } else { String::new() };
            let Key { file, what, line } = key;
            let reason = format!("{REASON} {}", entry.reason);
            format!("\n{file} | {what}{count}\n    {line}\n    {}\n", reason.trim_end())
        };
        format!("{HEAD}{}", self.0.iter().map(entry).collect::<String>())
    }

    /// Writes the list.
    pub fn write(&self) -> Result<(), String> {
        write(PATH, &self.text())
    }

    /// Puts `found` in the place of all survivors of `file`; reasons given before stay.
    pub fn replace(&mut self, file: &str, found: &[Key]) {
        let mut reasons = BTreeMap::new();
        self.0.retain(|key, entry| {
            let stays = key.file != file;
            if !stays {
                reasons.insert(key.clone(), std::mem::take(&mut entry.reason));
            }
            stays
        });
        for key in found {
            let entry = self.0.entry(key.clone()).or_default();
            entry.count += 1;
            entry.reason = reasons.get(key).cloned().unwrap_or_default();
        }
    }

    /// How many there are in `file`.
    pub fn of(&self, file: &str) -> usize {
        self.0.iter().filter(|(key, _)| key.file == file).map(|(_, entry)| entry.count).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(line: &str) -> Key {
        let (file, what) = ("kernel/src/psor.rs", "replace < with <= in defect");
        Key { file: file.to_owned(), what: what.to_owned(), line: line.to_owned() }
    }

    #[test]
    fn the_list_is_read_as_it_was_written() {
        let mut survivors = Survivors::default();
        survivors.replace("kernel/src/psor.rs", &[key("a «<» b"), key("c «<» d"), key("c «<» d")]);
        assert_eq!(survivors.of("kernel/src/psor.rs"), 3);
        assert_eq!(Survivors::parse(&survivors.text()), Ok(survivors));
    }

    #[test]
    fn reasons_outlive_a_run() {
        let text =
            "kernel/src/psor.rs | replace < with <= in defect\n  a «<» b\n  reason: equal there\n";
        let mut survivors = Survivors::parse(text).unwrap();
        survivors.replace("kernel/src/psor.rs", &[key("a «<» b"), key("c «<» d")]);
        let reasons: Vec<_> = survivors.0.values().map(|entry| entry.reason.as_str()).collect();
        assert_eq!(reasons, ["equal there", ""]);
        survivors.replace("kernel/src/psor.rs", &[]);
        assert_eq!(survivors, Survivors::default());
    }

    #[test]
    fn an_entry_without_its_lines_is_refused() {
        for head in ["kernel/src/psor.rs | replace < with <=", "kernel/src/psor.rs"] {
            let refused = Survivors::parse(&format!("{head}\n  a «<» b\n")).expect_err("refused");
            assert!(refused.contains(head), "{refused}");
        }
    }
}
