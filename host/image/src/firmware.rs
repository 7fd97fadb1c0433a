//! The cost of a scene on a board, and whether it is right there: `firmware.json`.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::thread;

use serde::Serialize;

use crate::board::Board;
use crate::chosen::{Ranges, WorstCase};
use crate::footprint::Footprint;
use crate::module::Module;
use crate::room::NoResult;
use crate::ticks::{Ticks, Values, text};
use crate::worst::{WorstStart, WorstTick, without_range};

/// The word that an image prints in place of a count that its counter could not hold.
const BEYOND: &str = "beyond-the-counter";

/// Instructions of a tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Instructions {
    /// From a cold start.
    pub first: u64,
    /// Of all ticks.
    pub median: u64,
    /// Of all ticks.
    pub max: u64,
}

/// The interval of an output.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OutputBound {
    /// Its middle.
    pub center: f64,
    /// How far the exact value is from it at most.
    pub plus_minus: f64,
    /// Its meaning.
    pub of: String,
    /// A controller has no second mesh.
    pub estimate: Option<f64>,
}

/// The result.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Firmware {
    /// The board, as the command line calls it.
    pub board: &'static str,
    /// `f32` or `f64`.
    pub scalar: String,
    /// `full` or `condensed`.
    pub model: String,
    /// Outputs of the first tick on the board.
    pub outputs: Values,
    /// Outputs of the first tick on this machine.
    pub host_outputs: Values,
    /// Where each output of the first tick lies for the exact solution, as the board says it; null where nothing is guaranteed.
    pub output_bounds: BTreeMap<String, Option<OutputBound>>,
    /// Whether every tick has the same bits on both.
    pub bit_identical: bool,
    /// Of one call of `Controller::tick`.
    pub instructions_per_tick: Instructions,
    /// Bytes of RAM, the stack included.
    pub ram_bytes: u64,
    /// Bytes of flash.
    pub flash_bytes: u64,
    /// Bytes of the deepest stack.
    pub stack_bytes: u64,
    /// How many ticks there were.
    pub ticks: usize,
    /// The length of a step, of a model that steps in time.
    pub step: Option<f64>,
    /// States of a condensed model in time; 0 of others.
    pub memory: u32,
    /// Features that the kernel was built with.
    pub kernel_features: Vec<String>,
    /// The sides of the contact edges, as the bake says.
    pub ranges: Option<Ranges>,
    /// The worst case as the bake says, which no tick exceeds.
    pub worst_case: WorstCase,
    /// The tick that took most instructions.
    pub worst_tick: Option<WorstTick>,
    /// The worst tick found from starts of every kind, where it was looked for.
    pub worst_start: Option<WorstStart>,
    /// Inputs without a range: they stay within a tenth of their defaults (±0.1 where that is 0).
    pub inputs_without_range: Vec<String>,
    /// Where the bits differ.
    #[serde(skip)]
    difference: Option<String>,
    /// A tick without an answer.
    #[serde(skip)]
    refused: Option<String>,
}

impl Firmware {
    /// Builds both programs of `module`, runs them, and measures the image.
    ///
    /// # Errors
    /// No image; a program that fails.
    pub fn measure(module: &Module, board: &Board) -> Result<Self, NoResult> {
        // Two builds in two folders: neither waits for the other.
        let (said, desk) = thread::scope(|scope| {
            let desk = scope.spawn(|| module.on_desk());
            let said = module.on_board(board);
            (said, desk.join().unwrap_or_else(|_| Err("the desk's build panicked".to_owned())))
        });
        let (said, desk) = (said?, desk?);
        let ticks = module.played()?;
        if said.count() != ticks {
            return Err(format!("the board has played {} of {ticks} ticks", said.count()).into());
        }
        let Footprint { statics, stack } = Footprint::new(&module.image(board)?, &said)?;
        let word = |name| desk.notes(name).filter_map(|words| words.first()).cloned();
        let names: Vec<String> = word("output").map(|digits| text(&digits)).collect();
        let difference = said.difference(&desk);
        let instructions_per_tick = instructions(&said)?;
        Ok(Self {
            board: board.word,
            scalar: word("scalar").next().unwrap_or_default(),
            model: word("model").next().unwrap_or_default(),
            outputs: Values::new(&names, said.outputs()),
            host_outputs: Values::new(&names, desk.outputs()),
            output_bounds: bounds(&names, &said, &module.chosen.outputs),
            bit_identical: difference.is_none(),
            instructions_per_tick,
            ram_bytes: statics.ram + stack,
            flash_bytes: statics.flash(),
            stack_bytes: stack,
            ticks,
            step: module.chosen.step,
            memory: module.chosen.memory,
            kernel_features: module.chosen.kernel_features.clone(),
            ranges: module.chosen.ranges,
            worst_case: module.chosen.worst_case,
            worst_tick: WorstTick::new(&said.numbers("instructions")?, &desk),
            worst_start: None,
            inputs_without_range: without_range(&desk),
            difference,
            refused: desk.refused().map(str::to_owned),
        })
    }

