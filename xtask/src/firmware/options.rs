//! The command line of `cargo xtask firmware`.

use std::path::{Path, PathBuf};

use crate::baked::Recipe;
use signorini_image::board::{Board, M4F, M4F_192K, M7, M33};

/// What to put on which board.
#[derive(Debug, Clone)]
pub struct Options {
    /// The scene, and how it is baked.
    pub recipe: Recipe,
    /// The board.
    pub board: Board,
    /// The folder of the result.
    pub out: PathBuf,
    /// Whether the worst start is looked for.
    pub worst: bool,
    /// Whether ticks say where outputs lie.
    pub locates: bool,
}

const BOARDS: [Board; 4] = [M4F, M4F_192K, M7, M33];

pub const HELP: &str = "\
Usage: cargo xtask firmware SCENE.toml [OPTIONS]

Bakes a scene, puts it on an emulated board, plays 101 ticks there and on this machine, and compares them bit
for bit. Tick 1 has all inputs at their defaults, from a cold start or, of a scene in time, from its start; in each of the others every input is drawn
from its range, two of four ticks at a corner of all ranges; without a range from within a tenth of its default
(±0.1 where that is 0). They are the same on both.

Options:
  --board m4|m4-192k|m7|m33
                           mps2-an386, netduinoplus2 (an STM32F405), mps2-an500, mps2-an505 [m4]
  --scalar f32|f64         [the scene's setting.scalar, else f32]
  --full, --condensed      forces a model, whatever the scene's setting says
  --full-edges             keeps contact edges that never change sides
  --input NAME=VALUE       the default of an input; repeatable
  --step DT                another length of a step in time than the scene's
  --worst                  looks for the worst tick of a condensed model whose worst case is proved: from every set
                           of open edges where there are 12 or fewer, else from 10 000
  --out DIR                where firmware.json goes [out/SCENE]

Examples:
  cargo xtask firmware meshes/scenes/levee.toml
  cargo xtask firmware tests/firmware/scenes/levee-96.toml --board m4-192k --input rain=2
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

The exit status is 0 where all bits are equal and nothing found exceeds what is proved, 2 where the command line or the scene is wrong.
";

impl Options {
    /// Reads the words after the verb.
    pub fn parse(words: &[&str]) -> Result<Self, String> {
        let (mut scene, mut scalar, mut model) = (None, None, None);
        let (mut inputs, mut board, mut out) = (Vec::new(), BOARDS[0], None);
        let (mut full_edges, mut worst, mut step) = (false, false, None);
        let mut words = words.iter();
        while let Some(&word) = words.next() {
            let mut value = || words.next().copied().ok_or(format!("{word} takes a value"));
            match word {
                "--board" => board = known(value()?)?,
                "--scalar" => match value()? {
                    known @ ("f32" | "f64") => scalar = Some(known.to_owned()),
                    other => return Err(format!("--scalar is f32 or f64, not `{other}`")),
                },
                "--full" | "--condensed" => match model.replace(word.to_owned()) {
                    Some(other) if other != word => return Err(format!("{other} or {word}?")),
                    _ => {}
                },
                "--full-edges" => full_edges = true,
                "--worst" => worst = true,
                "--step" => step = Some(value()?.to_owned()),
                "--input" => inputs.push(value()?.to_owned()),
                "--out" => out = Some(PathBuf::from(value()?)),
                option if option.starts_with('-') => return Err(format!("no option `{option}`")),
                file if scene.is_none() => scene = Some(PathBuf::from(file)),
                extra => return Err(format!("one scene at a time, not `{extra}` too")),
            }
        }
        let scene = scene.ok_or("no scene given")?;
        let recipe = Recipe { scene, scalar, model, inputs, step, full_edges };
        let out = out.unwrap_or_else(|| Path::new("out").join(recipe.scene_name()));
        Ok(Self { recipe, board, out, worst, locates: true })
    }
}

fn known(word: &str) -> Result<Board, String> {
    let found = BOARDS.into_iter().find(|board| board.word == word);
    found.ok_or_else(|| format!("--board is m4, m4-192k, m7 or m33, not `{word}`"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_stand_in_any_order() {
        let words = ["--board", "m7", "a/b.toml", "--full", "--input", "x=1", "--input", "y=2"];
        let options = Options::parse(&words).unwrap();
        assert_eq!((options.board.word, options.recipe.scalar), ("m7", None));
        assert_eq!(
            (options.recipe.scene.to_str(), options.out.to_str()),
            (Some("a/b.toml"), Some("out/b"))
        );
        assert_eq!(
            (options.recipe.model.as_deref(), options.recipe.inputs.len()),
            (Some("--full"), 2)
        );
    }

    #[test]
    fn wrong_words_are_named() {
        let why = |words: &[&str]| Options::parse(words).map(drop).unwrap_err();
        assert!(why(&[]).contains("no scene"));
        assert!(why(&["a.toml", "b.toml"]).contains("`b.toml`"));
        assert!(why(&["a.toml", "--board", "m3"]).contains("m7 or m33, not `m3`"));
        let m33 = Options::parse(&["a.toml", "--board", "m33"]).unwrap().board;
        assert_eq!((m33.machine, m33.cpu), ("mps2-an505", "cortex-m33"));
        assert!(why(&["a.toml", "--scalar"]).contains("--scalar"));
        assert!(why(&["a.toml", "--full", "--condensed"]).contains("--full"));
        assert!(why(&["a.toml", "--fast"]).contains("`--fast`"));
    }
}
