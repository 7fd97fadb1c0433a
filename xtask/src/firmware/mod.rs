//! `cargo xtask firmware`: any scene on an emulated board, and the same ticks on this machine.
//!
//! ```text
//!   SCENE.toml ─ signorini bake ─► module ─┬─ image ─► board ─┬─► equal? ─► firmware.json
//!                                          └─ program ─► desk ┘
//! ```

mod options;

use std::fs;
use std::path::Path;
use std::sync::Arc;

use signorini_image::board::{Board, M4F_192K};
use signorini_image::cargo::target_dir;
use signorini_image::chosen::Chosen;
use signorini_image::files;
use signorini_image::firmware::Firmware;
use signorini_image::module::Module;
use signorini_image::tools::ensure;
use signorini_image::worst::WorstStart;

use crate::baked::Failure;
use crate::modules::{Row, rows};
use crate::record;
use crate::steps::Steps;
pub use options::Options;

/// The verb.
pub fn run(options: &Options) -> Result<(), Failure> {
    Ok(verdict(&measure(options)?.0)?)
}

/// Scenes on the board with 192 KiB, as steps of `cargo xtask test`.
pub fn check(steps: &mut Steps) {
    for row in rows(steps.is_whole()).filter(|row| row.is_played) {
        steps.check(&format!("{}, on the M4F-192K, bit for bit", row.name()), || {
            let (firmware, chosen) = measure(&options(row, false))?;
            firmware.verdict()?;
            within(row.median, firmware.instructions_per_tick.median)?;
            // What `bake` states was counted on the code of one compiler.
            let counted = ["host/bake/records/cost.txt", "host/bake/records/size.txt"];
            let versions = record::versions()?;
            let is_counted = |record: &&str| record::is_of(record, &versions).unwrap_or_default();
            if row.is_explained && counted.iter().all(is_counted) {
                compare(&chosen, &firmware)
            } else {
                Ok(())
            }
        });
    }
    if let Some(row) = rows(false).find(|row| row.is_played) {
        steps.check(&format!("{}, with intervals, bit for bit", row.name()), || {
            let (firmware, _) = measure(&Options { locates: true, ..options(row, false) })?;
            firmware.verdict()?;
            match firmware.output_bounds.values().any(Option::is_some) {
                true => Ok(()),
                false => Err("no output has an interval".to_owned()),
            }
        });
    }
}

fn options(row: &Row, worst: bool) -> Options {
    let name = format!("{}{}", row.name(), if worst { " worst" } else { "" });
    let out = target_dir("firmware").join("bills").join(name.replace(' ', "-"));
    Options {
        recipe: row.recipe(),
        board: M4F_192K,
        out: Some(out),
        worst,
        log: None,
        locates: false,
    }
}

/// `Ok` where bits are equal, and no start takes more than is proved.
fn verdict(firmware: &Firmware) -> Result<(), String> {
    firmware.verdict()?;
    firmware.worst_start.map_or(Ok(()), |found| found.verdict(&firmware.worst_case))
}

/// `Ok` where the median tick takes at most so many instructions. They are counted one by one: the same every time.
fn within(most: Option<u64>, median: u64) -> Result<(), String> {
    match most {
        Some(most) if median > most => {
            Err(format!("{median} instructions per tick in the median, {most} are allowed"))
        }
        _ => Ok(()),
    }
}

/// No start takes more than is proved, as steps of `cargo xtask test`: every start of the levee's 7 edges, and in a whole run
/// 10 000 of the slab's 28, and as many of 32 whose fluxes have limits. With these, two exchanges an edge are proved of the third
/// phase, which hardly a scene needs.
pub fn check_worst(steps: &mut Steps) {
    let is_whole = steps.is_whole();
    let count = if is_whole { usize::MAX } else { 1 };
    let rows = rows(is_whole).filter_map(|row| row.worst.map(|times| (row, times)));
    for (row, times) in rows.take(count) {
        steps.check(&format!("{}, no start takes more than is proved", row.name()), || {
            let (firmware, _) = measure(&options(row, true))?;
            verdict(&firmware)?;
            let found = firmware.worst_start.ok_or("no start was tried")?;
            found.is_near(&firmware.worst_case, times)
        });
    }
}

