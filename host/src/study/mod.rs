//! The main job.

use crate::error::Result;

/// Runs it.
pub fn run() -> Result<u8> {
    Ok(0)
}
