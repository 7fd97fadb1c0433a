//! What libraries for C do not contain: by all their symbols, those that they keep for themselves included.
//!
//! What a library asks for is refused when it is made, but memcpy and the like; here that is seen once more, by the archive alone,
//! and with a path to a panic that must not pass.

use crate::absence::{ALLOCATOR, Absence, DOUBLE, FORMATTING, PANIC};
use crate::baked::Recipe;
use crate::c::package::{Package, machine};
use crate::steps::Steps;
use crate::symbols::Shown;
use signorini_image::library::{EXPORTS, EXPORTS_WITHIN, Library};
use signorini_image::tools::ensure_for_c;

const ALWAYS: [Absence; 3] = [FORMATTING, ALLOCATOR, PANIC];

/// Functions that every C library has.
const OF_C: [&str; 5] = ["memcpy", "memmove", "memset", "memcmp", "memclr"];

/// Condensed models of every kind, then meshes: by sweeps with transfer laws, and by a factor.
const SCENES: [(&str, &str); 6] = [
    ("tests/firmware/scenes/linear.toml", "--condensed"),
    ("meshes/scenes/levee.toml", "--condensed"),
    ("meshes/scenes/slab.toml", "--condensed"),
    ("meshes/scenes/antiicing.toml", "--condensed"),
    ("tests/firmware/scenes/slab-swept.toml", "--full"),
    ("tests/firmware/scenes/strip-factored.toml", "--full"),
];

/// A step for each library, then the breaches.
pub fn run(steps: &mut Steps) {
    steps.check_once("tools for C", ensure_for_c);
    for (scene, model) in SCENES {
        let recipe = Recipe::of(scene, model);
        steps.check(&format!("{} for C: what a library lacks", recipe.scene_name()), || {
            ["m4", "m4-soft", "m7"].iter().try_for_each(|word| free(&recipe, word, &ALWAYS))?;
            // Where there is a unit for f32 nothing else has to be called.
            free(&recipe, "m4", &[DOUBLE])
        });
    }
    let levee = Recipe::of(SCENES[1].0, SCENES[1].1);
    steps.check("helpers for f64 are found in a library of f64", || {
        let double = Recipe { scalar: Some("f64".to_owned()), ..levee.clone() };
        match free(&double, "m4", &[DOUBLE]) {
            Err(why) if why.contains(DOUBLE.what) => Ok(()),
            other => Err(format!("not found: {other:?}")),
        }
    });
    steps.check("broken-panic is caught when a library is made", || broken(&levee));
}

/// `Ok` where the library has none of these, and asks for nothing but what C has.
fn free(recipe: &Recipe, word: &str, absences: &[Absence]) -> Result<(), String> {
    let package = Package::bake(recipe, machine(word)?)?;
    let names = Shown::of(&package.library())?;
    let exports =
        EXPORTS.iter().chain(&EXPORTS_WITHIN).map(|own| format!("{}_{own}", package.name));
    // Without its functions the archive shows nothing.
    if let Some(name) = exports.clone().find(|name| !names.shown.contains(name)) {
        return Err(format!("{word}: no {name}"));
    }
    let exports: Vec<_> = exports.collect();
    if let Some(name) = names.shown.iter().find(|name| !exports.contains(name)) {
        return Err(format!("{word}: it shows {name}"));
    }
    if let Some(name) = names.asked.iter().find(|name| !is_of_c(name)) {
        return Err(format!("{word}: it asks for {name}"));
    }
    for absence in absences {
        let all = names.own.iter().chain(&names.shown).chain(&names.asked);
        if let Some(name) = all.into_iter().find(|name| (absence.is)(name)) {
            return Err(format!("{word}: {}: {name}", absence.what));
        }
    }
    Ok(())
}

fn is_of_c(name: &str) -> bool {
    let plain = name.strip_prefix("__aeabi_").unwrap_or(name);
    OF_C.contains(&plain.trim_end_matches(['4', '8']))
}

/// `Ok` where a library that can panic is not made.
fn broken(recipe: &Recipe) -> Result<(), String> {
    let module = recipe.bake()?;
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
