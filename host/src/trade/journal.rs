//! The journal of a campaign: what is measured, kept from the moment it is known.
//!
//! ```text
//!   points-1-of-2.jsonl ─┐   {"of":"levee 5c2e…","key":"quads 1 f32","value":{…}}
//!   points-2-of-2.jsonl ─┼─► known cases ─► the rest is measured ─► trade.json … ─► journals deleted
//!   points.jsonl ────────┘
//! ```
//!
//! A process appends to the journal of its own shard and reads those of all: an interrupted run resumes,
//! and a run without `--shard` in the same folder merges. A line is written at once and synced; what an
//! interruption leaves of one is no JSON and is passed over. Every line names what it was measured of,
//! its fingerprint: a scene, mesh, program or target that has changed since finds nothing known.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::shard::Shard;
use crate::error::{Error, InputError, Result};

/// One line: a case that is finished.
#[derive(Serialize, Deserialize)]
struct Line {
    of: String,
    key: String,
    value: Value,
}

/// What is known of a campaign, and the file that learns more.
#[derive(Debug)]
pub struct Journal {
    folder: PathBuf,
    path: PathBuf,
    // Ends in a newline or is empty, and is locked.
    file: File,
    fingerprint: String,
    known: BTreeMap<String, Value>,
}

impl Journal {
    /// Opens the journal of `shard` in `folder`, which is made where there is none, and reads those of all
    /// shards there. Lines of another `fingerprint` are not known; an own journal of another one is
    /// emptied.
    ///
    /// # Errors
    /// Another process has this shard's journal open; files that cannot be read or written.
    pub fn open(folder: &Path, shard: Shard, fingerprint: &str) -> Result<Self> {
        fs::create_dir_all(folder).map_err(Error::io(folder))?;
        let path = folder.join(shard.journal_name());
        let mut options = OpenOptions::new();
        let file = options.read(true).append(true).create(true).open(&path);
        let mut file = file.map_err(Error::io(&path))?;
        lock(&file, &path)?;
        tidy(&mut file, fingerprint).map_err(Error::io(&path))?;
        let mut known = BTreeMap::new();
        for path in journals(folder)? {
            let text = fs::read(&path).map_err(Error::io(&path))?;
            known.extend(lines(&text, fingerprint).map(|line| (line.key, line.value)));
        }
        Ok(Self {
            folder: folder.to_owned(),
            path,
            file,
            fingerprint: fingerprint.to_owned(),
            known,
        })
    }

    /// What was found for the case `key`, by whichever shard; `None` where nothing was, or no `T`.
    pub fn known<T: DeserializeOwned>(&self, key: &str) -> Option<T> {
        T::deserialize(self.known.get(key)?).ok()
    }

    /// Keeps what was found for the case `key`; it is on the disk when this returns.
    ///
    /// # Errors
    /// `value` does not survive being written, such as one with NaN or infinity in it; the file cannot be
    /// written.
    pub fn add<T>(&mut self, key: &str, value: &T) -> Result<()>
    where
        T: Serialize + DeserializeOwned + PartialEq,
    {
        let line = self.line(key, value).ok_or_else(|| {
            Error::Check(format!("{key}: what was found is not finite and cannot be kept"))
        })?;
        // One call: a line of its own even where other processes append to the same file.
        let written = self.file.write_all(line.as_bytes()).and_then(|()| self.file.sync_data());
        written.map_err(Error::io(&self.path))?;
        self.known.extend(parse(line.as_bytes()).map(|line| (line.key, line.value)));
        Ok(())
    }

    /// Deletes the journals of all shards: the outputs of the study, written before, replace them.
    ///
    /// # Errors
    /// A file that cannot be deleted.
    pub fn close(self) -> Result<()> {
        drop(self.file);
        journals(&self.folder)?
            .iter()
            .try_for_each(|path| fs::remove_file(path).map_err(Error::io(path)))
    }

