//! The generated text: no warnings, and the bits of the same arrays on this machine.

use super::{Baked, Controller, Work, source};
use crate::Bakes;
use crate::choice::{Choice, Model, Wanted};
use crate::compiled::printed;
use crate::module_api::ModuleApi;
use crate::tests::{self, FIRMWARE, powers};
use signorini_condense::condense;
use signorini_problem::Problem;
use signorini_problem::fixtures::{changed, on_grid};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::scene::units::Units;
use signorini_scene::setting::{ModelKind, Omega, Setting, Start};

/// Dirichlet values above the gap at both ends, every kind of output, names that are no identifiers.
const NAMES: &str = r#"
title = "a \"title\" of\nlines [m] <b> */"
mesh = "grid"
material.default.conductivity = ["2", "0.5", "1"]
source.f = "-1 - x"
boundary."dirichlet" = { kind = "dirichlet", value = "0.1*x" }
boundary.left = { kind = "dirichlet", value = "0.1*x" }
boundary."right" = { kind = "robin", coefficient = "2", ambient = "y" }
boundary.contact = { kind = "contact", gap = "-0.3 + 0.1*x^2" }
input.type = { of = "contact", field = "gap", pattern = "cos(3*x)/5", default = -0.3 }
input."größe \"q\"\n`code`" = { of = "right", field = "ambient", pattern = "1", default = 0.7 }
input.inputs = { of = "source", field = "f", pattern = "1", default = 0.5 }
input.memory = { of = "source", field = "f", pattern = "x", default = 1e-40 }
output.self = { kind = "flux", of = "dirichlet" }
output."x \\ y" = { kind = "force", of = "contact" }
output."X-Y" = { kind = "length" }
output.load = { kind = "probe", at = [0.1, 0.4] }
output."∫" = { kind = "bound" }
"#;

/// Contact alone holds it, no inputs, no outputs.
const FLOATING: &str = r#"
mesh = "grid"
material.default.conductivity = "1"
boundary.contact = { kind = "contact" }
boundary.dirichlet = { kind = "neumann", flux = "-1 - x/2" }
"#;

/// Nothing touches.
const LINEAR: &str = r#"
mesh = "grid"
material.default.conductivity = "1"
boundary.default = { kind = "dirichlet", value = "x*y" }
input.heat = { of = "source", field = "f", pattern = "1", default = 1.0 }
output.inside = { kind = "probe", at = [0.1, 0.4] }
output.bound = { kind = "bound" }
"#;

/// Both ends of a flux change; another has no lower end.
const LIMITED: &str = r#"
mesh = "grid"
material.default.conductivity = "1"
boundary.dirichlet = { kind = "robin", coefficient = "4", ambient = "-1" }
boundary.left = { kind = "contact", gap = "-1/9", flux = "-inf", limit = "0" }
boundary.right = { kind = "dirichlet", value = "0" }
boundary.contact = { kind = "contact", gap = "x/9", flux = "-0.2", limit = "0" }
input.air = { of = "dirichlet", field = "ambient", pattern = "1", default = -0.5 }
input.supply = { of = "contact", field = "limit", pattern = "0.3", default = 1.0 }
input.least = { of = "contact", field = "flux", pattern = "0.1", default = -0.2 }
output.power = { kind = "force", of = "contact" }
output.short = { kind = "saturated", of = "contact" }
output.bound = { kind = "bound" }
"#;

fn same_bits<R: Bakes>(text: &str, work: Work, certified: bool) -> Result<()> {
    let (_, problem) = on_grid(text, grid(3, Cells::Mixed))?;
    let condensate = condense(&problem)?;
    let baked = Baked::<R>::new(&condensate, work, certified).expect("numbers in range");
    assert_eq!(baked.without_bound().is_none(), certified);
    same_bits_of(&problem, &baked);
    Ok(())
}

/// In a cold and two warm ticks.
fn same_bits_of<R: Bakes>(problem: &Problem, baked: &Baked<R>) {
    let inputs = &problem.scene.inputs;
    let times = |factor: f64| inputs.iter().map(|input| factor * input.default).collect();
    let mut controller = Controller::new(baked);
    let tick = |inputs: &[R]| controller.tick(inputs).map(|(outputs, _)| outputs);
    let text = source(&ModuleApi::new(problem), baked);
    let lines = tests::same_bits(problem, text, &[1.0, -0.5, 0.25].map(times), tick);
    assert!(lines.iter().all(|line| line.starts_with("Ok(")), "{lines:?}");
    assert!(inputs.is_empty() || lines[0] != lines[1]);
}

const PIVOTS: Work = Work { pivots: Some(40), sweeps: 4 };
const SWEEPS: Work = Work { pivots: None, sweeps: 6 };

