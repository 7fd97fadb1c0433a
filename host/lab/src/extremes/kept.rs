//! The cases that are finished, kept from the moment they are: the same command goes on where it was interrupted.

use std::collections::BTreeSet;
use std::ops::RangeInclusive;
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::trade::journal::{Journal, program};
use crate::trade::shard::Shard;
use signorini_problem::threads::on_two_threads;
use signorini_scene::{Error, Result};

/// The findings of a run, for its folder and for the terminal.
#[derive(Debug)]
pub struct Findings {
    /// Files by their names.
    pub files: Vec<(&'static str, Vec<u8>)>,
    /// Words for the terminal.
    pub text: String,
    /// Numbers of the cases that are wrong.
    pub wrong: BTreeSet<u32>,
}

/// A finished case, and the seconds that all runs together had taken by then.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Line<T> {
    row: T,
    elapsed: f64,
}

/// Finished cases, in a folder that goes once everything is finished.
#[derive(Debug)]
pub struct Kept {
    journal: Mutex<Journal>,
    start: Instant,
    /// Seconds of the runs before.
    before: Mutex<f64>,
}

impl Kept {
    /// Opens what an interrupted run of this very program left in the folder `out`; another program's is forgotten.
    pub fn open(out: &Path) -> Result<Self> {
        let folder = out.join("unfinished");
        let journal = Mutex::new(Journal::open(&folder, Shard::WHOLE, &program())?);
        Ok(Self { journal, start: Instant::now(), before: Mutex::default() })
    }

    /// The row that is known of the case `key`, or what `work` finds.
    pub(super) fn row<T: Serialize + DeserializeOwned + PartialEq>(
        &self,
        key: &str,
        work: impl FnOnce() -> Result<T>,
    ) -> Result<T> {
        if let Some(Line { row, elapsed }) = held(&self.journal).known(key) {
            let mut before = held(&self.before);
            *before = before.max(elapsed);
            return Ok(row);
        }
        let row = work()?;
        let line = Line { row, elapsed: self.seconds() };
        match held(&self.journal).add(key, &line) {
            // What does not survive being written is worked out again.
            Ok(()) | Err(Error::Check(_)) => Ok(line.row),
            Err(error) => Err(error),
        }
    }

    /// Finds in two threads the rows of these cases, each under its `key`; calls `done` after each.
    pub(super) fn rows<T: Serialize + DeserializeOwned + PartialEq + Send>(
        &self,
        cases: RangeInclusive<u32>,
        key: impl Fn(u32) -> String + Sync,
        row: impl Fn(u32) -> T + Sync,
        done: impl Fn() + Sync,
    ) -> Result<Vec<T>> {
        let work = |&number: &u32| self.row(&key(number), || Ok(row(number)));
        on_two_threads(&cases.collect::<Vec<_>>(), work, done)
    }

    /// Seconds of all runs.
    pub(super) fn seconds(&self) -> f64 {
        *held(&self.before) + self.start.elapsed().as_secs_f64()
    }

    /// Deletes what only an interrupted run needs.
    pub fn close(self) -> Result<()> {
        self.journal.into_inner().unwrap_or_else(PoisonError::into_inner).close()
    }
}

/// Locks a journal, also after a panic: every line is written at once and whole.
fn held<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::super::record::{Row, tests::fixture};
    use super::*;

    #[test]
    fn what_is_finished_is_not_done_again() {
        let folder = tempfile::tempdir().unwrap();
        let row = fixture().cases.swap_remove(0);
        let never = || -> Result<Row> { panic!("asked for by a test") };
        let first = Kept::open(folder.path()).unwrap();
        assert_eq!(first.row("a", || Ok(row.clone())).unwrap(), row);
        // Interrupted here: nothing is closed.
        drop(first);
        let second = Kept::open(folder.path()).unwrap();
        assert_eq!(second.row("a", never).unwrap(), row);
        let other = Row { note: "another".to_owned(), ..row.clone() };
        assert_eq!(second.row("b", || Ok(other.clone())).unwrap(), other);
        second.close().unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
