//! Full models with limits of the flux, and inputs on either end of it, tick after tick: against the direct solver and
//! an exact solution, and where inputs leave no flux.

use super::direct::{Beside, HEATER, bounded, directly, played, refusal, to_the_end};
use crate::Bakes;
use crate::full::{Baked, Controller, source};
use crate::narrow::narrow;
use signorini_kernel::Error;
use signorini_problem::Problem;
use signorini_problem::fixtures::limited::{crossing, fading};
use signorini_problem::fixtures::{changed, on_grid};
use signorini_problem::inputs::{InputSpace, drawn};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::Tolerance;
use signorini_tolerances::bake::{
    LIMITED_DESK, LIMITED_INPUT_TICK, LIMITED_INPUT_TICK_NARROW, LIMITED_TICK, LIMITED_TICK_NARROW,
};

/// A heater below whose supply sags and whose least flux leaks, a limit from above on the right, air on the left.
const SUPPLY: &str = r#"
mesh = "grid"
material.default.conductivity = ["2", "0.3", "1"]
boundary.dirichlet = { kind = "dirichlet", value = "2 - x/4" }
boundary.left = { kind = "robin", coefficient = "3", ambient = "0" }
boundary.right = { kind = "contact", gap = "3", flux = "-inf", limit = "0.5*y" }
boundary.contact = { kind = "contact", gap = "2", flux = "-1 + 0.3*x", limit = "0.3*x" }
input.supply = { of = "contact", field = "limit", pattern = "6", default = 1.0, range = [0.0, 1.5] }
input.leak = { of = "contact", field = "flux", pattern = "-0.5", range = [-2.0, 4.0] }
input.drain = { of = "right", field = "limit", pattern = "1 - y", range = [-1.0, 3.0] }
input.air = { of = "left", field = "ambient", pattern = "1", default = -3.0, range = [-40.0, 6.0] }
output.power = { kind = "force", of = "contact" }
output.flux = { kind = "flux", of = "contact" }
output.short = { kind = "saturated", of = "contact" }
output.kept = { kind = "length", of = "contact" }
output.held = { kind = "force", of = "right" }
output.skin = { kind = "mean", of = "contact" }
"#;

/// The corners where both ends of the heater's flux meet, and inputs drawn within the ranges.
fn steps(problem: &Problem, ticks: usize) -> Vec<Vec<f64>> {
    let corners = [[0.0, -2.0, 0.0, -3.0], [1.0, 0.0, 0.0, -3.0], [0.0, -2.0, 3.0, 6.0]];
    let spaces = InputSpace::of(&problem.scene);
    corners.map(Vec::from).into_iter().chain(drawn(&spaces, ticks)).collect()
}

/// Ticks as solves, in which each of two lengths vanishes at times, and not always.
fn against_the_direct_solver<R: Bakes>(
    beside: &Beside,
    lengths: [usize; 2],
    allowed: Tolerance,
) -> Result<()> {
    let mut seen = [[false; 2]; 2];
    beside.ticks::<R>(allowed, |found, _, _| {
        for (seen, length) in seen.iter_mut().zip(lengths) {
            seen[usize::from(found[length] > R::ZERO)] = true;
        }
    })?;
    assert_eq!(seen, [[true; 2]; 2]);
    Ok(())
}

fn supplied<R: Bakes>(problem: &Problem, ticks: usize, allowed: Tolerance) -> Result<()> {
    // Where both ends are equal u may pass through the gap, and no length is defined but by rounding.
    let is_undefined = |values: &[f64], name: &str| {
        values[0] == 0.0 && values[1] == -2.0 && ["short", "kept"].contains(&name)
    };
    let steps = steps(problem, ticks);
    let beside = Beside { problem, feature: "limited", steps, least: |_| 10.0, is_undefined };
    against_the_direct_solver::<R>(&beside, [2, 3], allowed)
}

#[test]
fn a_tick_is_a_solve_with_these_ends() -> Result<()> {
    let (_, problem) = on_grid(SUPPLY, grid(6, Cells::Triangles))?;
    supplied::<f64>(&problem, 30, LIMITED_INPUT_TICK)?;
    supplied::<f32>(&problem, 30, LIMITED_INPUT_TICK_NARROW)?;
    for cells in [Cells::Quads, Cells::Mixed] {
        let (_, problem) = on_grid(SUPPLY, grid(6, cells))?;
        supplied::<f64>(&problem, 10, LIMITED_INPUT_TICK)?;
    }
    Ok(())
}

