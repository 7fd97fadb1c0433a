//! The problem that is timed: the catalogue's grid, triangles and quads in turn, u_D = r^(3/2) cos(3θ/2),
//! ψ = 0: contact where x < 0, about half of the bottom.

use std::path::Path;

use signorini_host::mesh::structured::{Cells, grid};
use signorini_host::problem::Problem;
use signorini_host::scene::Scene;

const SCENE: &str = r#"
mesh = "none.msh"
[material.default]
conductivity = "1"
[source]
f = "-0.1"
[boundary.contact]
kind = "contact"
[boundary.default]
kind = "dirichlet"
value = "(x^2 + y^2)^0.75 * cos(1.5*atan2(y, x))"
"#;

/// The problem on 2n × n squares.
pub fn problem(n: u32) -> Problem {
    let scene = Scene::parse(SCENE, Path::new("strip.toml")).expect("the scene is well-formed");
    Problem::new(&scene, grid(n, Cells::Mixed)).expect("the scene fits the mesh")
}

/// Edges not on the Dirichlet boundary: sides of squares and diagonals of every other square, without the
/// 4n at the top and at both ends.
pub fn unknowns(n: u32) -> usize {
    let n = n as usize;
    2 * n * (n + 1) + n * (2 * n + 1) + n * n - 4 * n
}
