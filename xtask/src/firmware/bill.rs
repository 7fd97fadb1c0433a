//! What a scene costs on a board, and whether it is right there.

use std::fmt::Write as _;

use super::ticks::{Ticks, text};
use super::{Footprint, Options, Programs};
use crate::json::{object, record, string};

/// Ticks that both programs play.
const TICKS: usize = 101;

/// The result.
#[derive(Debug)]
pub struct Bill {
    board: &'static str,
    scalar: String,
    scene: String,
    model: String,
    names: Vec<String>,
    /// The first tick's, on the board and on the desk.
    outputs: [Vec<String>; 2],
    /// Where the bits differ.
    difference: Option<String>,
    /// A tick without an answer.
    refused: Option<String>,
    first: u64,
    median: u64,
    max: u64,
    ram: u64,
    flash: u64,
    stack: u64,
    features: Vec<String>,
}

impl Bill {
    /// Runs both programs and measures the image.
    pub fn new(options: &Options, programs: &Programs) -> Result<Self, String> {
        let board = Ticks::parse(&programs.on_board()?);
        let desk = Ticks::parse(&programs.on_desk()?);
        if board.count() != TICKS {
            return Err(format!("the board has played {} of {TICKS} ticks", board.count()));
        }
        let mut instructions = board.numbers("instructions")?;
        let first = instructions.first().copied().ok_or("the first tick was not counted")?;
        instructions.sort_unstable();
        let at = |at: usize| instructions.get(at).copied().ok_or("a tick was not counted");
        let (median, max) = (at(TICKS / 2)?, at(TICKS - 1)?);
        let Footprint { code, data, ram, stack } = Footprint::new(programs.image(), &board)?;
        let word = |name| desk.notes(name).filter_map(|words| words.first()).cloned();
        Ok(Self {
            board: options.board,
            scalar: word("scalar").next().unwrap_or_default(),
            scene: options.recipe.scene_name(),
            model: word("model").next().unwrap_or_default(),
            names: word("output").map(|digits| text(&digits)).collect(),
            outputs: [board.outputs(), desk.outputs()],
            difference: board.difference(&desk),
            refused: desk.refused().map(str::to_owned),
            first,
            median,
            max,
            ram: ram + stack,
            flash: code + data,
            stack,
            features: programs.features().to_vec(),
        })
    }

    /// `firmware.json`.
    pub fn json(&self) -> String {
        let outputs = |values: &[String]| {
            let value = |at: usize| values.get(at).cloned().unwrap_or_else(|| "null".to_owned());
            record(self.names.iter().enumerate().map(|(at, name)| (name.as_str(), value(at))))
        };
        let [board, desk] = &self.outputs;
        let instructions = [("first", self.first), ("median", self.median), ("max", self.max)];
        let instructions = record(instructions.map(|(name, count)| (name, count.to_string())));
        let features: Vec<String> = self.features.iter().map(|name| string(name)).collect();
        object(&[
            ("board", string(self.board)),
            ("scalar", string(&self.scalar)),
            ("model", string(&self.model)),
            ("outputs", outputs(board)),
            ("host_outputs", outputs(desk)),
            ("bit_identical", self.difference.is_none().to_string()),
            ("instructions_per_tick", instructions),
            ("ram_bytes", self.ram.to_string()),
            ("flash_bytes", self.flash.to_string()),
            ("stack_bytes", self.stack.to_string()),
            ("ticks", TICKS.to_string()),
            ("kernel_features", format!("[{}]", features.join(", "))),
        ])
    }

    /// The same for a person.
    pub fn table(&self) -> String {
        let Self { scene, board, scalar, model, median, max, ram, flash, stack, .. } = self;
        let mut table = format!("\n{scene} on {board}, {scalar}, {model}\n");
        let width = self.names.iter().map(|name| name.chars().count()).max().unwrap_or(0).max(12);
        let [of_board, of_desk] = &self.outputs;
        let _ = writeln!(table, "  {:<width$}  {:>24}{:>24}", "first tick", "board", "desk");
        for ((name, board), desk) in self.names.iter().zip(of_board).zip(of_desk) {
            let _ = writeln!(table, "  {:<width$}  {board:>24}{desk:>24}", name.escape_debug());
        }
        let equal = self.difference.as_deref().unwrap_or("the same bits on both");
        let _ = writeln!(table, "  {TICKS} ticks: {equal}");
        let _ = writeln!(table, "  instructions a tick: {median} in the median, {max} at most");
        let _ = writeln!(table, "  RAM: {ram} bytes, {stack} of them stack; flash: {flash} bytes");
        table
    }

    /// `Ok` where every tick has an answer, with the same bits on both machines.
    pub fn verdict(&self) -> Result<(), String> {
        match (&self.difference, &self.refused) {
            (Some(difference), _) => Err(format!("not bit identical, {difference}")),
            (None, Some(tick)) => Err(format!("{tick} has no answer")),
            (None, None) => Ok(()),
        }
    }

    /// Bytes of RAM and of flash, and instructions of a tick in the median.
    pub fn takes(&self) -> [u64; 3] {
        [self.ram, self.flash, self.median]
    }

    /// `Ok` where a tick takes at most so many instructions in the median. They are counted one by one: the same
    /// every time.
    pub fn within(&self, most: Option<u64>) -> Result<(), String> {
        match most {
            Some(most) if self.median > most => Err(format!(
                "{} instructions a tick in the median, {most} are allowed",
                self.median
            )),
            _ => Ok(()),
        }
    }
}