#[test]
fn a_factor_serves_every_range() -> Result<()> {
    let text = format!("{SUPPLY}[setting]\nsolver = \"factor\"\n");
    let (_, problem) = on_grid(&text, grid(6, Cells::Mixed))?;
    supplied::<f64>(&problem, 20, LIMITED_INPUT_TICK)
}

/// Inputs of [`HEATER`], among them some for each state alone, and back again.
fn heated<R: Bakes>(problem: &Problem, allowed: Tolerance) -> Result<()> {
    let steps = [
        [-3.0, 0.0, 0.0],
        [-40.0, 0.0, 0.0],
        [4.0, 6.0, 0.0],
        [-3.0, 0.0, 3.0],
        [2.0, 0.5, -0.2],
        [-12.0, 2.0, 0.1],
        [-3.0, 0.0, 0.0],
    ];
    let steps = steps.map(Vec::from).into();
    let beside =
        Beside { problem, feature: "limited", steps, least: |_| 2.0, is_undefined: |_, _| false };
    against_the_direct_solver::<R>(&beside, [1, 2], allowed)
}

#[test]
fn a_heater_with_a_limit_is_ticked() -> Result<()> {
    let (_, problem) = on_grid(HEATER, grid(6, Cells::Triangles))?;
    heated::<f64>(&problem, LIMITED_TICK)?;
    heated::<f32>(&problem, LIMITED_TICK_NARROW)?;
    for cells in [Cells::Quads, Cells::Mixed] {
        let (_, problem) = on_grid(HEATER, grid(6, cells))?;
        heated::<f64>(&problem, LIMITED_TICK)?;
    }
    Ok(())
}

#[test]
fn an_infinite_end_has_no_inputs() -> Result<()> {
    let inputs = [("of = \"contact\", field = \"gap\"", "of = \"right\", field = \"flux\"")];
    let endless = changed(HEATER, &inputs);
    let error = on_grid(&endless, grid(2, Cells::Triangles)).err().map(|error| error.to_string());
    let said = error.unwrap_or_default();
    assert!(said.contains("boundary.right.flux is -inf, to which nothing can be added"), "{said}");
    Ok(())
}

#[test]
fn ticks_on_the_desk_know_the_same_ends() -> Result<()> {
    let (_, problem) = on_grid(SUPPLY, grid(4, Cells::Mixed))?;
    let steps = steps(&problem, 6);
    for (tick, values) in played(&problem, &steps)?.iter().zip(&steps) {
        let (now, _, expected) = directly(&problem, values)?;
        for (output, found) in now.scene.outputs.iter().zip(&tick.outputs) {
            let name = output.name.value.as_str();
            if ["power", "flux", "held", "skin"].contains(&name) {
                let expected = expected[name].expect("a value");
                let off = found.expect("a value") - expected;
                let size = expected.abs().max(10.0);
                LIMITED_DESK.check_over(format_args!("{name} {values:?}"), off, size);
            }
        }
    }
    Ok(())
}

