//! `cargo xtask size`: what the images of baked scenes take, by what the scenes contain.

use std::fmt::Write as _;
use std::fs;

use crate::baked::Recipe;
use crate::board::{M4F_192K, emulator};
use crate::cargo::root;
use crate::firmware::Footprint;
use crate::record;
use crate::setup;
use crate::steps::Steps;
use crate::toolchain::Toolchain;

const RECORD: &str = "tests/firmware/size.txt";

/// A kind of scene.
struct Kind {
    what: &'static str,
    scene: &'static str,
    model: &'static str,
    /// Bytes of code that its image may have.
    most: u64,
}

/// What is condensed, then what is solved on its mesh; the leanest first.
const KINDS: [Kind; 8] = [
    Kind {
        what: "linear, condensed",
        scene: "tests/firmware/scenes/linear.toml",
        model: "--condensed",
        most: 8 * 1024,
    },
    Kind {
        what: "strip, condensed",
        scene: "meshes/scenes/strip.toml",
        model: "--condensed",
        most: 34 * 1024,
    },
    Kind {
        what: "levee, condensed",
        scene: "meshes/scenes/levee.toml",
        model: "--condensed",
        most: 34 * 1024,
    },
    Kind {
        what: "levee on 50 000 unknowns, condensed",
        scene: "tests/firmware/scenes/levee-96.toml",
        model: "--condensed",
        most: 34 * 1024,
    },
    Kind {
        what: "levee, on triangles",
        scene: "tests/firmware/scenes/levee-swept.toml",
        model: "--full",
        most: 30 * 1024,
    },
    Kind {
        what: "slab, on quads, transfer laws",
        scene: "tests/firmware/scenes/slab-swept.toml",
        model: "--full",
        most: 38 * 1024,
    },
    Kind {
        what: "strip, on both",
        scene: "tests/firmware/scenes/strip-swept.toml",
        model: "--full",
        most: 38 * 1024,
    },
    Kind {
        what: "strip, by a factor",
        scene: "tests/firmware/scenes/strip-factored.toml",
        model: "--full",
        most: 58 * 1024,
    },
];

/// Bakes, builds, runs and prints.
pub fn run(steps: &mut Steps) {
    setup::run(steps);
    let bless = steps.blesses();
    steps.check("flash, RAM and stack", || {
        let mut table =
            format!("{:<36}{:>8}{:>9}{:>9}{:>8}\n", "scene (f32)", "code", "data", "RAM", "stack");
        for kind in &KINDS {
            table += &row(kind)?;
        }
        println!("{table}");
        let versions =
            format!("{}, {}", Toolchain::find("thumbv7em-none-eabihf")?.version()?, emulator()?);
        if record::compare(RECORD, &versions, &table, bless)? { quoted(&table) } else { Ok(()) }
    });
}

fn row(kind: &Kind) -> Result<String, String> {
    let Kind { what, scene, model, most } = kind;
    let of = Footprint::of(&Recipe::of(scene, model), &M4F_192K)?;
    if of.code > *most {
        return Err(format!("{what}: {} bytes of code, {most} are allowed", of.code));
    }
    let mut text = format!("{what:<36}");
    let _ = writeln!(text, "{:>8}{:>9}{:>9}{:>8}", of.code, of.data, of.ram, of.stack);
    Ok(text)
}

/// `Ok` where the page on firmware shows this table, up to what records may differ by: the folder of a clone
/// moves constants by a few bytes.
fn quoted(table: &str) -> Result<(), String> {
    const PAGE: &str = "docs/firmware.md";
    let page = fs::read_to_string(root().join(PAGE)).map_err(|error| error.to_string())?;
    let head = table.lines().next().unwrap_or_default();
    let (_, shown) = page.split_once(head).ok_or(format!("{PAGE} does not show the table"))?;
    let shown: Vec<_> = shown.lines().take(table.lines().count()).collect();
    let differs = record::differences(&format!("{head}{}", shown.join("\n")), table)?;
    if differs.is_empty() { Ok(()) } else { Err(format!("{PAGE}: {}", differs.join("; "))) }
}