    /// A line with its newline; `None` where it reads back as something else.
    fn line<T>(&self, key: &str, value: &T) -> Option<String>
    where
        T: Serialize + DeserializeOwned + PartialEq,
    {
        let value_written = serde_json::to_value(value).ok()?;
        let line = Line { of: self.fingerprint.clone(), key: key.to_owned(), value: value_written };
        let text = serde_json::to_string(&line).ok()? + "\n";
        let read = T::deserialize(parse(text.as_bytes())?.value).ok()?;
        (read == *value).then_some(text)
    }
}

fn parse(line: &[u8]) -> Option<Line> {
    serde_json::from_slice(line).ok()
}

/// The whole lines of this fingerprint.
fn lines(text: &[u8], fingerprint: &str) -> impl Iterator<Item = Line> {
    let lines = text.split(|&byte| byte == b'\n').filter_map(parse);
    lines.filter(move |line| line.of == fingerprint)
}

/// Where a file system has no locks, nobody is kept out.
fn lock(file: &File, path: &Path) -> Result<()> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => {
            let message = format!("{}: another run is writing this journal", path.display());
            let hint = "wait for it, or give each run its own folder or shard: --shard 1/2, 2/2";
            Err(InputError::new(message).hint(hint).into())
        }
        Err(TryLockError::Error(_)) | Ok(()) => Ok(()),
    }
}

/// Empties a journal without a line of this fingerprint; otherwise ends its last line.
fn tidy(file: &mut File, fingerprint: &str) -> io::Result<()> {
    let mut text = Vec::new();
    file.read_to_end(&mut text)?;
    if lines(&text, fingerprint).next().is_none() {
        return file.set_len(0);
    }
    if text.ends_with(b"\n") { Ok(()) } else { file.write_all(b"\n") }
}

