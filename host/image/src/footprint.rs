//! The flash, RAM and stack that an image of a baked scene takes of a device.

use std::path::Path;

use crate::objects::sections;
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
        let found = sections(image)?;
        let of = |name: &str| {
            let section = found.iter().find(|(section, _)| section == name).map(|(_, size)| *size);
            section.ok_or_else(|| format!("{} has no section {name}", image.display()))
        };
        let data = of(".data")?;
        Ok(Self {
            code: of(".text")?,
            data: of(".vector_table")? + of(".rodata")? + data,
            ram: data + of(".bss")? + of(".uninit")?,
        })
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
