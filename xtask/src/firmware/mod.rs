//! `cargo xtask firmware`: any scene on an emulated board, and the same ticks on this machine.
//!
//! ```text
//!   SCENE.toml ─ signorini bake ─► module ─┬─ image ─► board ─┬─► equal? ─► firmware.json
//!                                          └─ program ─► desk ┘
//! ```

mod options;
mod stated;

use std::fs;
use std::path::Path;
use std::process::ExitCode;

use signorini_image::board::{Board, M4F_192K};
use signorini_image::cargo::target_dir;
use signorini_image::chosen::Chosen;
use signorini_image::firmware::Firmware;
use signorini_image::module::Module;
use signorini_image::tools::ensure;
use signorini_image::worst::WorstStart;

use crate::baked::{Failure, Recipe};
use crate::steps::Steps;
use options::{HELP, Options};
use stated::compare;

/// The verb.
pub fn run(words: &[&str]) -> ExitCode {
    if words.iter().any(|word| ["--help", "-h"].contains(word)) {
        print!("{HELP}");
        return ExitCode::SUCCESS;
    }
    let options = match Options::parse(words) {
        Ok(options) => options,
        Err(why) => {
            eprintln!("error: {why}\n\n{HELP}");
            return ExitCode::from(2);
        }
    };
    match measure(&options).and_then(|(firmware, _)| verdict(&firmware).map_err(Failure::from)) {
        Ok(()) => ExitCode::SUCCESS,
        // What the bake said of wrong input stands above.
        Err(failure) if failure.status == 2 => ExitCode::from(2),
        Err(failure) => {
            eprintln!("error: {}", failure.why);
            ExitCode::from(failure.status)
        }
    }
}

/// A scene, its model, and the instructions that a tick may take in the median.
///
/// A seepage face, quads and transfer laws, both kinds of cells, swept and by a factor; then more than 50 000 unknowns condensed to 64
/// and 96 contact edges.
const TESTED: [(&str, &str, Option<u64>); 8] = [
    ("meshes/scenes/levee.toml", "--condensed", None),
    ("meshes/scenes/slab.toml", "--condensed", None),
    ("meshes/scenes/strip.toml", "--condensed", None),
    ("tests/firmware/scenes/strip-swept.toml", "--full", None),
    ("tests/firmware/scenes/strip-factored.toml", "--full", None),
    ("tests/firmware/scenes/levee-64.toml", "--condensed", Some(60_000)),
    ("tests/firmware/scenes/levee-96.toml", "--condensed", Some(120_000)),
    ("meshes/scenes/antiicing.toml", "--condensed", Some(350_000)),
];

/// Scenes whose statement by `bake` is compared with the image: quads, triangles and outputs, the mesh itself, limits and modes.
const EXPLAINED: [&str; 6] = ["slab", "levee", "strip", "levee-64", "strip-swept", "antiicing"];

/// Scenes on the board with 192 KiB, as steps of `cargo xtask test`.
pub fn check(steps: &mut Steps) {
    for (scene, model, most) in TESTED {
        let recipe = Recipe::of(scene, model);
        let name = format!("{} {}", recipe.scene_name(), model.trim_start_matches('-'));
        steps.check(&format!("{name}, baked, on the M4F-192K, bit for bit"), || {
            let out = target_dir("firmware").join("bills").join(name.replace(' ', "-"));
            let is_compared = EXPLAINED.contains(&recipe.scene_name().as_str());
            let worst = false;
            let (firmware, chosen) = measure(&Options { recipe, board: M4F_192K, out, worst })?;
            firmware.verdict()?;
            within(most, firmware.instructions_per_tick.median)?;
            if is_compared { compare(&chosen, &firmware) } else { Ok(()) }
        });
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

/// Scenes whose worst case is tried on the board, and how many times what is found may be proved: every start of 7 edges, 10 000
/// of 28, and as many of 32 whose fluxes have limits. With these, two exchanges an edge are proved of the third phase, which
/// hardly a scene needs.
const TRIED: [(&str, f64); 3] = [
    ("meshes/scenes/levee.toml", 2.2),
    ("meshes/scenes/slab.toml", 2.2),
    ("meshes/scenes/antiicing.toml", 2.6),
];

/// No start takes more than is proved, as steps of `cargo xtask test`.
pub fn check_worst(steps: &mut Steps) {
    for (scene, times) in TRIED {
        let recipe = Recipe::of(scene, "--condensed");
        let name = recipe.scene_name();
        steps.check(&format!("{name}, no start takes more than is proved"), || {
            let out = target_dir("firmware").join("bills").join(format!("{name}-worst"));
            let (firmware, _) = measure(&Options { recipe, board: M4F_192K, out, worst: true })?;
            verdict(&firmware)?;
            let found = firmware.worst_start.ok_or("no start was tried")?;
            found.is_near(&firmware.worst_case, times)
        });
    }
}

/// Bakes, builds, runs, compares; writes and prints what came of it.
fn measure(options: &Options) -> Result<(Firmware, Chosen), Failure> {
    ensure()?;
    let module = options.recipe.bake()?;
    let mut firmware = Firmware::measure(&module, &options.board)?;
    if options.worst {
        firmware.worst_start = Some(worst_start(&module, &options.board)?);
    }
    let file = options.out.join("firmware.json");
    replace(&file, &firmware.json())?;
    println!("{}written to {}", firmware.table(&options.recipe.scene_name()), file.display());
    Ok((firmware, module.chosen))
}

/// What the board finds from starts of every kind.
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
    let folder = file.parent().unwrap_or(Path::new("."));
    let written = fs::create_dir_all(folder)
        .and_then(|()| fs::write(&fresh, text))
        .and_then(|()| fs::rename(&fresh, file));
    written.map_err(|error| format!("{}: {error}", file.display()))
}
