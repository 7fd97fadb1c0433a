//! Whose cost decides.

use std::fmt;

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

use crate::record_file::word;
use signorini_image::board::{Board, M4F, M7};

/// This machine or an emulated board.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Target {
    /// This machine.
    Host,
    /// A Cortex-M4F.
    M4f,
    /// A Cortex-M7.
    M7,
}

impl Target {
    /// The board, unless it is this machine.
    pub fn board(self) -> Option<Board> {
        match self {
            Self::Host => None,
            Self::M4f => Some(M4F),
            Self::M7 => Some(M7),
        }
    }

    /// The unit of a tick's cost.
    pub fn cost_unit(self) -> &'static str {
        if self == Self::Host { "cycles" } else { "instructions" }
    }

    /// How people name it.
    pub fn title(self) -> &'static str {
        match self {
            Self::Host => "host",
            Self::M4f => "Cortex-M4F",
            Self::M7 => "Cortex-M7",
        }
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&word(self))
    }
}
