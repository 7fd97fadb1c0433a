//! Baked arrays through the kernel, against the solver on the same scene.

mod cancellation;
mod compiled;
mod factored;
mod forms;
mod scale;
mod setting;

use signorini_kernel::Error;
use signorini_kernel::error::Array;
use signorini_tolerances::Tolerance;
use signorini_tolerances::bake::{TICK, TICK_NARROW};

use super::{Baked, Controller, source};
use crate::Bakes;
use crate::tests::direct::{Beside, leaves_out_more, to_the_end};
use crate::tests::standard;
use signorini_problem::Problem;
use signorini_problem::fixtures;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_solve::Solution;

/// A gap and a Dirichlet value that inputs bend, a source, given fluxes, varying A and a varying law.
const BENT: &str = r#"
mesh = "grid"
material.default.conductivity = ["2 + x", "0.5", "1"]
source.f = "-1 - x"
boundary.dirichlet = { kind = "dirichlet", value = "x^2" }
boundary.left = { kind = "robin", coefficient = "2 + y", ambient = "y" }
boundary.right = { kind = "neumann", flux = "1 - y" }
boundary.contact = { kind = "contact", gap = "x^3 - 0.3", flux = "-0.5*x^2" }
input.lift = { of = "contact", field = "gap", pattern = "cos(3*x)/5", default = 0.3 }
input.level = { of = "dirichlet", field = "value", pattern = "1 + x^2/2", default = 0.7 }
input.rain = { of = "contact", field = "flux", pattern = "-1 - x" }
input.heat = { of = "source", field = "f", pattern = "1 + y" }
input.inflow = { of = "right", field = "flux", pattern = "y^2" }
input.air = { of = "left", field = "ambient", pattern = "1 - y" }
output.flux = { kind = "flux", of = "dirichlet" }
output.force = { kind = "force" }
output.length = { kind = "length" }
output.probe = { kind = "probe", at = [0.1, 0.4] }
output.bound = { kind = "bound" }
"#;

/// Inputs of BENT.
const STEPS: [&[f64]; 3] = [
    &[0.3, 0.7, 0.0, 0.0, 0.0, 0.0],
    &[-0.5, 1.3, 0.4, -1.0, 0.7, 0.5],
    &[0.1, 0.9, -0.3, 0.5, -0.7, -0.5],
];

/// The setting of quads whose basis is that of their own coordinates.
const NONPARAMETRIC: &str = "[setting]\nelement = \"nonparametric\"\n";

/// Ticks as solves, one after the other and each from a cold start.
fn ticks<R: Bakes>(problem: &Problem, steps: &[&[f64]], allowed: Tolerance) -> Result<()> {
    let cold = steps.iter().map(|step| vec![step.to_vec()]);
    let warm = steps.iter().map(|step| step.to_vec()).collect();
    for steps in cold.chain([warm]) {
        let least = |of: &Solution| 1e-3 * of.largest_flux();
        let is_undefined = |_: &[f64], name: &str| name == "bound";
        let beside = Beside { problem, feature: "contact", steps, least, is_undefined };
        beside.ticks::<R>(allowed, leaves_out_more)?;
    }
    Ok(())
}

#[test]
fn every_kind_of_input_gives_what_the_solver_gives() -> Result<()> {
    let (_, problem) = fixtures::on_grid(BENT, grid(5, Cells::Triangles))?;
    ticks::<f64>(&problem, &STEPS, TICK)?;
    for cells in [Cells::Quads, Cells::Mixed] {
        let (_, problem) = fixtures::on_grid(BENT, grid(5, cells))?;
        ticks::<f64>(&problem, &STEPS, TICK)?;
    }
    Ok(())
}

/// K and the values at vertices are the element's: both come from the host's arrays.
#[test]
fn nonparametric_quads() -> Result<()> {
    let text = format!("{BENT}{NONPARAMETRIC}");
    let mesh = fixtures::distorted(grid(5, Cells::Quads));
    let (_, problem) = fixtures::on_grid(&text, mesh)?;
    ticks::<f64>(&problem, &STEPS[..2], TICK)?;
    let baked = Baked::<f64>::new(&problem)?;
    assert_eq!(baked.distortions.len(), problem.mesh.quads.len());
    assert!(source(&baked).contains("distortions: &QUAD_DISTORTIONS"));
    Ok(())
}

#[test]
fn standard_scenes_in_both_scalars() -> Result<()> {
    let problem = standard("strip", |_| ());
    let steps: [&[f64]; 2] = [&[0.0], &[0.1]];
    ticks::<f64>(&problem, &steps, TICK)?;
    ticks::<f32>(&problem, &steps, TICK_NARROW)
}

#[test]
fn a_load_that_depends_on_time_is_refused_by_its_key() -> Result<()> {
    let text = BENT.replace("flux = \"1 - y\"", "flux = \"1 - t\"");
    let (_, problem) = fixtures::on_grid(&text, grid(2, Cells::Triangles))?;
    let error = Baked::<f64>::new(&problem).expect_err("no clock");
    assert!(error.to_string().contains("boundary.right.flux"), "{error}");
    Ok(())
}

#[test]
fn data_that_meet_wrongly_are_refused() -> Result<()> {
    let right = "boundary.right = { kind = \"neumann\"";
    let turned = [
        ("boundary.dirichlet = ", "boundary.right = "),
        (right, "boundary.dirichlet = { kind = \"neumann\""),
        ("of = \"right\"", "of = \"top\""),
        ("of = \"dirichlet\"", "of = \"right\""),
        ("of = \"top\"", "of = \"dirichlet\""),
    ];
    let text = fixtures::changed(BENT, &turned);
    let (_, problem) = fixtures::on_grid(&text, grid(3, Cells::Triangles))?;
    let baked = Baked::<f64>::new(&problem)?;
    assert_eq!(baked.corners.len(), 1);
    let mut controller = Controller::<f64>::new(&baked);
    let mut bound = |inputs: &[f64]| {
        controller.tick_within(inputs, to_the_end()).map(|(outputs, _)| outputs[4])
    };
    assert!(bound(STEPS[0]).expect("a tick").is_finite());
    // u_D = 1 − 1.5 below ψ = 0.7 − 0.2 at (1, 0).
    assert_eq!(bound(&[0.3, -1.0, 0.0, 0.0, 0.0, 0.0]), Err(Error::Excluded { at: 0 }));
    assert_eq!(bound(&[f64::NAN; 6]), Err(Error::NotFinite { of: Array::Inputs, at: 0 }));
    assert!(bound(STEPS[0]).expect("a tick").is_finite());
    Ok(())
}

#[test]
fn a_part_that_contact_alone_holds_is_refused() -> Result<()> {
    let problem = standard("membrane", |_| ());
    let error = Baked::<f32>::new(&problem).expect_err("no way out");
    assert!(error.to_string().contains("contact alone holds"), "{error}");
    Ok(())
}

#[test]
fn the_text_holds_every_number_once_more() -> Result<()> {
    let problem = standard("strip", |_| ());
    let baked = Baked::<f32>::new(&problem)?;
    let text = source(&baked);
    for number in baked.stiffness_of_triangles.iter().flatten() {
        assert!(text.contains(&format!("{number:?}")), "{number}");
    }
    let features = text.lines().find(|line| line.contains("features = [")).expect("a line");
    let all = "[\"triangles\", \"quads\", \"contact\", \"curved\"] } # ";
    assert!(features.contains(all), "{features}");
    assert!(!text.contains("4294967295") && !text.contains("inf") && !text.contains("NaN"));
    Ok(())
}
