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
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::shard::Shard;
use signorini_scene::{Error, InputError, Result};

/// One line: a case that is finished.
#[derive(Serialize, Deserialize)]
struct Line {
    of: String,
    key: String,
    value: Value,
}

/// The known cases of a campaign, and the file that takes more.
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

    /// The finding for the case `key`, of any shard; `None` where there is none, or no `T`.
    pub fn known<T: DeserializeOwned>(&self, key: &str) -> Option<T> {
        T::deserialize(self.known.get(key)?).ok()
    }

    /// Gives what is known of the case `key`, or what `work` finds, where it is this process's to find.
    ///
    /// # Errors
    /// The failure of `work`; what it finds cannot be kept.
    pub fn once<T: Serialize + DeserializeOwned + PartialEq>(
        &mut self,
        key: &str,
        mine: bool,
        work: impl FnOnce() -> Result<T>,
    ) -> Result<Option<T>> {
        if let Some(known) = self.known(key) {
            return Ok(Some(known));
        }
        if !mine {
            return Ok(None);
        }
        let found = work()?;
        self.add(key, &found)?;
        Ok(Some(found))
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

    /// Deletes the journals of all shards that nobody is writing, and their folder: the outputs of the study, written
    /// before, replace them.
    pub fn close(self) -> Result<()> {
        drop(self.file);
        journals(&self.folder)?
            .iter()
            .filter(|path| File::open(path).is_ok_and(|file| lock(&file, path).is_ok()))
            .try_for_each(|path| fs::remove_file(path).map_err(Error::io(path)))?;
        // It stays where somebody else keeps something in it, such as a shard that still runs.
        let _ = fs::remove_dir(self.folder);
        Ok(())
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
    let foreign = text
        .split(|&byte| byte == b'\n')
        .next()
        .is_some_and(|first| !first.is_empty() && text.contains(&b'\n') && parse(first).is_none());
    if foreign {
        let message = "no journal of a study: name another folder, or remove it";
        return Err(io::Error::other(message));
    }
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

/// A mark of this very program: another build measures anew.
pub(crate) fn program() -> String {
    let bytes = std::env::current_exe().and_then(fs::read);
    let digest = |bytes: Vec<u8>| format!("{:016x}", digest(&bytes));
    bytes.map_or_else(|_| env!("CARGO_PKG_VERSION").to_owned(), digest)
}

/// A number that two things hardly share.
pub(crate) fn digest(of: &(impl Hash + ?Sized)) -> u64 {
    let mut hasher = DefaultHasher::new();
    of.hash(&mut hasher);
    hasher.finish()
}

#[cfg(test)]
mod tests;
