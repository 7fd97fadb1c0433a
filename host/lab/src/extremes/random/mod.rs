//! `signorini extremes --random N --seed S`: whole scenes drawn at random, each judged by a truth of its own.
//!
//! ```text
//!   mesh, function ─► catalogue, made, data, feature ─► Case ─► attempt ─► measure (exact, or nested) ─► verdict ─► record
//! ```
//! Case k of a seed depends on nothing but k and the seed, so that each can be had alone. Seven of ten have a `feature`.

mod attempt;
mod case;
mod catalogue;
mod cut;
mod data;
mod feature;
mod function;
pub mod in_time;
mod made;
mod measure;
mod mesh;
mod nested;
mod outputs;
mod posed;
mod record;
mod residual;
mod spot;
mod step;
#[cfg(test)]
mod tests;
mod trajectory;
mod verdict;
mod window;

use std::ops::RangeInclusive;
use std::path::Path;
use std::time::{Duration, Instant};

use attempt::{Attempt, attempt};
use case::RandomCase;
use measure::measure;
use record::{Record, Row};
use verdict::{broken_by, verdict};

use super::judge::{Outcome, Verdict, failed, lost};
use super::kept::{Findings, Kept};
use super::watch::watched;
use crate::record_file::{csv, indented};
use signorini_files::atomic::write_atomically;
use signorini_scene::Result;
use signorini_scene::mesh::gmsh::write as msh;

/// A case without an answer by then hangs.
const LIMIT: Duration = Duration::from_secs(1800);

/// Draws these cases of a seed and runs in two threads those that are not yet `kept`; calls `done` after each. A case that breaks a
/// promise is never kept, but run again.
pub fn run(
    seed: u64,
    cases: RangeInclusive<u32>,
    kept: &Kept,
    done: impl Fn() + Sync,
) -> Result<Findings> {
    let key = |number| format!("{number} of {seed}");
    let rows = kept.rows(cases, key, |number| row(seed, number), done)?;
    let record = Record::new(seed, kept.seconds(), &rows);
    let files = vec![
        ("random.json", indented(&record).into_bytes()),
        ("random.csv", csv("random.csv", &rows)?),
    ];
    let wrong = record.violations.iter().map(|violation| violation.case).collect();
    Ok(Findings { files, text: record.text(), wrong })
}

/// Writes the scene and the mesh of a case into `folder`.
pub fn write(seed: u64, number: u32, folder: &Path) -> Result<()> {
    let case = RandomCase::draw(seed, number);
    let effort = case.effort;
    let how = format!(
        "# case {number} of seed {seed}: {:?}, {:?}; at most {:?} sweeps\n# earlier ticks {:?}\n# tick {:?}\n",
        effort.way, effort.scalar, effort.sweeps, effort.earlier, effort.inputs
    );
    write_atomically(&folder.join("scene.toml"), (how + &case.scene).as_bytes())?;
    write_atomically(&folder.join("mesh.msh"), msh::text(&case.mesh).as_bytes())
}

fn row(seed: u64, number: u32) -> Row {
    let start = Instant::now();
    let left = watched(LIMIT, move || {
        let case = RandomCase::draw(seed, number);
        let start = Instant::now();
        let found = attempt(&case);
        let seconds = start.elapsed().as_secs_f64();
        let row = match found {
            Ok(attempt) => answered(&case, &attempt),
            Err(error) => concluded(Row::of(&case), failed(error)),
        };
        Row { seconds, ..row }
    });
    let row =
        left.unwrap_or_else(|why| concluded(Row::of(&RandomCase::draw(seed, number)), lost(why)));
    Row { seconds_in_all: start.elapsed().as_secs_f64(), ..row }
}

/// Measures an answer, if its numbers are finite, and judges it.
fn answered(case: &RandomCase, attempt: &Attempt) -> Row {
    let measured = if attempt.is_finite() { measure(case, attempt) } else { Ok(None) };
    let measured = match measured {
        Ok(measured) => measured,
        Err(error) => {
            let note = format!("not measured: {}", error.reason());
            return concluded(Row::of(case), (Outcome::Wrong, note));
        }
    };
    let broken = broken_by(case, attempt, measured.as_ref());
    let (outcome, note) = verdict(case, attempt, measured.as_ref());
    let outcome = if broken.is_empty() { outcome } else { Outcome::Wrong };
    Row { broken, outcome, note, ..Row::of(case).with(case, attempt, measured.as_ref()) }
}

fn concluded(row: Row, (outcome, note): Verdict) -> Row {
    Row { outcome, note, ..row }
}
