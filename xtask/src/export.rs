//! Scenes as data for the stages of the kernel.

use std::path::PathBuf;
use std::sync::OnceLock;

use crate::program::scene_data;
use signorini_image::board::{Board, Build};
use signorini_image::cargo::{run as run_cargo, target_dir};
use signorini_image::module::take;
use signorini_image::toolchain::output;

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

/// Builds images of stages for a board, with the scenes that they need; returns their folder.
pub fn stages(board: &Board, bins: &[&str], features: &[&str]) -> Result<PathBuf, String> {
    let (package, scenes) = ("signorini-firmware", &scenes()?);
    let (command, folder) = board.build(Build { package, bins, features, scenes })?;
    run_cargo(command)?;
    Ok(folder)
}

fn write() -> Result<PathBuf, String> {
    let folder = target_dir("firmware").join("scenes");
    for (name, file, scalars) in SCENES {
        for scalar in scalars {
            let fresh = folder.join(format!("{name}_{scalar}.{}.rs", std::process::id()));
            output(scene_data(&["model", file, scalar])?.arg(&fresh))?;
            take(&fresh, &folder.join(format!("{name}_{scalar}.rs")))?;
        }
    }
    Ok(folder)
}
