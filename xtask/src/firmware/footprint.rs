//! What an image of a baked scene takes of a device.

use std::path::Path;

use super::ticks::Ticks;
use crate::baked::Recipe;
use crate::board::Board;
use crate::symbols::section;

/// Bytes.
#[derive(Debug, Clone, Copy)]
pub struct Footprint {
    /// Instructions, and the constants between them.
    pub code: u64,
    /// The rest of flash: statics that never change, first values of those that do.
    pub data: u64,
    /// Statics in RAM.
    pub ram: u64,
    /// The deepest of all ticks.
    pub stack: u64,
}

impl Footprint {
    /// Bakes a scene, and builds and plays its image.
    pub fn of(recipe: &Recipe, board: &Board) -> Result<Self, String> {
        let baked = recipe.bake().map_err(|failure| failure.why)?;
        let image = baked.image(board, &[])?;
        Self::new(&image, &Ticks::parse(&board.run(&image, false)?))
    }

    /// Of an image that has played these ticks.
    pub fn new(image: &Path, played: &Ticks) -> Result<Self, String> {
        let sum = |names: &[&str]| names.iter().map(|name| section(image, name)).sum();
        let ram: Result<u64, String> = sum(&[".data", ".bss", ".uninit"]);
        let data: Result<u64, String> = sum(&[".vector_table", ".rodata", ".data"]);
        Ok(Self { code: section(image, ".text")?, data: data?, ram: ram?, stack: stack(played)? })
    }
}

/// Bytes of stack; an error where it may have gone deeper than the board could see.
fn stack(board: &Ticks) -> Result<u64, String> {
    match board.numbers("stack")?[..] {
        [depth, watched] if depth < watched => Ok(depth),
        [depth, watched] => Err(format!("{depth} bytes of stack, {watched} were watched")),
        _ => Err("the board does not tell its stack".to_owned()),
    }
}
