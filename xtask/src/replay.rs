//! The figures that `signorini solve --scalar f32` tells of a scene are those of every board.
//!
//! The boards print what the desk prints; here the desk's figures meet the command's `summary.json`.

use serde_json::Value;

use crate::program::signorini;
use signorini_image::cargo::target_dir;
use signorini_image::files;
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
        let summary = files::text(&folder.join("summary.json"))?;
        let summary: Value = serde_json::from_str(&summary).map_err(|error| error.to_string())?;
        for (key, line) in FIGURES {
            let (command, desk) = (summary[key].as_f64(), journal_number(section, line));
            if command.is_none() || command != desk {
                return Err(format!(
                    "{name}: {key} is {command:?} in the summary, {desk:?} on the desk"
                ));
            }
        }
    }
    Ok(())
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
    fn figures_are_found() {
        let section = "Levee, f32\nconverged\nsweeps 1240\ncontact force f32 3807329c\n";
        assert_eq!(journal_number(section, "sweeps"), Some(1240.0));
        let force = journal_number(section, "contact force f32");
        assert_eq!(force, Some(0.00003223364183213562));
        assert_eq!(journal_number(section, "force"), None);
    }
}
