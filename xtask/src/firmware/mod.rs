//! `cargo xtask firmware`: any scene on an emulated board, and the same ticks on this machine.
//!
//! ```text
//!   SCENE.toml ─ signorini bake ─► scene.rs ─┬─ image ─► board ─┬─► equal? ─► firmware.json
//!                                            └─ program ─► desk ┘
//! ```

mod bill;
mod options;
mod programs;
mod ticks;

use std::fs;
use std::path::Path;
use std::process::ExitCode;

use crate::cargo::{root, target_dir};
use crate::setup;
use crate::steps::Steps;
use bill::Bill;
use options::{HELP, Options};
use programs::Programs;

/// Why there is no result, and the exit status for it.
#[derive(Debug)]
pub struct Failure {
    why: String,
    status: u8,
}

impl From<String> for Failure {
    fn from(why: String) -> Self {
        Self { why, status: 1 }
    }
}

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
    match measure(&options) {
        Ok(()) => ExitCode::SUCCESS,
        // What the bake said of wrong input stands above.
        Err(failure) if failure.status == 2 => ExitCode::from(2),
        Err(failure) => {
            eprintln!("error: {}", failure.why);
            ExitCode::from(failure.status)
        }
    }
}

/// Scenes with a seepage face, with quads and transfer, with both kinds of cells.
const TESTED: [&str; 3] = ["levee", "slab", "strip"];

/// Three scenes on the board with 192 KiB, as steps of `cargo xtask test`.
pub fn check(steps: &mut Steps) {
    for name in TESTED {
        steps.check(&format!("{name} baked, on the M4F-192K, bit for bit"), || {
            let out = target_dir("firmware").join("baked").join(name);
            let scene = root().join(format!("meshes/scenes/{name}.toml"));
            measure(&Options::new(scene, "m4-192k", out)).map_err(|failure| failure.why)
        });
    }
}

/// Bakes, builds, runs, compares; writes and prints what came of it.
fn measure(options: &Options) -> Result<(), Failure> {
    setup::ensure()?;
    let programs = Programs::build(options)?;
    let bill = Bill::new(options, &programs)?;
    let file = options.out.join("firmware.json");
    replace(&file, &bill.json())?;
    println!("{}written to {}", bill.table(), file.display());
    bill.verdict().map_err(Failure::from)
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
