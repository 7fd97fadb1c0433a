//! Condensed models against the full solver, and their bounds against exact solutions.

mod bound;
mod equality;
mod rejected;

use crate::certify::fixtures::{scene, with_four_sides};
use crate::error::Result;
use crate::mesh::Mesh;
use crate::outputs::outputs;
use crate::problem::Problem;
use crate::scene::Scene;
use crate::solve::{Options, Solution, SolverKind, solve};

/// Every field has an input, data are curved, A is full, r and x are of both signs.
pub(super) const ALL: &str = r#"
mesh = "grid"
[material.default]
conductivity = ["2", "0.5", "1"]
[source]
f = "-(1 + x*y)"
[boundary.dirichlet]
kind = "dirichlet"
value = "0.3 + 0.1*sin(3*x)"
[boundary.left]
kind = "robin"
coefficient = "2+y"
ambient = "y - 0.2"
[boundary.right]
kind = "neumann"
flux = "0.5*y - 0.2"
[boundary.contact]
kind = "contact"
gap = "0.35 - 0.4*x^2 + 0.1*x^3"
flux = "-0.1*x^2"
[input.depth]
of = "contact"
field = "gap"
pattern = "(1 - x)*(0.2 + 0.1*x)*(1+x)"
[input.rain]
of = "contact"
field = "flux"
pattern = "1 + x"
default = 0.1
[input.level]
of = "dirichlet"
field = "value"
pattern = "1 + 0.5*x"
[input.wind]
of = "left"
field = "ambient"
pattern = "1 - y^2"
[input.pull]
of = "right"
field = "flux"
pattern = "y"
[input.heat]
of = "source"
field = "f"
pattern = "cos(2*x)"
[output.right]
kind = "flux"
of = "right"
[output.top]
kind = "flux"
of = "dirichlet"
[output.left]
kind = "flux"
of = "left"
[output.force]
kind = "force"
[output.length]
kind = "length"
of = "contact"
[output.inside]
kind = "probe"
at = [0.21, 0.37]
[output.bound]
kind = "bound"
"#;

/// Numbers in (−1, 1) without a pattern.
pub(super) fn scatter(seed: usize) -> f64 {
    (seed as f64 * 12.9898 + 0.3).sin() * (seed as f64 * 0.7315 + 1.1).cos()
}

/// A scene on a grid.
pub(super) fn on_grid(text: &str, mesh: Mesh) -> Result<(Scene, Problem)> {
    let scene = scene(text)?;
    let four = scene.boundaries.iter().any(|boundary| boundary.name.value == "left");
    let mesh = if four { with_four_sides(mesh) } else { mesh };
    let problem = Problem::new(&scene, mesh)?;
    Ok((scene, problem))
}

/// The full problem at the inputs `p`, solved directly.
pub(super) fn full(
    scene: &Scene,
    problem: &Problem,
    p: &[f64],
) -> Result<(Problem, Solution, Vec<Option<f64>>)> {
    let mut scene = scene.clone();
    scene.inputs.iter_mut().zip(&p[1..]).for_each(|(input, p)| input.default = *p);
    let mut problem = problem.clone();
    problem.set_time(&scene, 0.0)?;
    let solution =
        solve(&scene, &problem, &Options { solver: SolverKind::Direct, ..Options::default() })?;
    let values = outputs(&scene, &problem, &solution)?;
    let names: Vec<String> = match scene.outputs.is_empty() {
        true => vec!["contact_force".to_owned(), "contact_length".to_owned()],
        false => scene.outputs.iter().map(|output| output.name.value.clone()).collect(),
    };
    let values = names.iter().map(|name| values[name]).collect();
    Ok((problem, solution, values))
}
