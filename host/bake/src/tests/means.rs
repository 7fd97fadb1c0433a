//! Means of u over boundaries: of an affine u they are known, in every model and scalar.

use super::exact;
use crate::{Bakes, condensed, full};
use signorini_device::tick::Limits;
use signorini_problem::Problem;
use signorini_problem::fixtures::{distorted, on_grid};
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_solve::outputs::outputs;
use signorini_solve::{Options, ScalarKind, SolverKind, solve};
use signorini_tolerances::Tolerance;
use signorini_tolerances::bake::{MEANS, MEANS_NARROW};

/// u = 1 + 2x + y on (−1, 1) × (0, 1), moved as a whole by `level`: open, or pressed against a gap that it has itself.
fn text(gap: &str, level: f64) -> String {
    let mut text = format!(
        "
mesh = \"grid\"
material.default.conductivity = \"1\"
boundary.dirichlet = {{ kind = \"dirichlet\", value = \"2 + 2*x\" }}
boundary.left = {{ kind = \"neumann\", flux = \"-2\" }}
boundary.right = {{ kind = \"robin\", coefficient = \"3\", ambient = \"3 + y + 2/3\" }}
boundary.contact = {{ kind = \"contact\", gap = \"{gap}\", flux = \"-1\" }}
input.level = {{ of = \"dirichlet\", field = \"value\", pattern = \"1\", default = {level} }}
input.outside = {{ of = \"right\", field = \"ambient\", pattern = \"1\", default = {level} }}
"
    );
    for name in NAMES {
        text += &format!("[output.{name}]\nkind = \"mean\"\nof = \"{name}\"\n");
    }
    text
}

const NAMES: [&str; 4] = ["left", "right", "contact", "dirichlet"];

/// By hand; the height of the sides is 1, their mean y is ½.
const MEAN: [f64; 4] = [-0.5, 3.5, 1.0, 2.0];

fn check(what: &str, found: &[f64], level: f64, allowed: Tolerance) {
    assert_eq!(found.len(), NAMES.len());
    for ((name, mean), found) in NAMES.iter().zip(MEAN).zip(found) {
        allowed.check(format_args!("{what}, {name}"), found - (mean + level));
    }
}

fn solved(what: &str, problem: &Problem, level: f64) {
    let ways = [
        (SolverKind::Kernel, ScalarKind::F64, MEANS),
        (SolverKind::Kernel, ScalarKind::F32, MEANS_NARROW),
        (SolverKind::Direct, ScalarKind::F64, MEANS),
    ];
    for (solver, scalar, allowed) in ways {
        let options = Options { solver, scalar, tolerance: Some(1e-14), ..Options::default() };
        let solution = solve(problem, &options).expect("an answer");
        let values = outputs(problem, &solution).expect("outputs");
        let values = NAMES.map(|name| values[name].expect("a value"));
        check(&format!("{what}, {solver:?}, {scalar:?}"), &values, level, allowed);
    }
}

fn baked<R: Bakes>(what: &str, problem: &Problem, level: f64, allowed: Tolerance) {
    let small = exact::<R>(problem).expect("a condensed model");
    let inputs = [R::narrow(level); 2];
    let (of_small, _) = condensed::Controller::new(&small).tick(&inputs).expect("a tick");
    let large = full::Baked::<R>::new(problem).expect("a full model");
    let limits = Limits { sweeps: 20_000, share: R::ZERO, error: R::ZERO };
    let (of_large, _) = full::Controller::new(&large).tick_within(&inputs, limits).expect("a tick");
    for (model, values) in [("condensed", of_small), ("full", of_large)] {
        let values: Vec<_> = values.iter().map(|value| value.wide()).collect();
        check(&format!("{what}, {model}, {}", R::NAME), &values, level, allowed);
    }
}

#[test]
fn of_an_affine_u_in_every_model() {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        for (gap, level) in [("-10", 0.0), ("-10", -1.5), ("1 + 2*x", 0.0)] {
            let mesh = match cells {
                Cells::Triangles => distorted(grid(3, cells)),
                _ => grid(3, cells),
            };
            let (_, problem) = on_grid(&text(gap, level), mesh).expect("a sound scene");
            let what = format!("{cells:?}, gap {gap}, level {level}");
            solved(&what, &problem, level);
            baked::<f64>(&what, &problem, level, MEANS);
            baked::<f32>(&what, &problem, level, MEANS_NARROW);
        }
    }
}
