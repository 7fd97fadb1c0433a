//! `cargo xtask results`: meshio and PyVista read the files of a solve and of ticks, in an environment of Python of their own.

use std::path::Path;
use std::process::Command;

use crate::program::signorini;
use crate::python::environment;
use crate::steps::Steps;
use signorini_image::cargo::{root, target_dir};
use signorini_image::toolchain::output;

const REQUIREMENTS: &str = "tests/python/requirements.txt";
const READER: &str = "tests/python/read_back.py";
/// Triangles, quads or both; limits, several materials, curved gaps.
const SCENES: [&str; 4] = ["levee", "slab", "strip", "antiicing"];
const TICKED: &str = "meshes/catalogue/moving-tri.toml";

/// The step.
pub fn run(steps: &mut Steps) {
    steps.check("meshio and PyVista read the results", || {
        let python = environment("environment", &["-r", REQUIREMENTS], &[])?;
        let out = target_dir("python").join("out");
        written(&["tick", TICKED, "--vtu", "--ticks", "5"], &out.join("ticks"))?;
        SCENES.iter().try_for_each(|name| {
            let scene = format!("meshes/scenes/{name}.toml");
            written(&["solve", &scene, "--max-error", "25%"], &out.join("solve"))?;
            let mut read = Command::new(&python);
            read.arg(READER).arg(&out).current_dir(root());
            output(&mut read).map(|said| print!("{name}: {said}"))
        })
    });
}

fn written(words: &[&str], out: &Path) -> Result<(), String> {
    output(signorini(words)?.arg("--out").arg(out)).map(drop)
}