/// The journals in `folder`, in the order of their names.
fn journals(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).map_err(Error::io(folder))? {
        let entry = entry.map_err(Error::io(folder))?;
        if entry.file_name().to_str().and_then(Shard::of_journal).is_some() {
            paths.push(entry.path());
        }
    }
    paths.sort();
    Ok(paths)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tempfile::{TempDir, tempdir};

    use super::*;
    use crate::setting::{Omega, Setting};
    use crate::trade::record::{Point, PointError};

    const OF: &str = "levee, its mesh";

    fn folder() -> TempDir {
        tempdir().unwrap()
    }

    fn open(folder: &TempDir, shard: &str) -> Journal {
        Journal::open(folder.path(), shard.parse().unwrap(), OF).unwrap()
    }

    fn point(value: f64) -> Point {
        Point {
            name: "quads \"1\"\nf32 · ω".to_owned(),
            scalar: "f32".to_owned(),
            math: "libm".to_owned(),
            cells: "quads".to_owned(),
            level: 1,
            unknowns: 1264,
            stop: "12 sweeps".to_owned(),
            sweeps: 12,
            start: "warm".to_owned(),
            omega: "tuned".to_owned(),
            model: "full".to_owned(),
            certificate: true,
            error: PointError {
                energy: value,
                combined: None,
                l2: -value,
                ..PointError::default()
            },
            bound: Some(value),
            cycles: value,
            cycles_spread: 0.1,
            cycles_per_unknown: 1.0,
            instructions: Some(u64::MAX),
            ram_bytes: None,
            flash_bytes: None,
            pareto: false,
            setting: Setting { omega: Omega::Fixed(value), ..Setting::default() },
        }
    }

    #[test]
    fn an_interruption_anywhere_costs_the_line_it_cut_and_no_other() {
        let whole = folder();
        let mut journal = open(&whole, "1/1");
        (0..3_u32).for_each(|case| journal.add(&format!("case {case}"), &case).unwrap());
        drop(journal);
        let text = fs::read(whole.path().join("points.jsonl")).unwrap();
        let ends = text.iter().enumerate().filter(|(_, byte)| **byte == b'\n');
        let ends: Vec<usize> = ends.map(|(at, _)| at).collect();
        for length in 0..=text.len() {
            let cut = folder();
            fs::write(cut.path().join("points.jsonl"), &text[..length]).unwrap();
            let mut journal = open(&cut, "1/1");
            let is_known = |journal: &Journal, case: u32| {
                let found = journal.known(&format!("case {case}"));
                found.inspect(|found: &u32| assert_eq!(*found, case)).is_some()
            };
            for (case, end) in ends.iter().enumerate() {
                assert_eq!(is_known(&journal, case as u32), length >= *end, "{length}");
            }
            let missing: Vec<u32> = (0..3).filter(|case| !is_known(&journal, *case)).collect();
            missing.iter().for_each(|case| journal.add(&format!("case {case}"), case).unwrap());
            drop(journal);
            let resumed = open(&cut, "1/1");
            assert!((0..3).all(|case| is_known(&resumed, case)), "{length}");
        }
    }

    #[test]
    fn shards_merge_to_the_whole() {
        let folder = folder();
        let cases: Vec<String> = (0..7).map(|case| format!("case {case}")).collect();
        let mut journals = [open(&folder, "1/2"), open(&folder, "2/2")];
        for (shard, journal) in ["1/2", "2/2"].into_iter().zip(&mut journals) {
            let shard: Shard = shard.parse().unwrap();
            for (case, key) in cases.iter().enumerate().filter(|(case, _)| shard.takes(*case)) {
                journal.add(key, &point(case as f64)).unwrap();
            }
        }
        drop(journals);
        fs::write(folder.path().join("points-old.jsonl"), "someone's").unwrap();
        let merged = open(&folder, "1/1");
        for (case, key) in cases.iter().enumerate() {
            assert_eq!(merged.known(key), Some(point(case as f64)), "{key}");
        }
        merged.close().unwrap();
        let left: Vec<_> =
            fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().file_name()).collect();
        assert_eq!(left, ["points-old.jsonl"]);
    }

    #[test]
    fn another_fingerprint_is_replaced_and_never_mixed() {
        let folder = folder();
        let stale =
            |shard: &str| Journal::open(folder.path(), shard.parse().unwrap(), "stale").unwrap();
        stale("1/2").add("case", &1).unwrap();
        stale("1/1").add("case", &1).unwrap();
        let mut journal = open(&folder, "1/1");
        assert_eq!(journal.known::<i32>("case"), None);
        journal.add("case", &2).unwrap();
        drop(journal);
        assert_eq!(open(&folder, "2/2").known("case"), Some(2));
        assert_eq!(stale("2/3").known("case"), Some(1), "that of shard 1/2 is not ours to empty");
        assert!(!fs::read_to_string(folder.path().join("points.jsonl")).unwrap().contains("stale"));
    }

    #[test]
    fn what_json_cannot_hold_is_refused_and_leaves_no_trace() {
        let folder = folder();
        let mut journal = open(&folder, "1/1");
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(matches!(journal.add("case", &point(value)), Err(Error::Check(_))));
        }
        assert_eq!(journal.known::<Point>("case"), None);
        assert_eq!(fs::read(folder.path().join("points.jsonl")).unwrap(), b"");
    }

    #[test]
    fn two_runs_do_not_share_a_journal() {
        let folder = folder();
        let first = open(&folder, "1/2");
        let second = Journal::open(folder.path(), "1/2".parse().unwrap(), OF).unwrap_err();
        assert!(second.to_string().contains("points-1-of-2.jsonl: another run"), "{second}");
        open(&folder, "2/2");
        drop(first);
        open(&folder, "1/2");
    }

    #[test]
    fn a_value_of_another_kind_is_not_known() {
        let folder = folder();
        let mut journal = open(&folder, "1/1");
        journal.add("case", &"skipped: no room".to_owned()).unwrap();
        assert_eq!(journal.known::<Point>("case"), None);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn every_finite_number_survives_to_the_bit(bits: u64) {
            let value = f64::from_bits(bits);
            prop_assume!(value.is_finite());
            let text = serde_json::to_string(&point(value)).unwrap();
            let read: Point = serde_json::from_str(&text).unwrap();
            prop_assert_eq!(read.cycles.to_bits(), bits);
            let value_read: Value = serde_json::from_str(&text).unwrap();
            prop_assert_eq!(Point::deserialize(value_read).unwrap().bound.unwrap().to_bits(), bits);
        }
    }
}