    /// `firmware.json`.
    pub fn json(&self) -> String {
        // Every number is finite: nothing here can fail.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    /// The figures of `scene` for a person.
    pub fn table(&self, scene: &str) -> String {
        let Self { board, scalar, model, ram_bytes, flash_bytes, stack_bytes, ticks, .. } = self;
        let Instructions { median, max, .. } = self.instructions_per_tick;
        let mut table = format!("\n{scene} on {board}, {scalar}, {model}\n");
        let names = self.outputs.0.iter().map(|(name, _)| name.chars().count());
        let width = names.max().unwrap_or(0).max(12);
        let head = ["first tick", "board", "desk", "   the exact value, guaranteed"];
        let _ = writeln!(table, "  {:<width$}  {:>24}{:>24}{}", head[0], head[1], head[2], head[3]);
        for ((name, board), (_, desk)) in self.outputs.0.iter().zip(&self.host_outputs.0) {
            let (board, desk) = (digits(*board), digits(*desk));
            let off = self.output_bounds.get(name).and_then(Option::as_ref);
            let off = off.map_or_else(String::new, OutputBound::words);
            let name = name.escape_debug();
            let _ = writeln!(table, "  {name:<width$}  {board:>24}{desk:>24}{off}");
        }
        let equal = self.difference.as_deref().unwrap_or("the same bits on both");
        let _ = writeln!(table, "  {ticks} ticks: {equal}");
        let _ = writeln!(table, "  instructions per tick: {median} in the median, {max} at most");
        table += &self.worst();
        let _ = writeln!(
            table,
            "  RAM: {ram_bytes} bytes, {stack_bytes} of them stack; flash: {flash_bytes} bytes"
        );
        table
    }

    /// The inputs of the worst tick, the contact edges, and which inputs were not drawn from a range.
    fn worst(&self) -> String {
        let mut text = String::new();
        if let Some(WorstTick { tick, inputs, .. }) = &self.worst_tick {
            let inputs = inputs.0.iter().map(|(name, x)| format!("{name} = {}", digits(*x)));
            let at = match inputs.collect::<Vec<_>>().join(", ") {
                none if none.is_empty() => none,
                inputs => format!(", at {inputs}"),
            };
            let _ = writeln!(text, "  the most at tick {tick}{at}");
        }
        text += &self.proved();
        if let Some(WorstStart { starts, exchanges, instructions, .. }) = self.worst_start {
            let _ = writeln!(
                text,
                "  found from {starts} starts: {instructions} instructions, {exchanges} exchanges at most"
            );
        }
        if let Some(Ranges {
            contact,
            always_open,
            always_touching,
            always_saturated,
            may_change,
            ..
        }) = self.ranges
        {
            // Scenes without limits say nothing of them.
            let at_limit = match always_saturated {
                0 => String::new(),
                count => format!("{count} always at their limit, "),
            };
            let _ = writeln!(
                text,
                "  contact edges: {contact}; {always_open} always open, {always_touching} always touching, \
                 {at_limit}{may_change} may change"
            );
        }
        for name in &self.inputs_without_range {
            let _ = writeln!(
                text,
                "  {name:?} has no range: it stays within ±10 % of its default (±0.1 of 0)"
            );
        }
        text
    }

    /// The worst case in a line.
    fn proved(&self) -> String {
        let WorstCase { exchanges, instructions, proven } = self.worst_case;
        let instructions = instructions.map(|count| format!("{count} instructions"));
        let exchanges = exchanges.map(|count| format!("{count} exchanges"));
        let limits = instructions.iter().chain(&exchanges).cloned().collect::<Vec<_>>().join(", ");
        match (proven, instructions, exchanges) {
            (true, ..) => format!("  no tick exceeds, proved: {limits}\n"),
            (false, Some(_), _) => {
                format!("  worst case: {limits}; not proved, since an input has no range\n")
            }
            (false, None, Some(_)) => format!("  no worst case is proved; cut off at {limits}\n"),
            (false, None, None) => "  no worst case is proved\n".to_owned(),
        }
    }

    /// `Ok` where every tick has an answer, with the same bits on both machines.
    ///
    /// # Errors
    /// The first tick that has not.
    pub fn verdict(&self) -> Result<(), String> {
        match (&self.difference, &self.refused) {
            (Some(difference), _) => Err(format!("not bit identical, {difference}")),
            (None, Some(tick)) => Err(format!("{tick} has no answer")),
            (None, None) => Ok(()),
        }
    }
}

fn digits(value: Option<f64>) -> String {
    value.map_or("null".to_owned(), |x| format!("{x:?}"))
}

impl OutputBound {
    /// The least interval around a middle that has both ends, whatever that rounds.
    fn of_ends([least, most]: [f64; 2], of: String) -> Self {
        let center = 0.5 * (least + most);
        let rounding = 4.0 * f64::EPSILON * (least.abs() + most.abs());
        let plus_minus = 0.5 * (most - least) + rounding;
        Self { center, plus_minus, of, estimate: None }
    }

    fn words(&self) -> String {
        let Self { center, plus_minus, .. } = self;
        format!("   {center:.6e} ± {plus_minus:.2e}")
    }
}

/// The intervals of the first tick; `of` says of each output what it is the value of.
fn bounds(names: &[String], said: &Ticks, of: &[String]) -> BTreeMap<String, Option<OutputBound>> {
    let of = of.iter().cloned().chain(std::iter::repeat(String::new()));
    let bound = |(ends, of): (Option<[f64; 2]>, String)| Some(OutputBound::of_ends(ends?, of));
    names.iter().cloned().zip(said.between().into_iter().zip(of).map(bound)).collect()
}

fn instructions(board: &Ticks) -> Result<Instructions, NoResult> {
    if board.notes("instructions").flatten().any(|word| word == BEYOND) {
        return Err(NoResult::BeyondCounter);
    }
    let mut counts = board.numbers("instructions")?;
    let first = counts.first().copied();
    counts.sort_unstable();
    let (median, max) = (counts.get(counts.len() / 2).copied(), counts.last().copied());
    let all = first.zip(median).zip(max);
    let ((first, median), max) = all.ok_or_else(|| "a tick was not counted".to_owned())?;
    Ok(Instructions { first, median, max })
}
