//! Scenes far from 1: the module's answers are those of the same scene near 1, in other units.

use signorini_device::tick::{Ended, Limits, Report};
use signorini_kernel::Real;
use signorini_tolerances::bake::WITHOUT_UNITS;

use super::{BENT, Baked, Controller, fixtures, source, to_the_end};
use crate::Bakes;
use crate::compiled::printed;
use crate::module_api::ModuleApi;
use crate::tests::powers;
use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::scene::units::Units;
use signorini_scene::setting::{Precision, Setting};
use signorini_solve::{Scaled, choose_for_inputs};

/// Inputs at which some of the contact is active.
const INPUTS: [f64; 6] = [0.6, 0.2, 0.1, -0.2, 0.3, 0.4];
/// The inputs of BENT.
const NEAR: Units = Units { u: 1.0, conductivity: 1.0, zero: 0.0 };

/// BENT with data that many times as large. The inputs are as they were: their patterns take it.
fn bent(units: Units) -> Result<Problem> {
    let (scene, problem) = fixtures::on_grid(BENT, grid(4, Cells::Mixed))?;
    Problem::new(&units.inverse().scene(&scene), problem.mesh)
}

type Found<R> = (Vec<R>, Report<R>);

fn tick<R: Bakes>(baked: &Baked<R>, limits: Limits<R>) -> Found<R> {
    let mut controller = Controller::<R>::new(baked);
    controller.tick_within(&INPUTS.map(R::narrow), limits).expect("a tick")
}

fn baked<R: Bakes>(units: Units) -> Result<Baked<R>> {
    Baked::new(&bent(units)?)
}

/// Flux, force, length, probe and bound, and what the report has of them.
fn numbers<R: Bakes>((outputs, report): &Found<R>) -> Vec<f64> {
    let of = report.verdict.certificate().expect("a bound");
    let of_report =
        [report.figures.residual, report.figures.force, of.duality_gap, of.rounding, of.total];
    outputs.iter().chain(&of_report).map(|number| number.wide()).collect()
}

fn factored<R: Bakes>(units: Units) -> Result<Baked<R>> {
    let problem = bent(units)?;
    let scaled = Scaled::new(&problem, choose_for_inputs(&problem)?)?;
    Baked::of_scaled(&scaled)?.with_factor(scaled.problem())
}

fn change_nothing<R: Bakes>(baked: fn(Units) -> Result<Baked<R>>, all: &[Units]) -> Result<()> {
    let near = tick(&baked(NEAR)?, to_the_end());
    assert!(near.1.active > 0 && near.1.active < 8, "{near:?}");
    for units in all {
        let far = baked(*units)?;
        assert!(far.units() != NEAR);
        let (flux, energy) = (units.flux(), units.energy());
        let times = [flux, flux, 1.0, units.u, energy, units.u, flux, energy, energy, energy];
        let expected = numbers(&near).into_iter().zip(times).map(|(x, unit)| x * unit);
        let found = tick(&far, to_the_end());
        assert_eq!(numbers(&found), expected.collect::<Vec<_>>(), "{units:?}");
        assert_eq!(found.1.sweeps, near.1.sweeps);
    }
    Ok(())
}

#[test]
fn other_units_change_no_digit() -> Result<()> {
    let all = [powers(0, -100), powers(0, 100), powers(-60, -40), powers(90, -90), powers(50, 50)];
    let wider = [powers(-500, 300), powers(300, -400)];
    change_nothing::<f32>(baked, &all)?;
    change_nothing::<f32>(factored, &all)?;
    change_nothing::<f64>(baked, &wider)?;
    change_nothing::<f64>(factored, &wider)
}

/// What this is for: near 1e−15 the bound of the same module without units is below the right one, and with it
/// the tick ends too early.
#[test]
fn without_units_f32_is_lost() -> Result<()> {
    let near = numbers(&tick(&baked::<f32>(NEAR)?, to_the_end()));
    let bound = |k| -> Result<f64> {
        let problem = bent(powers(0, k))?;
        let baked = Baked::<f32>::in_its_units(&problem, ModuleApi::new(&problem))?;
        let found = numbers(&tick(&baked, to_the_end()));
        Ok(found[4] / powers(0, k).energy() / near[4])
    };
    WITHOUT_UNITS.check("at 2⁻⁴⁰", bound(-40)? - 1.0);
    let found = [bound(-50)?, bound(-56)?];
    assert!(found[0] < 0.95 && found[1] < 0.9, "{found:?}");
    Ok(())
}

