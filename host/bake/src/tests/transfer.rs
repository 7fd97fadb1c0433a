//! Transfer coefficients that inputs change, tick after tick: against solvers, resistances and an exact solution.

use super::direct::{Beside, bounded, directly, leaves_out_more, played, refusal, to_the_end};
use crate::Bakes;
use crate::full::{Baked, Controller, source};
use crate::narrow::narrow;
use signorini_problem::Problem;
use signorini_problem::fixtures::{SMOOTH, changed, on_grid, transfer_wall};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_solve::Solution;
use signorini_tolerances::Tolerance;
use signorini_tolerances::bake::{
    GUARANTEE, TRANSFER, TRANSFER_NARROW, TRANSFER_TICK, TRANSFER_TICK_NARROW, TRANSFER_WARM,
};

/// Inputs of both factors of h u_ext, with patterns that vary along the edges, one with a kink, and contact that opens and closes.
const PRODUCTS: &str = r#"
mesh = "grid"
material.default.conductivity = ["2", "0.5", "1"]
source.f = "-1"
boundary.dirichlet = { kind = "dirichlet", value = "0.3" }
boundary.left = { kind = "robin", coefficient = "2 + y", ambient = "y^2 - 2" }
boundary.right = { kind = "robin", coefficient = "x - 2", ambient = "-1" }
boundary.contact = { kind = "contact", gap = "-0.3*x^2", flux = "-0.1" }
input.wind = { of = "left", field = "coefficient", pattern = "1 - y/2", default = 1.0, range = [0.0, 20.0] }
input.shelter = { of = "left", field = "coefficient", pattern = "y", range = [-1.0, 1.0] }
input.air = { of = "left", field = "ambient", pattern = "1 - abs(y - 0.37)", default = 0.5 }
input.other = { of = "right", field = "coefficient", pattern = "2", default = 1.0, range = [0.5, 10.0] }
input.outside = { of = "right", field = "ambient", pattern = "3" }
output.left = { kind = "flux", of = "left" }
output.right = { kind = "flux", of = "right" }
output.force = { kind = "force" }
output.skin = { kind = "mean", of = "right" }
"#;

fn against_the_direct_solver<R: Bakes>(problem: &Problem, allowed: Tolerance) -> Result<()> {
    let steps = [
        [1.0, 0.0, 0.5, 1.0, 0.0],
        [20.0, -1.0, -2.0, 0.5, 1.5],
        [0.0, -1.0, 3.0, 10.0, -0.7],
        [0.0, 0.5, 3.0, 0.5, 1.0],
        [1.0, 0.0, 0.5, 1.0, 0.0],
    ];
    let steps = steps.map(Vec::from).into();
    let beside = Beside {
        problem,
        feature: "transfer",
        steps,
        least: Solution::largest_flux,
        is_undefined: |_, _| false,
    };
    beside.ticks::<R>(allowed, leaves_out_more)
}

#[test]
fn a_tick_is_a_solve_with_this_coefficient() -> Result<()> {
    let (_, problem) = on_grid(PRODUCTS, grid(5, Cells::Triangles))?;
    against_the_direct_solver::<f64>(&problem, TRANSFER_TICK)?;
    against_the_direct_solver::<f32>(&problem, TRANSFER_TICK_NARROW)?;
    for cells in [Cells::Quads, Cells::Mixed] {
        let (_, problem) = on_grid(PRODUCTS, grid(5, cells))?;
        against_the_direct_solver::<f64>(&problem, TRANSFER_TICK)?;
    }
    Ok(())
}

