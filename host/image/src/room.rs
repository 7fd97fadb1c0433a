//! Why there is no image of a module for a board.
//!
//! A linker says in prose that an image has no room. What it lacks is measured instead: the image is linked once more,
//! for a board without bounds, and its sections are compared with the board's memory.

use std::fmt;
use std::path::PathBuf;

use crate::board::Board;
use crate::footprint::Statics;

/// Why there is no image.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoImage {
    /// The board's memory ends before the image does.
    NoRoom {
        /// `flash` or `RAM`.
        memory: &'static str,
        /// Bytes.
        missing: u64,
    },
    /// A tool failed, and what it said.
    Failed(String),
}

impl NoImage {
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

impl fmt::Display for NoImage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoRoom { memory, missing } => {
                write!(f, "no room in {memory}: {missing} bytes are missing")
            }
            Self::Failed(why) => f.write_str(why),
        }
    }
}

impl From<NoImage> for String {
    fn from(why: NoImage) -> Self {
        why.to_string()
    }
}
