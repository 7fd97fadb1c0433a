//! Scenes posed on meshes: the standard ones, and those of a text; and values of their inputs.

use std::path::Path;

use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_scene::mesh::{self, Mesh};
use signorini_scene::scene::{Input, Scene};

/// Their names: the membrane is held by contact alone, the pit has no inputs.
pub const SCENES: [&str; 5] = ["levee", "slab", "strip", "membrane", "pit"];

/// A scene of this text on a mesh.
pub fn posed(text: &str, mesh: Mesh) -> Result<Problem> {
    Problem::new(&Scene::parse(text, Path::new("test.toml"))?, mesh)
}

/// The scene of this name.
pub fn standard(name: &str) -> Problem {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../meshes/scenes");
    let scene = Scene::read(&folder.join(format!("{name}.toml"))).expect("a scene");
    let mesh = mesh::read(&scene.mesh.value).expect("a mesh");
    Problem::new(&scene, mesh).expect("a problem")
}

/// A value that f32 holds exactly, so far from an input's default, on the other side of it where that would leave the range.
pub fn moved(input: &Input, by: f64) -> f64 {
    let [there, mirrored] = [by, -by].map(|by| f64::from((input.default + by) as f32));
    if input.refusal(there).is_none() { there } else { mirrored }
}
