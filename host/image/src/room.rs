//! Why there is no image of a module for a board, or no result of it.
//!
//! A linker says in prose that an image has no room. What it lacks is measured instead: the image is linked once more,
//! for a board without bounds, and its sections are compared with the board's memory.

use std::fmt;
use std::path::PathBuf;

use crate::board::Board;
use crate::footprint::Statics;

/// Why there is no result.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoResult {
    /// The board's memory ends before the image does.
    NoRoom {
        /// `flash` or `RAM`.
        memory: &'static str,
        /// Bytes.
        missing: u64,
    },
    /// A tick takes longer than the board can count.
    BeyondCounter,
    /// A tool or a program failed, and what it said.
    Failed(String),
}

impl NoResult {
    /// Of an image that did not link for `board`, and why; `boundless` links it without bounds.
    pub(crate) fn of(
        board: &Board,
        why: String,
        boundless: impl FnOnce() -> Result<PathBuf, String>,
    ) -> Self {
        let Ok(statics) = boundless().and_then(|image| Statics::of(&image)) else {
            return Self::Failed(why);
        };
        let over = [("flash", statics.flash(), board.flash), ("RAM", statics.ram, board.ram)];
        let missing = over.into_iter().find(|(_, takes, has)| takes > has);
        missing.map_or(Self::Failed(why), |(memory, takes, has)| Self::NoRoom {
            memory,
            missing: takes - has,
        })
    }
}

impl fmt::Display for NoResult {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoRoom { memory, missing } => {
                write!(f, "no room in {memory}: {missing} bytes are missing")
            }
            Self::BeyondCounter => {
                f.write_str("a tick takes longer than the board's counter can count")
            }
            Self::Failed(why) => f.write_str(why),
        }
    }
}

impl From<String> for NoResult {
    fn from(why: String) -> Self {
        Self::Failed(why)
    }
}

impl From<NoResult> for String {
    fn from(why: NoResult) -> Self {
        why.to_string()
    }
}
