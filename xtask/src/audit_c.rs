//! Kinds of code that libraries for C lack: by all their symbols, those that they keep for themselves included.
//!
//! What a library asks for is refused when it is made, but memcpy and the like; here that is seen once more, by the archive alone,
//! and with a path to a panic that must not pass.

use crate::absence::{ALLOCATOR, Absence, DOUBLE, FORMATTING, PANIC};
use crate::c::package::machine;
use crate::modules::{ROWS, Row, row};
use crate::setup;
use crate::steps::Steps;
use crate::symbols::Shown;
use signorini_image::library::{EXPORTS, EXPORTS_WITHIN, Library};
use signorini_image::tools::ensure_for_c;

const ALWAYS: [Absence; 3] = [FORMATTING, ALLOCATOR, PANIC];

/// Functions that every C library has.
const OF_C: [&str; 5] = ["memcpy", "memmove", "memset", "memcmp", "memclr"];

/// A step for the libraries of each module, then the breaches.
pub fn run(steps: &mut Steps) {
    setup::run(steps);
    steps.check_once("tools for C", ensure_for_c);
    let is_whole = steps.is_whole();
    for row in ROWS.iter().filter(|row| !row.c.words(is_whole).is_empty()) {
        steps.check(&format!("{}, for C: what its libraries lack", row.name()), || {
            row.c.words(is_whole).into_iter().filter(|word| *word != "host").try_for_each(|word| {
                let names = symbols(row, word)?;
                lacks(&names, &ALWAYS)?;
                // Where there is a unit for f32 nothing else has to be called, and in f64 these helpers are.
                match lacks(&names, &[DOUBLE]) {
                    _ if word != "m4" => Ok(()),
                    Ok(()) if row.scalar == "f64" => Err("no f64 helper is found".to_owned()),
                    Err(_) if row.scalar == "f64" => Ok(()),
                    other => other,
                }
                .map_err(|why| format!("{word}: {why}"))
            })
        });
    }
    steps.check("broken-panic is caught when a library is made", broken);
}

/// The symbols of a library, which shows its functions and asks for nothing but what C has.
fn symbols(row: &Row, word: &str) -> Result<Shown, String> {
    let package = row.package(word)?;
    let names = Shown::of(&package.library())?;
    let exports = EXPORTS.iter().chain(&EXPORTS_WITHIN);
    let exports: Vec<_> = exports.map(|own| format!("{}_{own}", package.name)).collect();
    // Without its functions the archive shows nothing.
    if let Some(name) = exports.iter().find(|name| !names.shown.contains(name)) {
        return Err(format!("{word}: no {name}"));
    }
    if let Some(name) = names.shown.iter().find(|name| !exports.contains(name)) {
        return Err(format!("{word}: it shows {name}"));
    }
    if let Some(name) = names.asked.iter().find(|name| !is_of_c(name)) {
        return Err(format!("{word}: it asks for {name}"));
    }
    Ok(names)
}

/// `Ok` where the library has none of these.
fn lacks(names: &Shown, absences: &[Absence]) -> Result<(), String> {
    for absence in absences {
        let all = names.own.iter().chain(&names.shown).chain(&names.asked);
        if let Some(name) = all.into_iter().find(|name| (absence.is)(name)) {
            return Err(format!("{}: {name}", absence.what));
        }
    }
    Ok(())
}

fn is_of_c(name: &str) -> bool {
    let plain = name.strip_prefix("__aeabi_").unwrap_or(name);
    OF_C.contains(&plain.trim_end_matches(['4', '8']))
}

/// `Ok` where a library that can panic is not made.
fn broken() -> Result<(), String> {
    let module = row("levee", "--condensed")?.module()?;
    let text = std::fs::read_to_string(module.file()).map_err(|error| error.to_string())?;
    let features = &module.chosen.kernel_features;
    let made =
        Library::build_with(&["broken-panic"], &[], &text, features, "levee", machine("m4")?);
    match made {
        Err(why) if why.contains("the library can panic") => Ok(()),
        Err(why) => Err(format!("refused for another reason: {why}")),
        Ok(_) => Err("not caught".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_of_c_are_known() {
        for name in ["memcpy", "__aeabi_memcpy8", "__aeabi_memclr", "__aeabi_memmove4"] {
            assert!(is_of_c(name), "{name}");
        }
        for name in ["__aeabi_dmul", "malloc", "abort", "a_panic_path_is_reachable", "sqrtf"] {
            assert!(!is_of_c(name), "{name}");
        }
    }
}