/// The text and this machine agree on outputs and report; a scene near 1 has no units.
#[test]
fn the_text_has_the_same_units() -> Result<()> {
    assert!(source(&baked::<f32>(NEAR)?).contains("units: None"));
    let baked = baked::<f32>(powers(-60, -41))?;
    let limits = Limits { error: 1e-20, ..baked.how.limits };
    let mut controller = Controller::<f32>::new(&baked);
    let inputs = INPUTS.map(f32::narrow);
    let (outputs, report) = controller.tick_within(&inputs, limits).expect("a tick");
    let expected = (outputs, report.with(()));
    let main = format!(
        "
fn main() {{
    let limits = Limits {{ error: 1e-20, ..LIMITS }};
    let inputs = Inputs::from_array({inputs:?});
    let mut controller = Box::new(Controller::new());
    let answer = controller.tick_within(inputs, limits, &mut Deadline::never()).unwrap();
    println!(\"{{:?}}\", (answer.outputs.to_array(), answer.report));
}}
"
    );
    assert_eq!(printed(&(source(&baked) + &main)), format!("{expected:?}\n"));
    Ok(())
}

#[test]
fn limits_are_in_the_units_of_the_scene() -> Result<()> {
    for units in [powers(0, -100), powers(20, 60)] {
        let baked = baked::<f32>(units)?;
        let (_, report) = tick(&baked, to_the_end());
        let best = report.verdict.certificate().expect("a bound").total;
        let limits = Limits { error: 1.5 * best, share: 0.0, sweeps: 100_000 };
        let (_, early) = tick(&baked, limits);
        let found = early.verdict.certificate().expect("a bound").total;
        assert!(early.ended == Ended::Accurate && found > best && found <= 1.5 * best, "{early:?}");
    }
    Ok(())
}

/// `solve` with a setting runs the module and reads its arrays.
#[test]
fn fields_are_in_the_units_of_the_scene() -> Result<()> {
    let solved = |units| {
        let setting = Setting { scalar: Some(Precision::F32), ..Setting::default() };
        signorini_session::solve(&bent(units)?.with_setting(Some(setting)))
    };
    let (near, units) = (solved(NEAR)?, powers(-60, -40));
    let far = solved(units)?;
    let times = |numbers: &[f64], unit| numbers.iter().map(|x| x * unit).collect::<Vec<_>>();
    assert_eq!(far.u, times(&near.u, units.u));
    assert_eq!(far.flux, times(&near.flux, units.flux()));
    assert_eq!(far.certified.vertices, times(&near.certified.vertices, units.u));
    assert_eq!(far.certified.bubbles, times(&near.certified.bubbles, units.u));
    assert_eq!(far.contact_active, near.contact_active);
    assert_eq!(far.contact_length, near.contact_length);
    assert_eq!(far.algebraic_residual, near.algebraic_residual);
    Ok(())
}

#[test]
fn answers_that_the_scalar_cannot_hold_are_refused() -> Result<()> {
    for (units, what) in [
        (powers(-120, 0), "u is near 1e-36, which f32 cannot hold"),
        (powers(115, 0), "u is near 1e35, which f32 cannot hold"),
        (powers(0, -132), "fluxes are near 1e-39, which f32 cannot hold"),
        (powers(-90, 220), "fluxes are near 1e40, which f32 cannot hold"),
        (powers(-70, -50), "fluxes are near 1e-35, which f32 cannot hold"),
    ] {
        let error = baked::<f32>(units).expect_err("out of range").to_string();
        assert!(error.contains(what), "{error}");
        baked::<f64>(units)?;
    }
    Ok(())
}

#[test]
fn inputs_that_the_scalar_loses_are_refused() -> Result<()> {
    let refused = |text: &str, culprit: &str| -> Result<()> {
        let (_, problem) = fixtures::on_grid(text, grid(3, Cells::Triangles))?;
        let error = Baked::<f32>::new(&problem).expect_err("lost").to_string();
        assert!(error.contains(culprit), "{error}");
        Baked::<f64>::new(&problem)?;
        Ok(())
    };
    refused(&BENT.replace("default = 0.7", "default = 1e-40"), "input.level: f32 cannot hold")?;
    let huge =
        BENT.replace("\"1 + x^2/2\", default = 0.7", "\"1e-39*(1 + x^2/2)\", default = 7e38");
    refused(&huge, "input.level: f32 cannot hold")?;
    refused(&BENT.replace("\"y^2\"", "\"1e-41*y^2\""), "input.inflow.pattern: beside the other")?;
    refused(&BENT.replace("\"y^2\"", "\"1e-60*y^2\""), "input.inflow.pattern: beside the other")
}

/// Fluxes are near 2⁸⁴, and inputs many times as large make them as many times larger: f32 ends at 2¹²⁸.
#[test]
fn an_output_beyond_the_scalar_is_no_answer() -> Result<()> {
    let baked = baked::<f32>(powers(42, 42))?;
    let ended = |times: f32| -> Ended {
        let mut controller = Controller::<f32>::new(&baked);
        let inputs = INPUTS.map(|input| times * f32::narrow(input));
        let (outputs, report) = controller.tick_within(&inputs, to_the_end()).expect("a tick");
        let is_known = outputs.iter().all(|output| output.finite());
        assert_eq!(is_known, report.ended != Ended::NotFinite, "{outputs:?}");
        report.ended
    };
    assert_ne!(ended(1.0), Ended::NotFinite);
    assert_eq!(ended(2f32.powi(48)), Ended::NotFinite);
    Ok(())
}
