//! The scene parser, and what becomes of a scene that it accepts.

use std::path::Path;
use std::str;

use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::mesh::{Curve, Mesh, Surface};
use signorini_scene::scene::Scene;

use super::bytes;
use super::solved::{self, refused};

/// The text of a scene file.
pub fn scene(data: &[u8]) {
    let Ok(text) = str::from_utf8(data) else { return };
    match read(text) {
        Err(error) => refused(&error),
        Ok(scene) => {
            let kinds = [Cells::Triangles, Cells::Quads, Cells::Mixed];
            let mesh = suited(&scene, grid(1 + (data.len() % 2) as u32, kinds[data.len() % 3]));
            solved::answer(&scene, mesh, bytes::sum(data));
        }
    }
}

/// There is nothing beside the scene that it could extend.
fn read(text: &str) -> Result<Scene> {
    Scene::parse(text, Path::new("/nowhere/hostile.toml"))
}

/// `mesh` with the groups that the scene names: its surfaces by turns, its boundary in stretches.
fn suited(scene: &Scene, mesh: Mesh) -> Mesh {
    let named = |name: &String| (name != "default").then(|| name.clone());
    let surfaces = scene.materials.iter().filter_map(|material| named(&material.name.value));
    let mut surfaces: Vec<_> = surfaces.map(|name| Surface { name, cells: Vec::new() }).collect();
    let curves = scene.boundaries.iter().filter_map(|boundary| named(&boundary.name.value));
    let mut curves: Vec<_> = curves.map(|name| Curve { name, edges: Vec::new() }).collect();
    let parts = surfaces.len().max(1);
    for cell in 0..mesh.cells() {
        if let Some(surface) = surfaces.get_mut(cell % parts) {
            surface.cells.push(cell as u32);
        }
    }
    let boundary: Vec<_> = mesh.curves.iter().flat_map(|curve| &curve.edges).collect();
    let parts = curves.len();
    for (at, &&edge) in boundary.iter().enumerate() {
        if let Some(curve) = curves.get_mut(at * parts / boundary.len()) {
            curve.edges.push(edge);
        }
    }
    curves.iter_mut().for_each(|curve| curve.edges.sort_unstable());
    Mesh { surfaces, curves, ..mesh }
}
