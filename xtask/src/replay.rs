//! What `signorini solve --scalar f32` says of a scene is what every board says of it.
//!
//! The boards print what the desk prints; here the desk's figures meet the command's `summary.json`.

use std::fs;

use crate::program::signorini;
use signorini_image::cargo::target_dir;
use signorini_image::toolchain::output;

/// The scenes in the order of the stage `scenes`.
const SCENES: [&str; 4] = ["levee", "slab", "strip", "membrane"];

/// A figure: its key in the summary, and its name in a journal.
const FIGURES: [(&str, &str); 5] = [
    ("sweeps", "sweeps"),
    ("contact_active", "active"),
    ("relaxation", "omega f32"),
    ("algebraic_residual", "residual, scaled f32"),
    ("contact_force", "contact force f32"),
];

/// `Ok` where the command agrees with `journal`, the desk's output of the stage `scenes`.
pub fn compare(journal: &str) -> Result<(), String> {
    let sections: Vec<_> = journal.split("# ").skip(1).collect();
    if sections.len() != 2 * SCENES.len() {
        return Err(format!("{} scenes on the desk", sections.len()));
    }
    for (name, section) in SCENES.iter().zip(sections) {
        let folder = target_dir("firmware").join("solve").join(name);
        let scene = format!("meshes/scenes/{name}.toml");
        output(signorini(&["solve", &scene, "--scalar", "f32", "--out"])?.arg(&folder))?;
        let summary = fs::read_to_string(folder.join("summary.json"));
        let summary = summary.map_err(|error| format!("{}: {error}", folder.display()))?;
        for (key, line) in FIGURES {
            let (command, desk) = (json_number(&summary, key), journal_number(section, line));
            if command.is_none() || command != desk {
                return Err(format!(
                    "{name}: {key} is {command:?} in the summary, {desk:?} on the desk"
                ));
            }
        }
    }
    Ok(())
}

/// The number behind a key of a flat JSON text.
fn json_number(text: &str, key: &str) -> Option<f64> {
    let rest = text.split_once(&format!("\"{key}\": "))?.1;
    rest.split([',', '\n', '}']).next()?.trim().parse().ok()
}

/// The number of a journal's line: a count, or the bits of an f32.
fn journal_number(section: &str, name: &str) -> Option<f64> {
    let number = section.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(' '))?;
    if name.ends_with(" f32") {
        u32::from_str_radix(number, 16).ok().map(|bits| f64::from(f32::from_bits(bits)))
    } else {
        number.parse().ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_found_and_equal() {
        let summary = "{\n  \"sweeps\": 1240,\n  \"contact_force\": 0.00003223364183213562\n}";
        let section = "Levee, f32\nconverged\nsweeps 1240\ncontact force f32 3807329c\n";
        assert_eq!(json_number(summary, "sweeps"), journal_number(section, "sweeps"));
        let force = journal_number(section, "contact force f32");
        assert!(force.is_some());
        assert_eq!(json_number(summary, "contact_force"), force);
        assert_eq!(json_number(summary, "force"), None);
    }
}