/// Bakes, builds, runs, compares; writes and prints what came of it.
fn measure(options: &Options) -> Result<(Firmware, Chosen), Failure> {
    ensure(&[options.board.triple])?;
    let mut module = options.recipe.bake()?;
    if options.locates {
        module = Arc::new(module.that_locates());
    }
    if let Some(log) = &options.log {
        module = Arc::new(module.that_replays(log)?);
    }
    let mut firmware = Firmware::measure(&module, &options.board)?;
    if options.worst {
        firmware.worst_start = Some(worst_start(&module, &options.board)?);
    }
    let out = options.out.clone();
    let out = out.unwrap_or_else(|| Path::new("out").join(options.recipe.scene_name()));
    let file = out.join("firmware.json");
    replace(&file, &firmware.json())?;
    println!("{}written to {}", firmware.table(&options.recipe.scene_name()), file.display());
    Ok((firmware, module.chosen.clone()))
}

/// The worst tick that the board finds from starts of every kind.
fn worst_start(module: &Module, board: &Board) -> Result<WorstStart, String> {
    let Chosen { model, worst_case, .. } = &module.chosen;
    if model != "condensed" || worst_case.instructions.is_none() && !worst_case.proven {
        return Err("--worst: no worst case is proved of this model".to_owned());
    }
    WorstStart::parse(&board.run(&module.worst(board)?, true)?)
}

/// Puts a file in its place whole or not at all.
fn replace(file: &Path, text: &str) -> Result<(), String> {
    let fresh = file.with_extension(format!("json.{}", std::process::id()));
    files::write(&fresh, text)?;
    fs::rename(&fresh, file).map_err(|error| format!("{}: {error}", file.display()))
}

/// The error that the figures may have, as a part of what the image takes. RAM is known but for the stack, flash but for the code
/// of this very scene; instructions are counted stages times the work of the same ticks on this machine.
const TOLERANCES: [(&str, f64); 3] = [("RAM", 0.01), ("flash", 0.03), ("instructions", 0.10)];

/// `Ok` where the image takes what was stated, within the tolerances.
fn compare(stated: &Chosen, image: &Firmware) -> Result<(), String> {
    let Chosen { ram_bytes, flash_bytes, instructions, .. } = stated;
    let instructions = instructions.ok_or("bake states no instructions")?;
    let takes = [image.ram_bytes, image.flash_bytes, image.instructions_per_tick.median];
    all_within(
        [*ram_bytes as f64, *flash_bytes as f64, instructions],
        takes.map(|takes| takes as f64),
    )
}

fn all_within(stated: [f64; 3], takes: [f64; 3]) -> Result<(), String> {
    let mut wrong = Vec::new();
    for ((&(what, most), stated), takes) in TOLERANCES.iter().zip(stated).zip(takes) {
        let off = stated / takes - 1.0;
        println!("  {what}: {stated:.0} stated, {takes} taken, {:+.1} %", 100.0 * off);
        let is_met = off.abs() <= most;
        if !is_met {
            let allowed = 100.0 * most;
            wrong
                .push(format!("{what}: {stated:.0} stated, {takes} taken, {allowed:.0} % allowed"));
        }
    }
    if wrong.is_empty() { Ok(()) } else { Err(wrong.join("; ")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_compared_within_the_tolerances() {
        let stated = [1104.0, 49720.0, 14238.0];
        assert_eq!(all_within(stated, [1108.0, 49000.0, 13500.0]), Ok(()));
        let why = all_within(stated, [1108.0, 52484.0, 9880.0]).unwrap_err();
        assert!(
            why.contains("flash: 49720") && why.contains("instructions") && !why.contains("RAM")
        );
    }
}
