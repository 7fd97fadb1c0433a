//! Kinds of code that libraries for C lack: by all their symbols, those that they keep for themselves included.
//!
//! What a library asks for is refused when it is made, but memcpy and the like; here that is seen once more, by the archive alone,
//! and with a path to a panic that must not pass.

use super::kinds::{ALLOCATOR, DOUBLE, FORMATTING, Kind, PANIC, free_of};
use crate::c::package::machine;
use crate::caught::caught;
use crate::modules::{Row, row, rows};
use crate::setup;
use crate::steps::Steps;
use signorini_image::library::{Library, exports, mark, steps_in_time};
use signorini_image::objects::{ARM, symbols};

const ALWAYS: [Kind; 3] = [FORMATTING, ALLOCATOR, PANIC];

/// A step for the libraries of each module, then the breaches.
pub fn run(steps: &mut Steps) {
    setup::for_c(steps);
    let is_whole = steps.is_whole();
    for row in rows(is_whole).filter(|row| !row.c.words(is_whole).is_empty()) {
        steps.check(&format!("{}, for C: what its libraries lack", row.name()), || {
            row.c.words(is_whole).into_iter().filter(|word| *word != "host").try_for_each(|word| {
                let names = names(row, word)?;
                free_of(&names, &ALWAYS)?;
                // Where there is a unit for f32 nothing else has to be called, and in f64 these helpers are.
                match free_of(&names, &[DOUBLE]) {
                    _ if word != "m4" => Ok(()),
                    Ok(()) if row.scalar == "f64" => Err("no f64 helper is found".to_owned()),
                    Err(_) if row.scalar == "f64" => Ok(()),
                    other => other,
                }
                .map_err(|why| format!("{word}: {why}"))
            })
        });
    }
    steps.check("broken-panic is caught when a library is made", || {
        caught(broken(), &["the library can panic"])
    });
}

/// The symbols of a library, which shows its functions and asks for nothing but what C has.
fn names(row: &Row, word: &str) -> Result<Vec<String>, String> {
    let package = row.package(word)?;
    let symbols = symbols(ARM, &package.library())?;
    let text = row.module()?.text()?;
    let mark = mark(&text);
    let exports = exports(steps_in_time(&text)).into_iter();
    let mut exports: Vec<_> = exports.map(|own| format!("{}_{own}{mark}", package.name)).collect();
    let shown = symbols.iter().filter(|symbol| symbol.is_shown());
    let mut shown: Vec<_> = shown.map(|symbol| symbol.name.clone()).collect();
    exports.sort_unstable();
    shown.sort_unstable();
    // Without its functions the archive shows nothing.
    if shown != exports {
        return Err(format!("{word}: it shows {shown:?} instead of {exports:?}"));
    }
    if let Some(symbol) = symbols.iter().find(|symbol| symbol.is_asked() && !symbol.is_of_c()) {
        return Err(format!("{word}: it asks for {}", symbol.name));
    }
    Ok(symbols.into_iter().map(|symbol| symbol.name).collect())
}

/// A library that can panic.
fn broken() -> Result<Library, String> {
    let module = row("levee", "--condensed")?.module()?;
    let features = &module.chosen.kernel_features;
    Library::build_with(&["broken-panic"], &[], &module.text()?, features, "levee", machine("m4")?)
}
