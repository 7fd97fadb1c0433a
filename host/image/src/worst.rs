//! The worst ticks: the one that was played, by the inputs that the desk tells, and what was found from starts of every kind.

use serde::Serialize;

use crate::chosen::WorstCase;
use crate::ticks::{Ticks, Values, text};

/// A tick and what it was given.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WorstTick {
    /// Its number, from 1.
    pub tick: usize,
    /// Its cost on the board.
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

/// The most that was found on a board from edges of every kind that were open, and inputs of every kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct WorstStart {
    /// Ticks that were tried.
    pub starts: u64,
    /// The most exchanges.
    pub exchanges: u64,
    /// The most instructions.
    pub instructions: u64,
    /// Ticks that did not end with the solution.
    pub unfinished: u64,
}

impl WorstStart {
    /// The text of an image that looked for it.
    ///
    /// # Errors
    /// A line that is missing.
    pub fn parse(said: &str) -> Result<Self, String> {
        let number = |name: &str| {
            let line = said.lines().find_map(|line| line.strip_prefix(name)?.trim().parse().ok());
            line.ok_or_else(|| format!("the board tells no {name}: `{}`", said.trim()))
        };
        Ok(Self {
            starts: number("starts")?,
            exchanges: number("exchanges")?,
            instructions: number("instructions")?,
            unfinished: number("unfinished")?,
        })
    }

    /// `Ok` where every tick ended with the solution within what is proved.
    ///
    /// # Errors
    /// What is exceeded.
    pub fn verdict(&self, proved: &WorstCase) -> Result<(), String> {
        let Self { starts, exchanges, instructions, unfinished } = *self;
        let mut wrong = Vec::new();
        if unfinished > 0 {
            wrong.push(format!("{unfinished} of {starts} ticks have no solution"));
        }
        if proved.exchanges.is_none_or(|most| exchanges > u64::from(most)) {
            wrong.push(format!("{exchanges} exchanges, proved: {:?}", proved.exchanges));
        }
        if let Some(most) = proved.instructions.filter(|&most| instructions > most) {
            wrong.push(format!("{instructions} instructions, proved: {most}"));
        }
        if wrong.is_empty() { Ok(()) } else { Err(wrong.join("; ")) }
    }

    /// `Ok` where what is proved is at most so many times what was found.
    ///
    /// # Errors
    /// Both numbers.
    pub fn is_near(&self, proved: &WorstCase, times: f64) -> Result<(), String> {
        let found = self.instructions;
        match proved.instructions {
            Some(most) if most as f64 > times * found as f64 => Err(format!(
                "{most} instructions are proved, {found} were found: {times} times is allowed"
            )),
            _ => Ok(()),
        }
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

    #[test]
    fn what_was_found_is_held_against_what_is_proved() {
        let said = "starts 10112\nexchanges 9\ninstructions 8600\nunfinished 0\n";
        let found = WorstStart::parse(said).expect("four lines");
        assert_eq!((found.starts, found.exchanges, found.instructions), (10112, 9, 8600));
        let proved = |exchanges, instructions| WorstCase { exchanges, instructions, proven: true };
        assert_eq!(found.verdict(&proved(Some(9), Some(8600))), Ok(()));
        assert_eq!(found.verdict(&proved(Some(10), None)), Ok(()));
        for (exchanges, instructions, part) in [
            (Some(8), Some(9000), "9 exchanges"),
            (None, None, "9 exchanges"),
            (Some(9), Some(8599), "8600 instructions"),
        ] {
            let why = found.verdict(&proved(exchanges, instructions)).expect_err("beyond");
            assert!(why.contains(part), "{why}");
        }
        assert_eq!(found.is_near(&proved(Some(9), Some(17_200)), 2.0), Ok(()));
        let far = found.is_near(&proved(Some(9), Some(17_201)), 2.0);
        assert!(far.is_err_and(|why| why.contains("17201")));
        let unfinished = WorstStart { unfinished: 1, ..found };
        assert!(
            unfinished.verdict(&proved(Some(9), None)).is_err_and(|why| why.contains("1 of 10112"))
        );
        assert!(WorstStart::parse("a tick fails\n").is_err_and(|why| why.contains("a tick fails")));
    }
}
