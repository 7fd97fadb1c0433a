//! `cargo xtask size`: flash, RAM and stack of a scene's image, by what the scene contains.

use std::fmt::Write as _;
use std::fs;

use crate::board::{Build, M4F_192K, emulator};
use crate::cargo::{root, run as run_cargo};
use crate::export::scenes;
use crate::record;
use crate::setup;
use crate::steps::Steps;
use crate::symbols::{section, sized};
use crate::toolchain::Toolchain;

const RECORD: &str = "tests/firmware/size.txt";

/// The images, smallest first.
const IMAGES: [(&str, &str); 4] = [
    ("tick_linear", "linear, triangles"),
    ("tick_triangles", "contact, triangles"),
    ("tick_quads", "contact, quads"),
    ("tick_mixed", "contact, mixed"),
];

/// What runs in every tick; the rest of an image runs once, or is the example's own.
const TICK: [&str; 4] = ["4psor", "12of_triangles", "16loaded_triangles", "8of_quads"];

/// Bytes that the code of an image, and that of a tick, may have.
const MOST: (u64, u64) = (8 * 1024, 4 * 1024);

/// Bytes of an image.
struct Sizes {
    code: u64,
    tick: u64,
    constants: u64,
    ram: u64,
    /// The static that holds all arrays, by the symbol table.
    memory: u64,
    stack: u64,
    formula: u64,
}

/// Builds, runs and prints.
pub fn run(steps: &mut Steps) {
    setup::run(steps);
    let bless = steps.blesses();
    steps.check("flash, RAM and stack", || {
        let mut table = format!(
            "{:<24}{:>8}{:>12}{:>12}{:>10}{:>10}{:>8}\n",
            "image (f32)", "code", "of a tick", "constants", "RAM", "formula", "stack"
        );
        for (image, what) in IMAGES {
            let sizes = measure(image)?;
            let Sizes { code, tick, constants, ram, stack, formula, .. } = sizes;
            let _ = writeln!(
                table,
                "{what:<24}{code:>8}{tick:>12}{constants:>12}{ram:>10}{formula:>10}{stack:>8}"
            );
            check(image, &sizes)?;
        }
        println!("{table}Code: at most {} bytes, of a tick {}.", MOST.0, MOST.1);
        let versions =
            format!("{}, {}", Toolchain::find("thumbv7em-none-eabihf")?.version()?, emulator()?);
        if record::compare(RECORD, &versions, &table, bless)? { quoted(&table) } else { Ok(()) }
    });
}

/// `Ok` where the README shows this table, up to what records may differ by: the folder of a clone
/// moves constants by a few bytes.
fn quoted(table: &str) -> Result<(), String> {
    let readme = fs::read_to_string(root().join("README.md")).map_err(|error| error.to_string())?;
    let head = table.lines().next().unwrap_or_default();
    let (_, shown) = readme.split_once(head).ok_or("README.md does not show the table")?;
    let shown: Vec<_> = shown.lines().take(table.lines().count()).collect();
    let differs = record::differences(&format!("{head}{}", shown.join("\n")), table)?;
    if differs.is_empty() { Ok(()) } else { Err(format!("README.md: {}", differs.join("; "))) }
}

fn measure(image: &str) -> Result<Sizes, String> {
    let scenes = scenes()?;
    let build =
        Build { package: "signorini-firmware", bins: &[image], features: &[], scenes: &scenes };
    let (command, folder) = M4F_192K.build(build)?;
    run_cargo(command)?;
    let file = folder.join(image);
    let said = M4F_192K.run(&file, false)?;
    let note = |name: &str, at: usize| {
        let line = said.lines().find(|line| line.starts_with(&format!("@ {name} ")));
        line.and_then(|line| line.split_whitespace().nth(at)?.parse().ok())
            .ok_or_else(|| format!("{image} does not tell its {name}"))
    };
    let section = |name| section(&file, name);
    let symbols = sized(&file)?;
    let of = |wanted: &str| -> u64 {
        symbols.iter().filter(|(name, _)| name.contains(wanted)).map(|(_, size)| size).sum()
    };
    Ok(Sizes {
        code: section(".text")?,
        tick: TICK.iter().map(|name| of(name)).sum(),
        constants: section(".rodata")? + section(".vector_table")?,
        ram: section(".bss")? + section(".data")?,
        memory: of("TICK"),
        stack: note("stack", 2)?,
        formula: note("memory", 3)?,
    })
}

fn check(image: &str, sizes: &Sizes) -> Result<(), String> {
    if sizes.memory != sizes.formula {
        let Sizes { memory, formula, .. } = sizes;
        return Err(format!("{image}: {memory} bytes in the image, {formula} by the formula"));
    }
    if sizes.tick == 0 {
        return Err(format!("{image}: the functions of a tick are not found"));
    }
    if image == "tick_triangles" && (sizes.code > MOST.0 || sizes.tick > MOST.1) {
        return Err(format!("{image}: {} bytes of code, {} of a tick", sizes.code, sizes.tick));
    }
    Ok(())
}