/// All three sides of the law with the r^{3/2} of both transitions at ±0.55, as `l-tri` of the catalogue has it, times p: the
/// limit is 1.5 p, the Dirichlet value p u.
fn transitions(p: f64) -> String {
    let [u, dx, dy] = crossing([0.0, 1.5]);
    format!(
        "
mesh = \"grid\"
material.default.conductivity = \"1\"
boundary.dirichlet = {{ kind = \"dirichlet\", value = \"0\" }}
boundary.contact = {{ kind = \"contact\", gap = \"0\", flux = \"0\", limit = \"0\" }}
input.above = {{ of = \"dirichlet\", field = \"value\", pattern = \"{u}\", default = {p} }}
input.supply = {{ of = \"contact\", field = \"limit\", pattern = \"1.5\", default = {p}, range = [0, 1e3] }}
exact = {{ u = \"{p}*({u})\", gradient = [\"{p}*({dx})\", \"{p}*({dy})\"] }}
"
    )
}

/// Where ticks are cut off, of which the last comes to the end.
fn cut_offs(most: f64) -> [(u32, f64); 4] {
    let any = f64::INFINITY;
    [(0, any), (3, any), (30, any), (u32::MAX, most)]
}

fn bounds<R: Bakes>(cells: Cells) -> Result<()> {
    let at = |p: f64| on_grid(&transitions(p), grid(6, cells)).map(|(_, problem)| problem);
    bounded::<R>(&at(1.0)?, [1.0, 0.02, 300.0, 0.7].map(at), &cut_offs(1.05))
}

#[test]
fn the_bound_holds_for_every_supply() -> Result<()> {
    bounds::<f64>(Cells::Triangles)?;
    bounds::<f32>(Cells::Triangles)?;
    bounds::<f64>(Cells::Mixed)
}

/// Without its ranges.
fn unranged() -> String {
    changed(SUPPLY, &[(", range = [0.0, 1.5]", ""), (", range = [-2.0, 4.0]", "")])
}

fn refused_and_kept<R: Bakes>() -> Result<()> {
    let (_, problem) = on_grid(&unranged(), grid(4, Cells::Triangles))?;
    let baked = Baked::<R>::new(&problem)?;
    let mut controller = Controller::<R>::new(&baked);
    let inputs = [1.0, 0.0, 0.0, -3.0];
    let (first, _) = controller.tick_within(&narrow(&inputs), to_the_end()).expect("a tick");
    let u = controller.u().to_vec();
    // lo = −1 − leak/2 and hi = 6 supply, beside 0.3 x in both.
    for ([supply, leak], input) in [([-0.2, 0.0], 0), ([0.0, -2.1], 1), ([1.0, -15.0], 1)] {
        let tried = controller.tick(&narrow(&[supply, leak, 0.0, -3.0]));
        assert_eq!(tried.err(), Some(Error::EmptyRange { input }), "{supply} {leak}");
        assert_eq!(controller.u(), u);
        assert!(problem.with_inputs(&[supply, leak, 0.0, -3.0]).is_err());
    }
    // Equal but for rounding.
    let third = R::ONE / R::from_count(3);
    let equal = [third, R::narrow(-2.0) - R::from_count(4), R::ZERO, R::ZERO];
    controller.tick_within(&equal, to_the_end()).expect("a tick");
    let (again, _) = controller.tick_within(&narrow(&inputs), to_the_end()).expect("a tick");
    for (again, first) in again.iter().zip(&first) {
        LIMITED_INPUT_TICK_NARROW.check("again", again.wide() - first.wide());
    }
    Ok(())
}

#[test]
fn a_limit_below_the_least_flux_is_refused_and_the_answer_stays() -> Result<()> {
    refused_and_kept::<f64>()?;
    refused_and_kept::<f32>()
}

#[test]
fn ranges_that_leave_no_flux_are_refused_with_the_corner() -> Result<()> {
    let (_, problem) = on_grid(SUPPLY, grid(3, Cells::Triangles))?;
    let text = source(&Baked::<f64>::new(&problem)?);
    assert!(text.contains("Pattern::ContactRange { fluxes: &[], spans: &SUPPLY_TO_SPANS }"));
    assert!(text.contains("fluxes: &LEAK_TO_FLUXES, spans: &LEAK_TO_SPANS"));
    assert!(text.contains("Pattern::ContactFlux(&DRAIN_PATTERN)"));
    let wider = SUPPLY.replace("range = [-2.0, 4.0]", "range = [-2.5, 4.0]");
    let error = refusal(&wider, grid(3, Cells::Triangles))?;
    let expected =
        "input.supply.range: with supply = 0 and leak = -2.5 the limit of boundary.contact";
    assert!(error.contains(expected) && error.contains("less than flux = "), "{error}");
    // Without a range the default counts.
    let (_, problem) = on_grid(&unranged(), grid(3, Cells::Triangles))?;
    Baked::<f64>::new(&problem)?;
    Ok(())
}

fn fades<R: Bakes>(cells: Cells) -> Result<()> {
    let (_, problem) = on_grid(&fading(), grid(8, cells))?;
    let at = |supply: f64| problem.with_inputs(&[supply]);
    bounded::<R>(&problem, [1.0, 0.05, 3.0].map(at), &cut_offs(3.0))
}

/// Ends that meet at both corners for every supply within its range.
#[test]
fn a_span_that_fades_has_a_bound_within_ranges() -> Result<()> {
    fades::<f64>(Cells::Triangles)?;
    fades::<f32>(Cells::Triangles)?;
    fades::<f64>(Cells::Mixed)
}

#[test]
fn a_span_that_varies_along_edges_has_no_bound_without_ranges() -> Result<()> {
    let bent = unranged().replace("pattern = \"6\"", "pattern = \"6 + x\"");
    let (_, problem) = on_grid(&bent, grid(3, Cells::Triangles))?;
    let baked = Baked::<f64>::new(&problem)?;
    assert!(!baked.has_bound());
    let mut controller = Controller::<f64>::new(&baked);
    let values = [0.8, 0.5, 0.0, -9.0];
    let (found, report) = controller.tick_within(&values, to_the_end()).expect("a tick");
    assert!(report.verdict.certificate().is_none());
    let (_, _, expected) = directly(&problem, &values)?;
    LIMITED_INPUT_TICK.check("power", found[0] - expected["power"].expect("a value"));
    Ok(())
}
