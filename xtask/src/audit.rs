//! `cargo xtask audit`: what the images do not contain, and that each breach is caught.
//!
//! * Panics: the images' panic handler calls a function that is defined nowhere, so an image with a
//!   path to it does not link.
//! * Allocation: an image is built without `alloc`; what brings it in does not build.
//! * Formatting, f64 helpers, code for quads or contact: by the image's symbols. The features
//!   `broken-…` bring each of them in on purpose, so that a renamed function cannot hide one.
//! * What a baked scene has no need of: by the functions of its image, inlined ones included.
//! * Libraries for C: by all their symbols, local ones included.

use std::path::PathBuf;

use crate::absence::{ALLOCATOR, Absence, DOUBLE, FORMATTING, PANIC};
use crate::audit_baked;
use crate::audit_c;
use crate::export::scenes;
use crate::modules::{self, ROWS};
use crate::setup;
use crate::steps::Steps;
use crate::symbols::sized;
use signorini_image::board::{Build, M4F, M4F_192K};
use signorini_image::toolchain::output;

/// The functions that only quads need; none is inlined.
const QUADS: Absence = Absence {
    what: "quad code",
    is: |name| {
        ["of_quads", "gather_cells", "add_quads", "fill_quads", "7recover", "rannacher"]
            .iter()
            .any(|f| name.contains(f))
    },
};
/// `psor::sweep` as its mangled name has it, and not `psor::sweep_free`.
const CONTACT: Absence = Absence { what: "contact code", is: |name| name.contains("4psor5sweep") };

const TRIANGLES: [Absence; 5] = [FORMATTING, ALLOCATOR, PANIC, DOUBLE, QUADS];
const LINEAR: [Absence; 6] = [FORMATTING, ALLOCATOR, PANIC, DOUBLE, QUADS, CONTACT];
const GENERAL: [Absence; 4] = [FORMATTING, ALLOCATOR, PANIC, DOUBLE];

/// What the linker misses where a panic is possible.
const REACHABLE: &str = "a_panic_path_is_reachable";

/// What the compiler says with `core` alone, and with a target that rustup has installed.
const NO_ALLOC: [&str; 2] = ["can't find crate for `alloc`", "no global memory allocator"];

/// The images, then each breach.
pub fn run(steps: &mut Steps) {
    setup::run(steps);
    steps.check("triangles in f32: nothing else", || free_of("tick_triangles", &[], &TRIANGLES));
    steps.check("linear scene: no contact code either", || free_of("tick_linear", &[], &LINEAR));
    steps.check("mixed cells in f32", || free_of("tick_mixed", &[], &GENERAL));
    steps.check("quads are found where they are", || {
        caught(free_of("tick_mixed", &[], &[QUADS]), &[QUADS.what])
    });
    // Each breach is another image: the first of them in every run.
    let breaches = if steps.is_whole() { 6 } else { 1 };
    for (feature, absences, reasons) in [
        ("broken-panic", &TRIANGLES[..], &[REACHABLE][..]),
        ("broken-double", &TRIANGLES, &[DOUBLE.what]),
        ("broken-quads", &TRIANGLES, &[QUADS.what]),
        ("broken-contact", &LINEAR, &[CONTACT.what]),
        // Digits of a float are laid out by code that can panic.
        ("broken-format", &TRIANGLES, &[REACHABLE, FORMATTING.what]),
        ("broken-alloc", &TRIANGLES, &NO_ALLOC),
    ]
    .into_iter()
    .take(breaches)
    {
        steps.check(&format!("{feature} is caught"), || {
            caught(free_of("tick_linear", &[feature], absences), reasons)
        });
    }
    modules::bake_for_c(steps);
    for (row, audit) in ROWS.iter().filter_map(|row| row.audit.map(|audit| (row, audit))) {
        steps.check(&format!("{}, baked: what its scene lacks", row.name()), || {
            audit_baked::check(&audit, &row.module()?.image(&M4F_192K)?)
        });
    }
    audit_c::run(steps);
}

/// `Err` where the image does not link, or names one of the symbols.
fn free_of(image: &str, features: &[&str], absences: &[Absence]) -> Result<(), String> {
    let names = symbols(image, features)?;
    for absence in absences {
        if let Some(name) = names.iter().find(|name| (absence.is)(name)) {
            return Err(format!("{}: {name}", absence.what));
        }
    }
    println!("{image}: {} symbols, none of: {}", names.len(), list(absences));
    Ok(())
}

fn list(absences: &[Absence]) -> String {
    absences.iter().map(|absence| absence.what).collect::<Vec<_>>().join(", ")
}

fn symbols(image: &str, features: &[&str]) -> Result<Vec<String>, String> {
    let scenes = scenes()?;
    let build = Build { package: "signorini-firmware", bins: &[image], features, scenes: &scenes };
    let (mut command, folder): (_, PathBuf) = M4F.build(build)?;
    output(&mut command)?;
    let names: Vec<_> = sized(&folder.join(image))?.into_iter().map(|(name, _)| name).collect();
    // Without the sweep the image shows nothing.
    if names.iter().any(|name| name.contains("4psor")) {
        Ok(names)
    } else {
        Err("no sweep in it".to_owned())
    }
}

/// `Ok` where a check has failed for one of these reasons.
fn caught(found: Result<(), String>, reasons: &[&str]) -> Result<(), String> {
    match found {
        Err(why) if reasons.iter().any(|reason| why.contains(reason)) => Ok(()),
        Err(why) => Err(format!("refused for another reason: {why}")),
        Ok(()) => Err("not caught".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn helpers_for_f64_are_known() {
        for name in [
            "__aeabi_dmul",
            "__aeabi_ddiv",
            "__truncdfsf2",
            "__aeabi_f2d",
            "__aeabi_ui2d",
            "__aeabi_cdcmple",
            "__muldf3",
            "__fixdfsi",
        ] {
            assert!((DOUBLE.is)(name), "{name}");
        }
        for name in
            ["__aeabi_uldivmod", "__aeabi_memcpy", "__aeabi_fmul", "__mulsf3", "__udivmoddi4"]
        {
            assert!(!(DOUBLE.is)(name), "{name}");
        }
    }
}