#[test]
fn modules_have_the_same_bits() -> Result<()> {
    let of_gap = [
        ("\"limit\", pattern = \"0.3\"", "\"gap\", pattern = \"(1 + x)/99\""),
        ("\"flux\", pattern = \"0.1\"", "\"gap\", pattern = \"(1 + x)/9\""),
        ("flux = \"-0.2\", limit = \"0\"", "flux = \"-0.2\", limit = \"0.4\""),
    ];
    for text in [NAMES, LINEAR, LIMITED, &changed(LIMITED, &of_gap)] {
        same_bits::<f32>(text, PIVOTS, true)?;
        same_bits::<f64>(text, SWEEPS, true)?;
    }
    same_bits::<f64>(NAMES, PIVOTS, false)?;
    same_bits::<f32>(FLOATING, SWEEPS, true)?;
    same_bits::<f64>(FLOATING, PIVOTS, true)
}

#[test]
fn with_a_setting() -> Result<()> {
    let (scene, problem) = on_grid(NAMES, grid(3, Cells::Mixed))?;
    let condensate = condense(&problem)?;
    let setting = Setting {
        sweeps: Some(6),
        omega: Omega::Fixed(1.2),
        start: Start::Cold,
        ..Setting::default()
    };
    for work in [SWEEPS, PIVOTS] {
        let baked = Baked::<f32>::new(&condensate, work, true).expect("numbers in range");
        let baked = baked.with_setting(&setting);
        same_bits_of(&problem, &baked);
        let mut controller = Controller::new(&baked);
        let defaults: Vec<_> = scene.inputs.iter().map(|input| input.default as f32).collect();
        let moved: Vec<_> = defaults.iter().map(|value| -value).collect();
        let [first, other, again] =
            [&defaults, &moved, &defaults].map(|inputs| controller.tick(inputs).expect("a tick"));
        assert_eq!(first, again);
        assert!(work != SWEEPS || other.1.sweeps == 6);
    }
    Ok(())
}

#[test]
fn a_firmware_need_not_know_the_model() -> Result<()> {
    // An exact tick in which no edge changes sides needs no time for exchanges.
    let linear = Work { pivots: None, sweeps: 0 };
    for (text, work, ended) in
        [(NAMES, PIVOTS, "Exact"), (NAMES, SWEEPS, "OutOfTime"), (LINEAR, linear, "Exact")]
    {
        let (_, problem) = on_grid(text, grid(3, Cells::Mixed))?;
        let condensate = condense(&problem)?;
        let baked = Baked::<f32>::new(&condensate, work, true).expect("numbers in range");
        let text = source(&ModuleApi::new(&problem), &baked) + FIRMWARE;
        let expected = format!("true [true, true, true] {ended} true\n");
        assert_eq!(printed(&text), expected, "{work:?}");
    }
    Ok(())
}

/// Both ends are Dirichlet corners.
#[test]
fn the_names_scene_has_corners() -> Result<()> {
    let (_, problem) = on_grid(NAMES, grid(3, Cells::Mixed))?;
    let form = condense(&problem)?.certificate.expect("a bound");
    assert_eq!(form.corners.len(), 1);
    Ok(())
}

/// NAMES with data that many times as large.
fn problem_in(units: Units) -> Result<Problem> {
    let (scene, problem) = on_grid(NAMES, grid(3, Cells::Mixed))?;
    Problem::new(&units.inverse().scene(&scene), problem.mesh)
}

/// Flux, force, length, probe and bound, in the units that NAMES has.
fn outputs_in<R: Bakes>(units: Units) -> Result<Vec<f64>> {
    let problem = problem_in(units)?;
    let baked = Baked::<R>::new(&condense(&problem)?, PIVOTS, true).expect("in range");
    let inputs = [0.3, -0.7, 0.5, 0.0].map(R::narrow);
    let (outputs, _) = Controller::new(&baked).tick(&inputs).expect("a tick");
    let quantities = problem.scene.outputs.iter().map(|output| units.of_output(output.quantity));
    Ok(outputs.iter().zip(quantities).map(|(output, unit)| output.wide() / unit).collect())
}

/// Condensed models have a unit of energy: squares may leave the range as long as the answers are within it.
#[test]
fn other_units_change_no_digit() -> Result<()> {
    let near = outputs_in::<f32>(Units::default())?;
    assert!(near[1] > 0.0 && near[2] > 0.0, "{near:?}");
    for units in [powers(0, -100), powers(0, 100), powers(-60, 0), powers(60, 40)] {
        assert_eq!(outputs_in::<f32>(units)?, near, "{units:?}");
    }
    let near = outputs_in::<f64>(Units::default())?;
    for units in [powers(-400, 200), powers(400, -400)] {
        assert_eq!(outputs_in::<f64>(units)?, near, "{units:?}");
    }
    Ok(())
}

#[test]
fn what_is_too_far_from_1_is_not_condensed() -> Result<()> {
    let problem = problem_in(powers(-400, -200))?;
    let choice = |model| Choice::<f64>::new(&problem, Wanted { model, ..Wanted::default() });
    let refused = choice(Some(ModelKind::Condensed)).expect_err("underflow");
    assert!(refused.to_string().contains("fluxes are near 1e-181, which f64"), "{refused}");
    let other = choice(None)?;
    assert!(matches!(other.candidate().model, Model::Full(_)));
    assert!(other.excluded[0].contains("fluxes are near"), "{:?}", other.excluded);
    Ok(())
}
