//! The scenes of the firmware, as the host's exporter writes them.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use signorini_image::cargo::{cargo, run, target_dir};

/// Name, scene file and scalars.
const SCENES: [(&str, &str, &[&str]); 5] = [
    ("levee", "meshes/scenes/levee.toml", &["f32", "f64"]),
    ("slab", "meshes/scenes/slab.toml", &["f32", "f64"]),
    ("strip", "meshes/scenes/strip.toml", &["f32", "f64"]),
    ("membrane", "meshes/scenes/membrane.toml", &["f32", "f64"]),
    ("linear", "tests/firmware/scenes/linear.toml", &["f32"]),
];

/// Writes all scenes, once a run; returns their folder.
pub fn scenes() -> Result<PathBuf, String> {
    static DONE: OnceLock<Result<PathBuf, String>> = OnceLock::new();
    DONE.get_or_init(write).clone()
}

fn write() -> Result<PathBuf, String> {
    let folder = target_dir("firmware").join("scenes");
    for (name, file, scalars) in SCENES {
        for scalar in scalars {
            let fresh = folder.join(format!("{name}_{scalar}.{}.rs", std::process::id()));
            let mut command =
                cargo(&["run", "--quiet", "--locked", "--package", "signorini", "--"]);
            command.args(["export", file, "--scalar", scalar, "--output"]).arg(&fresh);
            run(command)?;
            take(&fresh, &folder.join(format!("{name}_{scalar}.rs")))?;
        }
    }
    Ok(folder)
}

/// Puts `fresh` in the place of `kept`, unless they are equal: images are then not built anew.
pub fn take(fresh: &Path, kept: &Path) -> Result<(), String> {
    let equal = fs::read(fresh).ok() == fs::read(kept).ok();
    let done = if equal { fs::remove_file(fresh) } else { fs::rename(fresh, kept) };
    done.map_err(|error| format!("{}: {error}", kept.display()))
}
