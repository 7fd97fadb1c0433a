//! `cargo xtask logs`: what ticks take over recorded inputs. A board and this machine play the logs of `tests/firmware/logs`
//! bit for bit; the counts stand in a record in git.
//!
//! A row is a scene in time, or its steady twin, by the model that `bake` chooses. In a whole run each is played without its
//! bound, too: the share of the bound is what the median tick takes less then.

use std::path::PathBuf;

use crate::baked::Recipe;
use crate::record;
use crate::setup;
use crate::steps::Steps;
use signorini_image::board::M4F_192K;
use signorini_image::cargo::{root, target_dir};
use signorini_image::files;
use signorini_image::firmware::{Firmware, Instructions};

const RECORD: &str = "tests/firmware/logs.txt";

/// A log, the scene that plays it, and the length of a step where that is not the scene's.
type Row = (&'static str, &'static str, Option<&'static str>);

/// Those in time, which every run plays; then their steady twins.
const ROWS: [Row; 5] = [
    ("antiicing-10ms", "antiicing-warm", Some("0.01")),
    ("antiicing-1s", "antiicing-warm", None),
    ("levee-60s", "levee-warm", None),
    ("antiicing-1s", "antiicing", None),
    ("levee-60s", "levee", None),
];
const IN_TIME: usize = 2;

/// Modules that are baked for the rows: in a whole run each row without its bound, too.
pub fn modules(is_whole: bool) -> usize {
    if is_whole { 2 * ROWS.len() } else { IN_TIME }
}

/// Plays, prints, compares.
pub fn run(steps: &mut Steps) {
    setup::run(steps);
    let (bless, is_whole) = (steps.blesses(), steps.is_whole());
    steps.check("instructions over logs, bit for bit", || {
        let rows = if is_whole || bless { &ROWS[..] } else { &ROWS[..IN_TIME] };
        let mut table = line("M4F-192K, 400 ticks", ["median", "most"].map(str::to_owned));
        let mut bare =
            line("M4F-192K, without the bound", ["median", "bound %"].map(str::to_owned));
        for row in rows {
            let name = row.1;
            let recipe = Recipe::of(&format!("meshes/scenes/{name}.toml"), "");
            let recipe = Recipe { step: row.2.map(str::to_owned), ..recipe };
            let firmware = played(row, &recipe)?;
            let Instructions { median, max, .. } = firmware.instructions_per_tick;
            let what = format!("{} {name} {}", row.0, firmware.model);
            table += &line(&what, [median.to_string(), max.to_string()]);
            if rows.len() == ROWS.len() {
                let scene = without_bound(name, &firmware.model)?;
                let less = played(row, &Recipe { scene, ..recipe })?.instructions_per_tick.median;
                let share = 100.0 * (1.0 - less as f64 / median as f64);
                bare += &line(&what, [less.to_string(), format!("{share:.1}")]);
            }
        }
        let versions = record::versions()?;
        if rows.len() < ROWS.len() {
            println!("{table}");
            return record::compare_part(RECORD, &versions, &table).map(drop);
        }
        println!("{table}\n{bare}");
        record::compare(RECORD, &versions, &format!("{table}\n{bare}"), bless).map(drop)
    });
}

fn line(what: &str, [one, other]: [String; 2]) -> String {
    format!("{what:<42}{one:>12}{other:>12}\n")
}

/// The log of a row on the board: every tick has an answer, with the bits of this machine.
fn played((log, ..): &Row, recipe: &Recipe) -> Result<Firmware, String> {
    let module =
        recipe.bake()?.that_replays(&root().join(format!("tests/firmware/logs/{log}.csv")))?;
    let firmware = Firmware::measure(&module, &M4F_192K)?;
    firmware.verdict()?;
    Ok(firmware)
}

/// A fragment of a scene that leaves the bound out, of the same model.
fn without_bound(scene: &str, model: &str) -> Result<PathBuf, String> {
    let file = target_dir("firmware").join(format!("{scene}-bare.toml"));
    let extended = root().join(format!("meshes/scenes/{scene}.toml"));
    let setting = format!("[setting]\ncertificate = false\nmodel = {model:?}");
    let text = format!("extends = {extended:?}\n{setting}\n");
    files::write(&file, text)?;
    Ok(file)
}
