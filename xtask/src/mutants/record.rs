//! The findings on each file, in git: `tests/mutants/record.json`.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::Command;

use serde::{Deserialize, Serialize};

use crate::snapshot;
use signorini_image::cargo::root;
use signorini_image::files::below;
use signorini_image::toolchain::output;

const PATH: &str = "tests/mutants/record.json";

/// The fates of the mutants of a file.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Row {
    /// Git's name for the content that was mutated.
    pub content: String,
    /// A test failed.
    pub caught: usize,
    /// A test did not end.
    pub timeout: usize,
    /// All tests passed.
    pub missed: usize,
    /// The mutant does not compile.
    pub unviable: usize,
}

/// Files by path.
#[derive(Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Record(pub BTreeMap<String, Row>);

impl Record {
    /// The record in git; empty where there is none.
    pub fn read() -> Result<Self, String> {
        snapshot::record(PATH)
    }

    /// Writes the record.
    pub fn write(&self) -> Result<(), String> {
        snapshot::write_record(PATH, self)
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
    let below = SOURCES.map(|folder| below(&root().join(folder), &[]));
    let files = below.into_iter().collect::<Result<Vec<_>, _>>()?.concat();
    let from_root = |file: PathBuf| file.strip_prefix(root()).ok()?.to_str().map(str::to_owned);
    let mut files: Vec<String> = files.into_iter().filter_map(from_root).collect();
    files.retain(|file| file.ends_with(".rs"));
    files.sort_unstable();
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_compile_is_not_killed() {
        let row =
            Row { content: "5f0c".to_owned(), caught: 41, timeout: 3, missed: 1, unviable: 1 };
        let record = Record([("a".to_owned(), row.clone()), ("b".to_owned(), row)].into());
        assert_eq!(record.killed(), (88, 90));
    }
}
