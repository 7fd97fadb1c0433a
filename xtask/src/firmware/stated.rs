//! What `signorini bake --explain` states of a scene, against what its image takes.

use crate::baked::Recipe;

/// What the figures may be off by, as a part of what the image takes. RAM is known but for the stack, flash but for the code of this very
/// scene; instructions are counted stages times the work of the same ticks on this machine.
const TOLERANCES: [(&str, f64); 3] = [("RAM", 0.01), ("flash", 0.03), ("instructions", 0.10)];

/// RAM and flash in bytes, instructions of the median tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stated(pub [u64; 3]);

impl Stated {
    /// Of the model that the recipe leads to.
    pub fn of(recipe: &Recipe) -> Result<Self, String> {
        let said = recipe.explained()?;
        Self::parse(&said).ok_or_else(|| format!("--explain states no model:\n{said}"))
    }

    /// From the row of the model that is chosen.
    fn parse(said: &str) -> Option<Self> {
        let row = said.lines().find(|line| line.ends_with(" chosen"))?;
        let mut numbers = row.split_whitespace().filter_map(|word| word.parse().ok());
        Some(Self([numbers.next()?, numbers.next()?, numbers.next()?]))
    }

    /// `Ok` where the image `takes` that, within the tolerances.
    pub fn compare(&self, takes: [u64; 3]) -> Result<(), String> {
        let mut wrong = Vec::new();
        for ((&(what, most), stated), takes) in TOLERANCES.iter().zip(self.0).zip(takes) {
            let off = stated as f64 / takes as f64 - 1.0;
            println!("  {what}: {stated} stated, {takes} taken, {:+.1} %", 100.0 * off);
            let is_met = off.abs() <= most;
            if !is_met {
                wrong.push(format!(
                    "{what}: {stated} stated, {takes} taken, {:.0} % allowed",
                    100.0 * most
                ));
            }
        }
        if wrong.is_empty() { Ok(()) } else { Err(wrong.join("; ")) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAID: &str = "\
model                       RAM   flash  instructions  exchanges\n\
condensed, exact method    1104   49720         14238          0  chosen\n\
condensed, sweeps alone     900   44000         50000          0  would fit\n";

    #[test]
    fn the_chosen_row_is_compared_within_the_tolerances() {
        let stated = Stated::parse(SAID).unwrap();
        assert_eq!(stated, Stated([1104, 49720, 14238]));
        assert_eq!(stated.compare([1108, 49000, 13500]), Ok(()));
        let why = stated.compare([1108, 52484, 9880]).unwrap_err();
        assert!(
            why.contains("flash: 49720") && why.contains("instructions") && !why.contains("RAM")
        );
        assert_eq!(Stated::parse("error: no model"), None);
    }
}
