//! `cargo xtask audit`: what the images do not contain, and that each breach is caught.
//!
//! * Panics: the images' panic handler calls a function that is defined nowhere, so an image with a
//!   path to it does not link.
//! * Allocation: an image is built without `alloc`; what brings it in does not build.
//! * Formatting, f64 helpers, code for quads or contact: by the image's symbols. The features
//!   `broken-…` bring each of them in on purpose, so that a renamed function cannot hide one.
//! * What a baked scene has no need of: by the functions of its image, inlined ones included.
//! * Libraries for C: by all their symbols, local ones included.

pub mod kinds;
mod library;

use std::path::Path;
use std::process::Command;

use crate::caught::caught;
use crate::export::scenes;
use crate::modules::{self, rows};
use crate::setup;
use crate::steps::Steps;
use kinds::{Audit, CONTACT, DOUBLE, FORMATTING, QUAD_STAGES};
use signorini_image::board::{Build, M4F, M4F_192K};
use signorini_image::objects::{ARM, run as run_binutils, symbols};
use signorini_image::toolchain::output;

/// The symbol that the linker misses where a panic is possible.
const REACHABLE: &str = "a_panic_path_is_reachable";

/// The error of the compiler with `core` alone, and with a target that rustup has installed.
const NO_ALLOC: [&str; 2] = ["can't find crate for `alloc`", "no global memory allocator"];

/// Images of stages.
const IMAGES: [(&str, &str, Audit); 3] = [
    ("triangles in f32: nothing else", "tick_triangles", Audit::TRIANGLE_STAGES),
    ("linear scene: no contact code either", "tick_linear", Audit::LINEAR_STAGES),
    ("mixed cells in f32, with quads", "tick_mixed", Audit::MIXED_STAGES),
];

/// Features of the linear scene's image, each with the audit that it fails, and for which reasons.
const BREACHES: [(&str, Audit, &[&str]); 6] = [
    ("broken-panic", Audit::TRIANGLE_STAGES, &[REACHABLE]),
    ("broken-double", Audit::TRIANGLE_STAGES, &[DOUBLE.what]),
    ("broken-quads", Audit::TRIANGLE_STAGES, &[QUAD_STAGES.what]),
    ("broken-contact", Audit::LINEAR_STAGES, &[CONTACT.what]),
    // Digits of a float are laid out by code that can panic.
    ("broken-format", Audit::TRIANGLE_STAGES, &[REACHABLE, FORMATTING.what]),
    ("broken-alloc", Audit::TRIANGLE_STAGES, &NO_ALLOC),
];

/// The images, then each breach.
pub fn run(steps: &mut Steps) {
    setup::run(steps);
    for (what, image, audit) in IMAGES {
        steps.check(what, || audit.judge(&names(image, &[])?));
    }
    // Each breach is another image: the first of them in every run.
    let breaches = if steps.is_whole() { BREACHES.len() } else { 1 };
    for (feature, audit, reasons) in BREACHES.into_iter().take(breaches) {
        steps.check(&format!("{feature} is caught"), || {
            let judged = names("tick_linear", &[feature]).and_then(|names| audit.judge(&names));
            caught(judged, reasons)
        });
    }
    modules::bake_for_c(steps);
    let rows = rows(steps.is_whole());
    for (row, audit) in rows.filter_map(|row| row.audit.map(|audit| (row, audit))) {
        steps.check(&format!("{}, baked: what its scene lacks", row.name()), || {
            audit.judge(&with_inlined(&row.module()?.image(&M4F_192K)?)?)
        });
    }
    library::run(steps);
}

/// The functions of an image of stages; `Err` where it does not link.
fn names(image: &str, features: &[&str]) -> Result<Vec<String>, String> {
    let scenes = scenes()?;
    let build = Build { package: "signorini-firmware", bins: &[image], features, scenes: &scenes };
    let (mut command, folder) = M4F.build(build)?;
    output(&mut command)?;
    let names = of_image(&folder.join(image))?;
    println!("{image}: {} symbols", names.len());
    // Without the sweep the image shows nothing.
    let has_sweep = names.iter().any(|name| name.contains("4psor"));
    if has_sweep { Ok(names) } else { Err("no sweep in it".to_owned()) }
}

fn of_image(image: &Path) -> Result<Vec<String>, String> {
    Ok(symbols(ARM, image)?.into_iter().map(|symbol| symbol.name).collect())
}

/// All functions of an image, and those of the kernel that were inlined, which the debug information names.
fn with_inlined(image: &Path) -> Result<Vec<String>, String> {
    let mut dump = Command::new(format!("{ARM}objdump"));
    let listing = run_binutils(ARM, dump.arg("--dwarf=info").arg(image))?;
    let own = ["signorini_kernel", "signorini_contact", "signorini_device"];
    let named = listing.lines().filter(|line| line.contains("DW_AT_linkage_name"));
    let inlined = named.filter_map(|line| Some(line.rsplit(": ").next()?.trim()));
    let inlined = inlined.filter(|name| own.iter().any(|part| name.contains(part)));
    let mut names = of_image(image)?;
    let count = names.len();
    names.extend(inlined.map(str::to_owned));
    // Without these names the image shows little.
    if names.len() > count {
        Ok(names)
    } else {
        Err("no inlined function of the kernel".to_owned())
    }
}
