//! The standard scenes on their meshes, and values of their inputs.

use std::path::Path;

use signorini_problem::Problem;
use signorini_scene::mesh;
use signorini_scene::scene::{Input, Scene};

/// Their names: the membrane is held by contact alone, the pit has no inputs.
pub const SCENES: [&str; 5] = ["levee", "slab", "strip", "membrane", "pit"];

/// The scene of this name.
pub fn standard(name: &str) -> (Scene, Problem) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../meshes/scenes");
    let scene = Scene::read(&folder.join(format!("{name}.toml"))).expect("a scene");
    let mesh = mesh::read(&scene.mesh.value).expect("a mesh");
    let problem = Problem::new(&scene, mesh).expect("a problem");
    (scene, problem)
}

/// A value that f32 holds exactly, so far from an input's default, on the other side of it where that would leave the range.
pub fn moved(input: &Input, by: f64) -> f64 {
    let [there, mirrored] = [by, -by].map(|by| f64::from((input.default + by) as f32));
    if input.refusal(there).is_none() { there } else { mirrored }
}
