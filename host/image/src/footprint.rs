//! What an image of a baked scene takes of a device.

use std::path::Path;

use crate::sections::section;
use crate::ticks::Ticks;

/// Bytes that stand in an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Statics {
    /// Instructions, and the constants between them.
    pub code: u64,
    /// The rest of flash: statics that never change, first values of those that do.
    pub data: u64,
    /// Statics in RAM.
    pub ram: u64,
}

impl Statics {
    /// Of an image.
    ///
    /// # Errors
    /// A section that it lacks.
    pub fn of(image: &Path) -> Result<Self, String> {
        let sum = |names: &[&str]| names.iter().map(|name| section(image, name)).sum();
        let ram: Result<u64, String> = sum(&[".data", ".bss", ".uninit"]);
        let data: Result<u64, String> = sum(&[".vector_table", ".rodata", ".data"]);
        Ok(Self { code: section(image, ".text")?, data: data?, ram: ram? })
    }

    /// Bytes of flash.
    pub fn flash(&self) -> u64 {
        self.code + self.data
    }
}

/// Bytes of an image that runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Footprint {
    /// Its contents.
    pub statics: Statics,
    /// The stack of the deepest of all ticks.
    pub stack: u64,
}

impl Footprint {
    /// Of an image that has played these ticks.
    ///
    /// # Errors
    /// A section that it lacks, a stack that may have gone deeper than the board could see.
    pub fn new(image: &Path, played: &Ticks) -> Result<Self, String> {
        Ok(Self { statics: Statics::of(image)?, stack: stack(played)? })
    }
}

fn stack(board: &Ticks) -> Result<u64, String> {
    match board.numbers("stack")?[..] {
        [depth, watched] if depth < watched => Ok(depth),
        [depth, watched] => Err(format!("{depth} bytes of stack, {watched} were watched")),
        _ => Err("the board does not tell its stack".to_owned()),
    }
}
