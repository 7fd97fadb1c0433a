//! Scenes and meshes that tests share.

pub mod limited;

use std::path::Path;

use crate::Problem;
use signorini_scene::error::Result;
use signorini_scene::mesh::{Curve, Mesh};
use signorini_scene::scene::Scene;

/// Smooth and exact, with a full tensor and every kind of condition; contact everywhere (u = ψ).
///
/// u = x²y + y² + x³, A = \[2, ½; ½, 1\]: f = −(4y + 14x + 2) and on the sides of (−1, 1) × (0, 1)
/// σ·n = −2.5x² (bottom), 5y + 6.5 (right), 3y − 6.5 (left).
pub const SMOOTH: &str = r#"
mesh = "grid"
material.default.conductivity = ["2", "0.5", "1"]
source.f = "-(4*y + 14*x + 2)"
boundary.dirichlet = { kind = "dirichlet", value = "x^2*y + y^2 + x^3" }
boundary.left = { kind = "robin", coefficient = "2+y", ambient = "y + y^2 - 1 + (3*y - 6.5)/(2+y)" }
boundary.right = { kind = "neumann", flux = "5*y + 6.5" }
boundary.contact = { kind = "contact", gap = "x^3", flux = "-3.5*x^2 - 1" }
exact = { u = "x^2*y + y^2 + x^3", gradient = ["2*x*y + 3*x^2", "x^2 + 2*y"] }
"#;

/// Curved data on two sides of corner cells, a full tensor.
pub const CURVED: &str = r#"
mesh = "grid"
material.default.conductivity = ["2", "0.5", "1"]
source.f = "0"
boundary.default = { kind = "dirichlet", value = "sin(2*x) + y^3 - 0.3*x*y^2" }
boundary.contact = { kind = "contact", gap = "-2 + exp(x)*(1 + x^2)/20" }
"#;

/// A parabola for a gap, all else affine.
pub const PARABOLA: &str = r#"
mesh = "grid"
material.default.conductivity = "1"
source.f = "0"
boundary.default = { kind = "dirichlet", value = "20 + 1e6*y" }
boundary.contact = { kind = "contact", gap = "-x^2" }
"#;

/// Every field has an input, data are curved, A is full, r and x are of both signs.
pub const EVERY_INPUT: &str = r#"
mesh = "grid"
material.default.conductivity = ["2", "0.5", "1"]
source.f = "-(1 + x*y)"
boundary.dirichlet = { kind = "dirichlet", value = "0.3 + 0.1*sin(3*x)" }
boundary.left = { kind = "robin", coefficient = "2+y", ambient = "y - 0.2" }
boundary.right = { kind = "neumann", flux = "0.5*y - 0.2" }
boundary.contact = { kind = "contact", gap = "0.35 - 0.4*x^2 + 0.1*x^3", flux = "-0.1*x^2" }
input.depth = { of = "contact", field = "gap", pattern = "(1 - x)*(0.2 + 0.1*x)*(1+x)" }
input.rain = { of = "contact", field = "flux", pattern = "1 + x", default = 0.1 }
input.level = { of = "dirichlet", field = "value", pattern = "1 + 0.5*x" }
input.wind = { of = "left", field = "ambient", pattern = "1 - y^2" }
input.pull = { of = "right", field = "flux", pattern = "y" }
input.heat = { of = "source", field = "f", pattern = "cos(2*x)" }
output.right = { kind = "flux", of = "right" }
output.top = { kind = "flux", of = "dirichlet" }
output.left = { kind = "flux", of = "left" }
output.force = { kind = "force" }
output.length = { kind = "length", of = "contact" }
output.inside = { kind = "probe", at = [0.21, 0.37] }
output.bound = { kind = "bound" }
output.mean = { kind = "mean", of = "contact" }
"#;

/// The text with parts of it replaced, each of which must be there.
pub fn changed(text: &str, changes: &[(&str, &str)]) -> String {
    changes.iter().fold(text.to_owned(), |text, (part, by)| {
        assert!(text.contains(part), "{part}: {text}");
        text.replace(part, by)
    })
}

/// A wall of conductivity 2, insulated on both sides, between u = `above` on top and a condition below.
pub fn wall(above: &str, below: &str) -> String {
    format!(
        "
mesh = \"grid\"
material.default.conductivity = \"2\"
boundary.dirichlet = {{ kind = \"dirichlet\", value = \"{above}\" }}
boundary.left = {{ kind = \"neumann\", flux = \"0\" }}
boundary.right = {{ kind = \"neumann\", flux = \"0\" }}
boundary.contact = {{ {below} }}
"
    )
}

/// A wall between u = 1 above and air at −1 below, which y = 0 meets in part.
pub fn transfer_wall(coefficient: &str, input: &str) -> String {
    let air = "kind = \"robin\", ambient = \"-1\", coefficient";
    wall("1", &format!("{air} = \"{coefficient}\""))
        + &format!(
            "
input.h = {{ of = \"contact\", field = \"coefficient\", {input} }}
output.heat = {{ kind = \"flux\", of = \"contact\" }}
output.skin = {{ kind = \"mean\", of = \"contact\" }}
"
        )
}

/// Reads a scene from its text.
pub fn scene(text: &str) -> Result<Scene> {
    Scene::parse(text, Path::new("test.toml"))
}

/// A scene on a grid whose sides `left`, `right` and `dirichlet` (the top) are told apart where the
/// scene does so.
pub fn on_grid(text: &str, mesh: Mesh) -> Result<(Scene, Problem)> {
    let scene = scene(text)?;
    let four = scene.boundaries.iter().any(|boundary| boundary.name.value == "left");
    let mesh = if four { with_four_sides(mesh) } else { mesh };
    let problem = Problem::new(&scene, mesh)?;
    Ok((scene, problem))
}

/// Parts the catalogue grid's curve `dirichlet` into the sides of the rectangle.
pub fn with_four_sides(mut mesh: Mesh) -> Mesh {
    let contact = mesh.curves.remove(0);
    let rest = mesh.curves.remove(0).edges;
    let lies =
        |edge: &[u32; 2], x: f64| edge.iter().all(|&vertex| mesh.vertices[vertex as usize][0] == x);
    let left: Vec<_> = rest.iter().copied().filter(|edge| lies(edge, -1.0)).collect();
    let right: Vec<_> = rest.iter().copied().filter(|edge| lies(edge, 1.0)).collect();
    let top = rest.iter().copied().filter(|edge| !lies(edge, -1.0) && !lies(edge, 1.0)).collect();
    let curve = |name: &str, edges| Curve { name: name.to_owned(), edges };
    let sides = [curve("dirichlet", top), curve("left", left), curve("right", right)];
    mesh.curves = [contact].into_iter().chain(sides).collect();
    mesh
}

/// Moves the vertices inside and along the bottom, so that no quad is a parallelogram.
pub fn distorted(mut mesh: Mesh) -> Mesh {
    for (at, [x, y]) in mesh.vertices.iter_mut().enumerate() {
        let (old_x, old_y) = (*x, *y);
        let scatter = (at as f64 * 1.7).sin();
        let inside = |t: f64| (t * (1.0 - t)).max(0.0);
        *x += 0.2 * scatter * inside(0.5 * (1.0 + old_x)) * (1.0 - old_y);
        *y += 0.3 * (scatter + 0.4) * inside(old_y) * (1.0 - old_x * old_x);
    }
    mesh
}

/// Numbers in (−1, 1) without a pattern.
pub fn scatter(seed: usize) -> f64 {
    (seed as f64 * 12.9898 + 0.3).sin() * (seed as f64 * 0.7315 + 1.1).cos()
}
