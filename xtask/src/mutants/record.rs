//! What was found of each file, in git: `tests/mutants/record.txt`.
//!
//! ```text
//!   kernel/src/psor.rs 5f0c… 46 41 3 1 1      content, mutants, caught, timeout, missed, unviable
//! ```

use std::collections::BTreeMap;
use std::fs;
use std::process::Command;

use crate::snapshot::write;
use signorini_image::cargo::root;
use signorini_image::toolchain::output;

const PATH: &str = "tests/mutants/record.txt";
const HEAD: &str = "\
# Mutants of the kernel, a line a file; written by `cargo xtask mutants`.
# content (git hash-object) | mutants | caught by a test | timeout: a test does not end | missed | unviable
";

/// What became of the mutants of a file.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Row {
    /// Git's name for the content that was mutated.
    pub content: String,
    /// A test failed.
    pub caught: usize,
    /// A test did not end.
    pub timeout: usize,
    /// All tests passed.
    pub missed: usize,
    /// It does not compile.
    pub unviable: usize,
}

/// Files by path.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Record(pub BTreeMap<String, Row>);

impl Row {
    fn line(&self, path: &str) -> String {
        let Self { content, caught, timeout, missed, unviable } = self;
        let mutants = caught + timeout + missed + unviable;
        format!("{path} {content} {mutants} {caught} {timeout} {missed} {unviable}\n")
    }

    fn parse(line: &str) -> Option<(String, Self)> {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [path, content, counts @ ..] = &words[..] else { return None };
        let counts: Vec<usize> = counts.iter().filter_map(|word| word.parse().ok()).collect();
        let [mutants, caught, timeout, missed, unviable] = counts[..] else { return None };
        let row = Self { content: (*content).to_owned(), caught, timeout, missed, unviable };
        (mutants == caught + timeout + missed + unviable).then(|| ((*path).to_owned(), row))
    }
}

impl Record {
    /// The record in git; empty where there is none.
    pub fn read() -> Result<Self, String> {
        Self::parse(&fs::read_to_string(root().join(PATH)).unwrap_or_default())
    }

    fn parse(text: &str) -> Result<Self, String> {
        let lines = text.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
        let row = |line| Row::parse(line).ok_or_else(|| format!("{PATH}: `{line}` is no row"));
        lines.map(row).collect::<Result<_, _>>().map(Self)
    }

    fn text(&self) -> String {
        let lines: String = self.0.iter().map(|(path, row)| row.line(path)).collect();
        format!("{HEAD}{lines}")
    }

    /// Writes the record.
    pub fn write(&self) -> Result<(), String> {
        write(PATH, &self.text())
    }

    /// Killed and viable mutants of all files.
    pub fn killed(&self) -> (usize, usize) {
        let rows = self.0.values();
        rows.fold((0, 0), |(killed, viable), row| {
            let own = row.caught + row.timeout;
            (killed + own, viable + own + row.missed)
        })
    }
}

/// Git's name for the content of a file.
pub fn content(path: &str) -> Result<String, String> {
    let mut command = Command::new("git");
    let said = output(command.args(["hash-object", "--", path]).current_dir(root()))?;
    Ok(said.trim().to_owned())
}

/// Where the sources of the kernel's crates are.
pub const SOURCES: [&str; 4] =
    ["kernel/src", "kernel/bound/src", "kernel/contact/src", "kernel/device/src"];

/// The kernel's source files, by path from the root.
pub fn sources() -> Result<Vec<String>, String> {
    let (mut folders, mut files) = (SOURCES.map(str::to_owned).to_vec(), Vec::new());
    while let Some(folder) = folders.pop() {
        let entries = fs::read_dir(root().join(&folder)).map_err(|e| format!("{folder}: {e}"))?;
        for entry in entries {
            let entry = entry.map_err(|error| error.to_string())?;
            let path = format!("{folder}/{}", entry.file_name().display());
            if entry.path().is_dir() {
                folders.push(path);
            } else if path.ends_with(".rs") {
                files.push(path);
            }
        }
    }
    files.sort_unstable();
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row() -> Row {
        Row { content: "5f0c".to_owned(), caught: 41, timeout: 3, missed: 1, unviable: 1 }
    }

    #[test]
    fn a_record_is_read_as_it_was_written() {
        let record = Record([("kernel/src/psor.rs".to_owned(), row())].into());
        assert!(record.text().ends_with("\nkernel/src/psor.rs 5f0c 46 41 3 1 1\n"));
        assert_eq!(Record::parse(&record.text()), Ok(record));
    }

    #[test]
    fn counts_must_add_up() {
        for row in ["kernel/src/psor.rs 5f0c 47 41 3 1 1", "kernel/src/psor.rs 5f0c 46 41 3"] {
            let refused = Record::parse(&format!("{row}\n"));
            assert_eq!(refused, Err(format!("{PATH}: `{row}` is no row")));
        }
    }

    #[test]
    fn what_does_not_compile_is_not_killed() {
        let record = Record([("a".to_owned(), row()), ("b".to_owned(), row())].into());
        assert_eq!(record.killed(), (88, 90));
    }
}
