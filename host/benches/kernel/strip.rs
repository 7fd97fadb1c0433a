//! The problem that is timed: triangles on the left, quads on the right, contact at the bottom.
//!
//! ```text
//!   (−1, 1) ┌───────────┬───────────┐ (1, 1)     2n × n squares; u_D = r^(3/2) cos(3θ/2), ψ = 0:
//!           │ triangles │   quads   │            contact where x < 0, about half of the bottom
//!   (−1, 0) └───────────┴───────────┘ (1, 0)
//! ```

use std::path::Path;

use signorini_host::mesh::{Curve, Mesh};
use signorini_host::problem::Problem;
use signorini_host::scene::Scene;

const SCENE: &str = r#"
mesh = "none.msh"
[material.default]
conductivity = "1"
[source]
f = "-0.1"
[boundary.bottom]
kind = "contact"
[boundary.default]
kind = "dirichlet"
value = "(x^2 + y^2)^0.75 * cos(1.5*atan2(y, x))"
"#;

/// The problem on 2n × n squares.
pub fn problem(n: u32) -> Problem {
    let scene = Scene::parse(SCENE, Path::new("strip.toml")).expect("the scene is well-formed");
    Problem::new(&scene, mesh(n)).expect("the scene fits the mesh")
}

/// Edges not on the Dirichlet boundary: sides of squares and diagonals of the left half, without the
/// 4n at the top and at both ends.
pub fn unknowns(n: u32) -> usize {
    let n = n as usize;
    2 * n * (n + 1) + n * (2 * n + 1) + n * n - 4 * n
}

fn mesh(n: u32) -> Mesh {
    let vertex = |i: u32, j: u32| j * (2 * n + 1) + i;
    let place = |k: u32| f64::from(k) / f64::from(n);
    let mut mesh = Mesh::default();
    for j in 0..=n {
        mesh.vertices.extend((0..=2 * n).map(|i| [place(i) - 1.0, place(j)]));
    }
    for (i, j) in (0..n).flat_map(|j| (0..2 * n).map(move |i| (i, j))) {
        let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
        if i < n {
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        } else {
            mesh.quads.push([a, b, c, d]);
        }
    }
    let edges = (0..2 * n).map(|i| [vertex(i, 0), vertex(i + 1, 0)]).collect();
    mesh.curves.push(Curve { name: "bottom".to_owned(), edges });
    mesh
}
