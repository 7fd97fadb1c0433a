//! What the desk says of the inputs: their values at the tick that took most instructions, and which have no range.

use serde::Serialize;

use crate::ticks::{Ticks, text};
use crate::values::Values;

/// A tick and what it was given.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WorstTick {
    /// Its number, from 1.
    pub tick: usize,
    /// What it took on the board.
    pub instructions: u64,
    /// The value of every input.
    pub inputs: Values,
}

impl WorstTick {
    /// The first of those that took most, by the counts of the board and the inputs of the desk.
    pub fn new(counts: &[u64], desk: &Ticks) -> Option<Self> {
        let instructions = *counts.iter().max()?;
        let at = counts.iter().position(|&count| count == instructions)?;
        let words = desk.notes("inputs").nth(at)?;
        let values = words.iter().map(|word| word.parse().ok().filter(|x: &f64| x.is_finite()));
        let inputs = Values::new(&names(desk), values);
        Some(Self { tick: at + 1, instructions, inputs })
    }
}

fn names(desk: &Ticks) -> Vec<String> {
    desk.notes("input").filter_map(|words| words.first()).map(|digits| text(digits)).collect()
}

/// The inputs that have no range.
pub fn without_range(desk: &Ticks) -> Vec<String> {
    let free = desk.notes("input").filter(|words| words.get(1).is_some_and(|word| word == "free"));
    free.filter_map(|words| words.first()).map(|digits| text(digits)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const DESK: &str = "@ input 7261696e ranged\n@ input 61 free\n@ inputs 0.5 -1.0\ntick 1\n\
                        @ inputs 0.25 NaN\ntick 2\n@ inputs 5.0 2.0\ntick 3\n";

    #[test]
    fn the_worst_tick_has_its_inputs() {
        let desk = Ticks::parse(DESK);
        let value = |name: &str, value| (name.to_owned(), value);
        let worst = WorstTick::new(&[7, 9, 9], &desk).expect("counts");
        assert_eq!((worst.tick, worst.instructions), (2, 9));
        assert_eq!(worst.inputs, Values(vec![value("rain", Some(0.25)), value("a", None)]));
        let json = serde_json::to_string(&WorstTick::new(&[7, 8, 9], &desk)).expect("numbers");
        assert_eq!(json, "{\"tick\":3,\"instructions\":9,\"inputs\":{\"rain\":5.0,\"a\":2.0}}");
        assert_eq!(WorstTick::new(&[], &desk), None);
        assert_eq!(without_range(&desk), ["a"]);
    }
}
