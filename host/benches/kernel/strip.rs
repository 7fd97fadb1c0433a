//! The problems that are timed: the catalogue's grids, u_D = r^(3/2) cos(3θ/2), ψ = 0: contact where x < 0,
//! about half of the bottom.

use std::cell::OnceCell;
use std::path::Path;

use criterion::Bencher;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, Parts, Problem};
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::scene::Scene;

const SCENE: &str = r#"
mesh = "none.msh"
material.default.conductivity = "1"
source.f = "-0.1"
boundary.contact = { kind = "contact" }
boundary.dirichlet = { kind = "dirichlet", value = "0" }
input.rise = { of = "dirichlet", field = "value", pattern = "(x^2 + y^2)^0.75 * cos(1.5*atan2(y, x))", default = 1.0 }
"#;

/// The scene with u_D that is `factor` times its default.
pub fn scene(factor: f64) -> Scene {
    let mut scene = Scene::parse(SCENE, Path::new("strip.toml")).expect("the scene is well-formed");
    scene.inputs[0].default *= factor;
    scene
}

/// A stage in one scalar.
pub type Stage = fn(&mut Bencher, &Strip);

/// A grid of 2n × n squares, with its problem as soon as it is needed.
pub struct Strip {
    pub n: u32,
    pub cells: Cells,
    problem: OnceCell<Problem>,
}

impl Strip {
    pub fn new(n: u32, cells: Cells) -> Self {
        Self { n, cells, problem: OnceCell::new() }
    }

    pub fn problem(&self) -> &Problem {
        self.problem.get_or_init(|| self.raised(1.0))
    }

    /// The problem with u_D times `factor`.
    pub fn raised(&self, factor: f64) -> Problem {
        let mesh = grid(self.n, self.cells);
        Problem::new(&scene(factor), mesh).expect("the scene fits the mesh")
    }

    pub fn assembled<R: Scalar>(&self) -> Assembled<'_, R> {
        Assembled::new(self.problem()).expect("the scalar holds the problem")
    }

    pub fn parts(&self) -> Parts {
        Parts::examine(self.problem()).expect("D holds the strip")
    }

    /// Edges not on the Dirichlet boundary: sides and diagonals of squares without the 4n at the top and at
    /// both ends.
    pub fn unknowns(&self) -> usize {
        let n = self.n as usize;
        let diagonals = match self.cells {
            Cells::Triangles => 2 * n * n,
            Cells::Mixed => n * n,
            Cells::Quads => 0,
        };
        2 * n * (n + 1) + n * (2 * n + 1) + diagonals - 4 * n
    }
}