/// u = SMOOTH's for every h: u_ext = u + σ·n/h, where σ·n/π is an input that is set to 1/p of h = p π.
pub fn smooth(pattern: &str) -> String {
    let text = SMOOTH.replace("coefficient = \"2+y\"", "coefficient = \"0\"");
    let text = text.replace(" + (3*y - 6.5)/(2+y)\"", "\"");
    format!(
        "{text}
input.h = {{ of = \"left\", field = \"coefficient\", pattern = \"{pattern}\", default = 1.0, range = [0.01, 100.0] }}
input.push = {{ of = \"left\", field = \"ambient\", pattern = \"(3*y - 6.5)/({pattern})\", default = 1.0 }}
"
    )
}

const SMOOTH_STEPS: [f64; 5] = [1.0, 0.01, 100.0, 0.1, 3.0];

fn bounds<R: Bakes>(problem: &Problem) -> Result<()> {
    let at = |h: f64| problem.with_inputs(&[h, 1.0 / h]);
    bounded::<R>(problem, SMOOTH_STEPS.map(at), &[3, 30, u32::MAX].map(|sweeps| (sweeps, 2.5)))
}

#[test]
fn the_bound_holds_for_every_coefficient() -> Result<()> {
    let (_, problem) = on_grid(&smooth("2+y"), grid(4, Cells::Triangles))?;
    bounds::<f64>(&problem)?;
    bounds::<f32>(&problem)?;
    let (_, problem) = on_grid(&smooth("2+y"), grid(4, Cells::Mixed))?;
    bounds::<f64>(&problem)
}

#[test]
fn ticks_on_the_desk_bound_their_error_too() -> Result<()> {
    let (_, problem) = on_grid(&smooth("2+y"), grid(4, Cells::Mixed))?;
    let steps = SMOOTH_STEPS.map(|h| vec![h, 1.0 / h]);
    for tick in played(&problem, &steps)? {
        let bound = tick.bound.expect("a bound").total;
        let error = tick.combined.expect("an error");
        GUARANTEE.check_at_most(format_args!("t = {}", tick.time), error, bound);
        assert!(bound < 2.5 * error, "t = {}: {bound} for {error}", tick.time);
    }
    Ok(())
}

/// A wall of width 2 between u = 1 above and air at −1 below, where h is as the input says.
fn wall(coefficient: &str, range: &str) -> String {
    transfer_wall(coefficient, &format!("pattern = \"1\", default = 1.0, range = {range}"))
}

/// In series: 1/R = 1/(1/h + 1/2) over a width of 2, with a drop of 2. Where h vanishes nothing passes, and the bound knows.
fn resistances<R: Bakes>(base: f64, text: &str, allowed: Tolerance) -> Result<()> {
    let (_, problem) = on_grid(text, grid(4, Cells::Triangles))?;
    let baked = Baked::<R>::new(&problem)?;
    let mut controller = Controller::<R>::new(&baked);
    for h in [1.0, 0.0, 1e-3, 97.0, 0.0, 0.5] {
        let tick = controller.tick_within(&narrow(&[h - base]), to_the_end());
        let (found, report) = tick.expect("a tick");
        let expected = -4.0 * h * 2.0 / (h + 2.0);
        allowed.check(format_args!("h = {h}"), found[0].wide() - expected);
        let bound = report.verdict.certificate().expect("a bound").total.wide();
        allowed.check(format_args!("bound, h = {h}"), bound);
    }
    let steps: Vec<_> = [1.0, 0.0, 97.0].map(|h| vec![h - base]).into();
    for tick in played(&problem, &steps)? {
        let bound = tick.bound.expect("a bound").total;
        allowed.check(format_args!("bound at t = {}", tick.time), bound);
    }
    let outside = controller.tick(&narrow(&[97.5 - base]));
    assert!(outside.is_err_and(|error| error.to_string().contains("input 0")));
    Ok(())
}

#[test]
fn a_wall_passes_what_its_resistances_let_through_tick_after_tick() -> Result<()> {
    resistances::<f64>(0.0, &wall("0", "[0.0, 97.0]"), TRANSFER)?;
    resistances::<f64>(3.1, &wall("3.1", "[-3.1, 93.9]"), TRANSFER)?;
    resistances::<f32>(0.0, &wall("0", "[0.0, 97.0]"), TRANSFER_NARROW)?;
    resistances::<f32>(3.1, &wall("3.1", "[-3.1, 93.9]"), TRANSFER_NARROW)
}

/// A wall of another material, in units of which f32 cannot square the numbers: a controller answers in the scene's.
#[test]
fn a_wall_in_other_units_passes_as_much() -> Result<()> {
    let text = wall("0", "[0.0, 97.0]")
        .replace("conductivity = \"2\"", "conductivity = \"2e-20\"")
        .replace("pattern = \"1\"", "pattern = \"1e-20\"");
    let (_, problem) = on_grid(&text, grid(4, Cells::Triangles))?;
    let baked = Baked::<f32>::new(&problem)?;
    let mut controller = Controller::<f32>::new(&baked);
    for h in [1.0, 0.0, 97.0, 0.5] {
        let (found, report) = controller.tick_within(&narrow(&[h]), to_the_end()).expect("a tick");
        let expected = -4.0 * h * 2.0 / (h + 2.0);
        TRANSFER_NARROW.check(format_args!("h = {h}"), f64::from(found[0]) * 1e20 - expected);
        assert!(report.verdict.certificate().is_some(), "h = {h}: {report:?}");
    }
    Ok(())
}

#[test]
fn a_part_that_a_vanishing_coefficient_holds_is_refused_by_its_range() -> Result<()> {
    let alone = |range: &str| {
        let given = ("kind = \"dirichlet\", value = \"1\"", "kind = \"neumann\", flux = \"1\"");
        changed(&wall("0", range), &[given])
    };
    let (_, problem) = on_grid(&alone("[0.5, 2.0]"), grid(3, Cells::Mixed))?;
    Baked::<f64>::new(&problem)?;
    let error = refusal(&alone("[0.0, 2.0]"), grid(3, Cells::Mixed))?;
    let expected = "input.h.range: within it nothing may pass, and then nothing holds a part";
    assert!(error.contains(expected), "{error}");
    Ok(())
}

/// Contact holds the domain where h vanishes: ticks on the desk shift it then, and their matrix follows h.
#[test]
fn a_part_that_contact_holds_at_times_is_played_by_solves() -> Result<()> {
    let changes = [
        ("kind = \"dirichlet\", value = \"0.3\"", "kind = \"neumann\", flux = \"-0.2\""),
        ("coefficient = \"2 + y\"", "coefficient = \"y/2\""),
        ("pattern = \"1 - y/2\"", "pattern = \"1 - y/2 - y/2\""),
        ("coefficient = \"x - 2\"", "coefficient = \"0\""),
        ("range = [-1.0, 1.0]", "range = [-0.5, 1.0]"),
        ("range = [0.5, 10.0]", "range = [0.0, 10.0]"),
    ];
    let text = changed(PRODUCTS, &changes);
    let (_, problem) = on_grid(&text, grid(4, Cells::Mixed))?;
    let error = refusal(&text, grid(4, Cells::Mixed))?;
    assert!(error.contains("within it nothing may pass, and then contact alone holds"), "{error}");
    let steps = [[1.0, 0.0, 0.5, 1.0, 0.0], [0.0, -0.5, 0.5, 0.0, 0.0], [2.0, 0.3, -1.0, 5.0, 1.0]]
        .map(Vec::from);
    for (tick, values) in played(&problem, &steps)?.iter().zip(&steps) {
        let (now, _, expected) = directly(&problem, values)?;
        for (output, found) in now.scene.outputs.iter().zip(&tick.outputs) {
            let expected = expected[&output.name.value].expect("a value");
            let off = found.expect("a value") - expected;
            TRANSFER_WARM.check(format_args!("{} {values:?}", output.name.value), off);
        }
    }
    Ok(())
}

#[test]
fn a_factor_is_refused_where_the_matrix_changes() -> Result<()> {
    let text = wall("0", "[0.5, 97.0]") + "[setting]\nsolver = \"factor\"\n";
    let error = refusal(&text, grid(3, Cells::Triangles))?;
    assert!(error.contains("input.h.field: it changes the matrix, and a factor"), "{error}");
    let (_, problem) = on_grid(PRODUCTS, grid(3, Cells::Triangles))?;
    let text = source(&Baked::<f64>::new(&problem)?);
    assert!(text.contains("AmbientShare { input: 3, integrals: &WIND_TIMES_AMBIENT_3 }"));
    Ok(())
}

#[test]
fn ranges_with_too_many_corners_are_refused() -> Result<()> {
    let with = |inputs: usize| {
        let input = |at| {
            format!(
                "[input.gust{at}]\nof = \"contact\"\nfield = \"coefficient\"\npattern = \"1\"\nrange = [0, 1]\n"
            )
        };
        wall("1", "[0.0, 1.0]") + &(1..inputs).map(input).collect::<String>()
    };
    let (_, problem) = on_grid(&with(8), grid(1, Cells::Triangles))?;
    Baked::<f64>::new(&problem)?;
    let error = refusal(&with(9), grid(1, Cells::Triangles))?;
    assert!(error.contains("input.gust8.field: more than 8 inputs change"), "{error}");
    Ok(())
}
