//! Files of an example, which its reader may change: what a bake wrote, the next one writes anew; what somebody has changed
//! since then stays.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use signorini_bake::fingerprint::Fingerprint;
use signorini_files::atomic::write_atomically;
use signorini_scene::error::Result;

/// The file that tells what was written: `fingerprint path`, a line each.
const RECORD: &str = "example/.baked";

/// Fingerprints of the example's files as bakes wrote them last, by path.
#[derive(Debug, Default)]
pub(super) struct Written(BTreeMap<String, u64>);

impl Written {
    /// What bakes have written into `folder`: nothing, where no record is there.
    pub fn into(folder: &Path) -> Self {
        let text = fs::read_to_string(folder.join(RECORD)).unwrap_or_default();
        let line = |line: &str| {
            let (number, path) = line.split_once(' ')?;
            Some((path.to_owned(), u64::from_str_radix(number, 16).ok()?))
        };
        Self(text.lines().filter_map(line).collect())
    }

    /// Whether `bytes` may take the place of the file at `path`: nobody has changed it.
    pub fn may_be_replaced(&self, path: &str, own: &[u8], bytes: &[u8]) -> bool {
        own == bytes || self.0.get(path) == Some(&Fingerprint::of(own).0)
    }

    /// Notes that `bytes` stand at `path` now.
    pub fn note(&mut self, path: &str, bytes: &[u8]) {
        self.0.insert(path.to_owned(), Fingerprint::of(bytes).0);
    }

    /// Writes the record.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn keep(&self, folder: &Path) -> Result<()> {
        let lines = self.0.iter().map(|(path, number)| format!("{number:016x} {path}\n"));
        write_atomically(&folder.join(RECORD), lines.collect::<String>().as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_nobody_has_changed_is_written_anew() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut written = Written::into(folder.path());
        assert!(!written.may_be_replaced("example/main.c", b"old", b"new"));
        written.note("example/main.c", b"old");
        written.keep(folder.path()).expect("a file");
        let written = Written::into(folder.path());
        assert!(written.may_be_replaced("example/main.c", b"old", b"new"));
        assert!(!written.may_be_replaced("example/main.c", b"old, and mine", b"new"));
        assert!(written.may_be_replaced("example/main.c", b"new", b"new"));
        assert!(!written.may_be_replaced("example/board.c", b"old", b"new"));
    }
}
