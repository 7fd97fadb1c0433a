//! `cargo xtask size`: what the images of baked scenes take, by what the scenes contain.

use crate::modules::{Row, rows};
use crate::record;
use crate::setup;
use crate::snapshot;
use crate::steps::Steps;
use signorini_image::board::M4F_192K;
use signorini_image::footprint::Footprint;
use signorini_image::record::sizes;

const RECORD: &str = "host/bake/records/size.txt";

/// Bakes, builds, runs and prints.
pub fn run(steps: &mut Steps) {
    setup::run(steps);
    let (bless, is_whole) = (steps.blesses(), steps.is_whole());
    steps.check("flash, RAM and stack", || {
        let rows = rows(is_whole).filter_map(|row| row.size.map(|size| (row, size)));
        let rows: Result<Vec<_>, String> =
            rows.map(|(row, (what, most))| Ok((what, footprint(row, most)?))).collect();
        let table = sizes::write(&rows?);
        println!("{table}");
        let versions = record::versions()?;
        let is_same = match is_whole {
            true => record::compare(RECORD, &versions, &table, bless)?,
            false => record::compare_part(RECORD, &versions, &table)?,
        };
        if is_same { quoted(&table, is_whole) } else { Ok(()) }
    });
}

/// Takes the measure of a module's image, which has at most so many bytes of code.
fn footprint(row: &Row, most: u64) -> Result<Footprint, String> {
    let module = row.module()?;
    let of = Footprint::new(&module.image(&M4F_192K)?, &module.on_board(&M4F_192K)?)?;
    match of.statics.code {
        code if code > most => {
            Err(format!("{}: {code} bytes of code, {most} are allowed", row.name()))
        }
        _ => Ok(of),
    }
}

/// `Ok` where the page on firmware shows this table, or has its rows where it is not the whole one, up to what records may differ by:
/// the folder of a clone moves constants by a few bytes.
fn quoted(table: &str, is_whole: bool) -> Result<(), String> {
    const PAGE: &str = "docs/firmware.md";
    let page = snapshot::read(PAGE)?;
    let head = table.lines().next().unwrap_or_default();
    let (_, shown) = page.split_once(head).ok_or(format!("{PAGE} does not show the table"))?;
    let shown = format!("{head}{}", shown.split("```").next().unwrap_or_default());
    let shown = if is_whole { shown } else { record::part(&shown, table) };
    let differs = record::differences(&shown, table)?;
    if differs.is_empty() { Ok(()) } else { Err(format!("{PAGE}: {}", differs.join("; "))) }
}
