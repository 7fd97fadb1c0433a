//! The command line of `cargo xtask firmware`.

use std::path::PathBuf;

use clap::Args;

use crate::baked::Recipe;
use signorini_image::board::{Board, M4F, M4F_192K, M7, M33};

/// The scene and the board, and where to write what is found.
#[derive(Debug, Clone, Args)]
#[command(after_help = MORE)]
pub struct Options {
    #[command(flatten)]
    pub recipe: Recipe,
    /// m4, m4-192k, m7 or m33: mps2-an386, netduinoplus2 (an STM32F405), mps2-an500, mps2-an505
    #[arg(long, default_value = M4F.word, value_parser = known)]
    pub board: Board,
    /// The folder of firmware.json [out/SCENE]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Looks for the worst tick of a condensed model whose worst case is proved: from every set of open edges where there are
    /// 12 or fewer, else from 10 000
    #[arg(long)]
    pub worst: bool,
    /// Plays the inputs of a log, as `signorini tick --log` reads it: a tick per line
    #[arg(long, value_name = "FILE")]
    pub log: Option<PathBuf>,
    /// Whether ticks say where outputs lie.
    #[arg(skip = true)]
    pub locates: bool,
}

const BOARDS: [Board; 4] = [M4F, M4F_192K, M7, M33];

const MORE: &str = "\
Examples:
  cargo xtask firmware meshes/scenes/levee.toml
  cargo xtask firmware tests/firmware/scenes/levee-96.toml --board m4-192k --input rain=2
  cargo xtask firmware meshes/scenes/levee-warm.toml --board m4-192k --log tests/firmware/logs/levee-60s.csv
  cargo xtask firmware meshes/scenes/slab.toml --board m7 --scalar f64 --condensed --out out/slab-m7

firmware.json also has the inputs of the tick that took most instructions (worst_tick), the contact edges that
ranges leave open, touching or free to change (ranges), what no tick exceeds, and whether that is proved
(worst_case), and the inputs that have no range.

Instructions are those of one call of Controller::tick over all ticks: to the instruction on m4-192k, to 40
or 50 either way on the others, whose timer counts no finer. RAM is all statics (.data, .bss, .uninit) and the
stack; stack is the deepest of all ticks, and part of RAM; flash is .vector_table, .text, .rodata and .data.
All are of the whole image, with its start-up, its console and the numbers that intervals of outputs take.

The scene is baked by `signorini bake` of this checkout, or by the program that SIGNORINI names in the
environment.

The exit status is 0 where all bits are equal and nothing found exceeds what is proved, 2 where the command line or the scene is wrong.";

fn known(word: &str) -> Result<Board, String> {
    let found = BOARDS.into_iter().find(|board| board.word == word);
    found.ok_or_else(|| "expected m4, m4-192k, m7 or m33".to_owned())
}
