//! The cost of a call from C beside one from Rust, instruction by instruction, and of a library on a device.
//!
//! Both calls are in one image, on the same machine code of the controller, which a compiler may otherwise arrange in other ways
//! and take a thousandth more or less. Three programs play the same ticks on the board that counts to the instruction:
//! ```text
//!   from C          NAME_tick with outputs and report, the intervals of outputs in it
//!   from Rust       Controller::tick, Answer::plus_minus
//!   the tick alone  Controller::tick
//! ```

use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;

use super::package::Package;
use super::program::played;
use crate::modules::{Row, rows};
use crate::record;
use crate::steps::Steps;
use signorini_image::board::M4F_192K;
use signorini_image::files;
use signorini_image::library::Library;
use signorini_image::toolchain::output;

const RECORD: &str = "tests/firmware/c.txt";

/// The columns.
const HEAD: &str = "\
scene           scalar      flash   state  tick alone   from Rust      from C      most    more  +alone
";

/// Instructions that a call from C may take more than one from Rust, in any tick.
const MOST: i64 = 60;

/// Functions that the library has for this count alone.
const RUST: [&str; 2] = ["answered", "ticked"];

/// The programs: how each is told what to count.
const CALLS: [&str; 3] = ["-DCOUNTED=1", "-DCOUNTED=2", "-DCOUNTED=3"];

/// Counts, prints, compares: all rows of the record in a whole run, else the first. All are in f32, which the board's unit is for;
/// what a call takes beside the controller depends on the kind of answer alone, and ticks on a mesh are long.
pub fn run(steps: &mut Steps) {
    let bless = steps.blesses();
    let count = if steps.is_whole() { usize::MAX } else { 1 };
    steps.check("a call from C takes hardly more than one from Rust", || {
        let mut table = HEAD.to_owned();
        let mut wrong = Vec::new();
        let counted = rows(count > 1).filter_map(|row| row.c_counted.map(|ticks| (row, ticks)));
        for (row, ticks) in counted.take(count) {
            let counts = Counts::measure(row, ticks)?;
            let name = row.recipe().scene_name();
            let _ = writeln!(table, "{}", counts.line(&name));
            if counts.more() > MOST {
                wrong.push(format!("{name}: {} instructions more", counts.more()));
            }
        }
        println!("{table}");
        if !wrong.is_empty() {
            return Err(format!("{}; {MOST} are allowed", wrong.join("; ")));
        }
        let versions = record::versions_with_gcc()?;
        match count {
            1 => record::compare_part(RECORD, &versions, &table),
            _ => record::compare(RECORD, &versions, &table, bless),
        }
        .map(drop)
    });
}

/// Counts and bytes of a module.
struct Counts {
    flash: u64,
    state: usize,
    /// Instructions of every tick, by call.
    from_c: Vec<i64>,
    from_rust: Vec<i64>,
    alone: Vec<i64>,
}

impl Counts {
    fn measure(row: &Row, ticks: usize) -> Result<Self, String> {
        let package = row.package("m4")?;
        let module = row.module()?;
        let text = module.text()?;
        let features = &module.chosen.kernel_features;
        let counted = Library::build_with(
            &["counted"],
            &RUST,
            &text,
            features,
            &package.name,
            &package.machine,
        )?;
        let library = package.folder.join("counted.a");
        files::write(&library, &counted.archive)?;
        let [from_c, from_rust, alone] = CALLS.map(|call| counts(&package, &library, call, ticks));
        let flashed = counts(&package, &package.library(), CALLS[0], ticks)?;
        let from_c = from_c?;
        if flashed != from_c {
            return Err(format!("{}: what is counted is not what is shipped", package.name));
        }
        let flash = flash(&package.library())?;
        Ok(Self { flash, state: counted.state, from_c, from_rust: from_rust?, alone: alone? })
    }

    /// The largest difference of a tick from C and from Rust.
    fn more(&self) -> i64 {
        largest(&self.from_c, &self.from_rust)
    }

    fn line(&self, name: &str) -> String {
        let [alone, from_rust, from_c] =
            [&self.alone, &self.from_rust, &self.from_c].map(|counts| median(counts));
        let most = self.from_c.iter().max().copied().unwrap_or(0);
        format!(
            "{:<16}{:<8}{:>9}{:>8}{alone:>12}{from_rust:>12}{from_c:>12}{most:>10}{:>8}{:>8}",
            name,
            "f32",
            self.flash,
            self.state,
            self.more(),
            largest(&self.from_c, &self.alone)
        )
    }
}

fn largest(of: &[i64], than: &[i64]) -> i64 {
    of.iter().zip(than).map(|(of, than)| of - than).max().unwrap_or(i64::MAX)
}

fn median(counts: &[i64]) -> i64 {
    let mut sorted = counts.to_vec();
    sorted.sort_unstable();
    sorted.get(sorted.len() / 2).copied().unwrap_or(0)
}

/// Instructions of each tick.
fn counts(package: &Package, library: &Path, call: &str, ticks: usize) -> Result<Vec<i64>, String> {
    let defines = [call, &format!("-DTICKS={ticks}")];
    let counts = played(package, library, &defines, &M4F_192K)?.numbers("instructions")?;
    match counts.len() == ticks {
        true => Ok(counts.iter().map(|&count| count as i64).collect()),
        false => Err(format!("{} of {ticks} ticks are counted", counts.len())),
    }
}

/// Bytes of the first object, which has all but the tick with a deadline: text, constants, data.
fn flash(library: &Path) -> Result<u64, String> {
    let table = output(Command::new("arm-none-eabi-size").arg(library))?;
    let line = table.lines().nth(1).unwrap_or_default();
    let mut words = line.split_whitespace().map(|word| word.parse::<u64>().ok());
    match (words.next().flatten(), words.next().flatten()) {
        (Some(text), Some(data)) => Ok(text + data),
        _ => Err(format!("`{line}` has no sizes")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_difference_is_that_of_a_tick() {
        assert_eq!(largest(&[100, 250, 90], &[90, 200, 95]), 50);
        assert_eq!(largest(&[90], &[100]), -10);
        assert_eq!(largest(&[], &[]), i64::MAX);
        assert_eq!(median(&[3, 1, 2]), 2);
    }
}
