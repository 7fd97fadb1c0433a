//! The output of the two programs: lines that must be equal, and notes (`@ …`) that are each machine's own.

use serde::ser::SerializeMap as _;
use serde::{Serialize, Serializer};

/// The ticks of one machine.
#[derive(Debug, Clone, PartialEq)]
pub struct Ticks {
    lines: Vec<String>,
    notes: Vec<Vec<String>>,
}

impl Ticks {
    /// Reads what a program printed.
    pub fn parse(text: &str) -> Self {
        let (notes, lines): (Vec<_>, Vec<_>) =
            text.lines().partition(|line| line.starts_with("@ "));
        let words = |note: &&str| note.split(' ').skip(1).map(str::to_owned).collect();
        Self {
            lines: lines.into_iter().map(str::to_owned).collect(),
            notes: notes.iter().map(words).collect(),
        }
    }

    /// The first word of each note of this name.
    pub fn notes<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a [String]> {
        self.notes
            .iter()
            .filter(move |note| note.first().is_some_and(|of| of == name))
            .map(|note| &note[1..])
    }

    /// The numbers of all notes of this name.
    ///
    /// # Errors
    /// A word that is no number.
    pub fn numbers(&self, name: &str) -> Result<Vec<u64>, String> {
        let number = |word: &String| word.parse().map_err(|_| format!("a tick's {name}: `{word}`"));
        self.notes(name).flatten().filter(|word| !word.is_empty()).map(number).collect()
    }

    /// How many ticks there are.
    pub fn count(&self) -> usize {
        self.lines.iter().filter(|line| line.starts_with("tick ")).count()
    }

    /// The outputs of the first tick, none where they are no numbers; no output where it was refused.
    pub fn outputs(&self) -> Vec<Option<f64>> {
        self.first("output ")
    }

    /// Where the exact value of each of them lies; none where nothing is guaranteed.
    pub fn between(&self) -> Vec<Option<[f64; 2]>> {
        let ends = self.first("least ").into_iter().zip(self.first("most "));
        ends.map(|(least, most)| Some([least?, most?])).collect()
    }

    /// The numbers of the first tick in lines that begin so.
    fn first(&self, name: &str) -> Vec<Option<f64>> {
        let first = self.lines.iter().skip(1).take_while(|line| !line.starts_with("tick "));
        first.filter_map(|line| line.strip_prefix(name)).map(decimal).collect()
    }

    /// Where the ticks of two machines part, if they do.
    pub fn difference(&self, other: &Self) -> Option<String> {
        let ends = |ticks: &Self| ticks.lines.clone().into_iter().chain(["the end".to_owned()]);
        let mut tick = String::new();
        ends(self).zip(ends(other)).find_map(|(line, other)| {
            if line.starts_with("tick ") {
                tick.clone_from(&line);
            }
            (line != other).then(|| format!("{tick}: `{line}` on the board, `{other}` on the desk"))
        })
    }

    /// The first tick without an answer, if there is one.
    pub fn refused(&self) -> Option<&str> {
        let answers = self.lines.windows(2).find(|pair| pair[1] == "refused");
        answers.map(|pair| pair[0].as_str())
    }
}

/// The number that has the shortest decimal digits for these bits; none for what is no number.
fn decimal(bits: &str) -> Option<f64> {
    let shortest = match bits.split_once(' ')? {
        ("f32", digits) => format!("{:?}", f32::from_bits(u32::from_str_radix(digits, 16).ok()?)),
        ("f64", digits) => format!("{:?}", f64::from_bits(u64::from_str_radix(digits, 16).ok()?)),
        _ => return None,
    };
    shortest.parse().ok().filter(|value: &f64| value.is_finite())
}

/// The text whose bytes these digits are.
pub fn text(digits: &str) -> String {
    let byte = |at| digits.get(at..at + 2).and_then(|byte| u8::from_str_radix(byte, 16).ok());
    let bytes: Vec<u8> = (0..digits.len()).step_by(2).filter_map(byte).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Values by name, in their order, as `firmware.json` has them; null where one is no number.
#[derive(Debug, Clone, PartialEq)]
pub struct Values(pub Vec<(String, Option<f64>)>);

impl Values {
    /// Each name with its value; null where there is none.
    pub fn new(names: &[String], values: impl IntoIterator<Item = Option<f64>>) -> Self {
        let mut values = values.into_iter();
        Self(names.iter().map(|name| (name.clone(), values.next().flatten())).collect())
    }
}

impl Serialize for Values {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        self.0.iter().try_for_each(|(name, value)| map.serialize_entry(name, value))?;
        map.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOARD: &str = "tick 1\n@ instructions 512\noutput f32 3dcccccd\noutput f32 7f800000\n\
                         least f32 3dcccccd\nmost f32 3f000000\nsweeps 3\ntick 2\n@ instructions 480\noutput f32 3f800000\n";

    #[test]
    fn a_tick_is_read() {
        let ticks = Ticks::parse(BOARD);
        assert_eq!(ticks.count(), 2);
        assert_eq!(ticks.outputs(), [Some(0.1), None]);
        assert_eq!(ticks.between(), [Some([0.1, 0.5])]);
        assert_eq!(ticks.numbers("instructions"), Ok(vec![512, 480]));
        let beyond = Ticks::parse("@ instructions beyond").numbers("instructions");
        assert_eq!(beyond, Err("a tick's instructions: `beyond`".to_owned()));
    }

    #[test]
    fn every_bit_counts_and_no_note_does() {
        let board = Ticks::parse(BOARD);
        let desk = |text: &str| Ticks::parse(text);
        assert_eq!(board.difference(&desk(&BOARD.replace("@ instructions 512\n", ""))), None);
        let bit = board.difference(&desk(&BOARD.replace("3f800000", "3f800001"))).unwrap();
        assert!(bit.contains("tick 2") && bit.contains("3f800001"), "{bit}");
        let cut = board.difference(&desk("tick 1\n")).unwrap();
        assert!(cut.contains("the end"), "{cut}");
    }

    #[test]
    fn bits_become_the_numbers_of_the_shortest_decimals() {
        assert_eq!(decimal("f64 3fb999999999999a"), Some(0.1));
        assert_eq!(decimal("f32 380725a1"), Some(3.2221553e-5));
        assert_eq!(decimal("f32 7fc00000"), None);
        assert_eq!(decimal("f32"), None);
    }

    #[test]
    fn names_are_bytes() {
        assert_eq!(text("7269622022c2b022"), "rib \"°\"");
    }

    #[test]
    fn a_refused_tick_is_found() {
        assert_eq!(
            Ticks::parse("tick 1\noutput f32 0\ntick 2\nrefused\n").refused(),
            Some("tick 2")
        );
    }
}
