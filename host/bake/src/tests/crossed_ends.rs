//! A limit that an input brings below the least flux: by up to a slack, the same for every scalar and model, both are their mean; beyond,
//! everybody refuses the input by its name.

use super::direct::{directly, played, to_the_end};
use super::exact;
use crate::narrow::narrow;
use crate::{Bakes, condensed, full};
use signorini_kernel::Error;
use signorini_problem::Problem;
use signorini_problem::fixtures::{on_grid, scene, wall};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::mesh::{Curve, Mesh};
use signorini_session::tick::{ScheduledTick, replay};
use signorini_solve::{Options, ScalarKind, solve};

/// A face below that gives 1 at least and 2 + `cap` at most, over a length of 2.
const FACE: &str = r#"kind = "contact", gap = "1.2 + 0.5*x", flux = "1", limit = "2""#;

const INPUTS: &str = r#"
input.sun = { of = "source", field = "f", pattern = "1", range = [-1, 1] }
input.cap = { of = "contact", field = "limit", pattern = "1" }
output.power = { kind = "flux", of = "contact" }
"#;

/// cap, so many slacks below −1: 2⁻¹⁹ of terms of 1 + 2 + 1, in a number that f32 has, too.
fn cap(slacks: f64) -> f64 {
    let exact = -1.0 - slacks / f64::from(1 << 17);
    f64::from(exact as f32)
}

/// Every controller, first with room, then with this cap, then with room again: its outputs for the cap, where it has any, and
/// how it refuses.
fn of_controllers<R: Bakes>(
    problem: &Problem,
    cap: f64,
) -> Result<Vec<std::result::Result<f64, Error>>> {
    let baked = full::Baked::<R>::new(problem)?;
    let mut on_mesh = full::Controller::<R>::new(&baked);
    let small = exact::<R>(problem)?;
    let mut condensed = condensed::Controller::new(&small);
    let inputs = |cap: f64| -> Vec<R> { narrow(&[0.25, cap]) };
    let first = on_mesh.tick_within(&inputs(0.0), to_the_end()).expect("a tick").0;
    let small_first = condensed.tick(&inputs(0.0)).expect("a tick").0;
    let found = vec![
        on_mesh.tick_within(&inputs(cap), to_the_end()).map(|(values, _)| values[0].wide()),
        condensed.tick(&inputs(cap)).map(|(values, _)| values[0].wide()),
    ];
    let near = |a: R, b: R| (a - b).magnitude().wide() < 1e-4;
    assert!(near(on_mesh.tick_within(&inputs(0.0), to_the_end()).expect("a tick").0[0], first[0]));
    assert!(near(condensed.tick(&inputs(0.0)).expect("a tick").0[0], small_first[0]));
    Ok(found)
}

#[test]
fn all_take_the_same_inputs() -> Result<()> {
    let (_, problem) = on_grid(&(wall("1", FACE) + INPUTS), grid(4, Cells::Triangles))?;
    for slacks in [0.5, 0.99, 1.01, 2.0] {
        let (cap, is_taken) = (cap(slacks), slacks < 1.0);
        let check = |at: &str, found: std::result::Result<f64, String>, refusal: &str| match found {
            Ok(power) => {
                let off = (power - 3.0 - cap).abs();
                assert!(is_taken && off < 1.6e-5, "{slacks} {at}: {power}");
            }
            Err(said) => assert!(!is_taken && said.contains(refusal), "{slacks} {at}: {said}"),
        };
        let found = [of_controllers::<f64>(&problem, cap)?, of_controllers::<f32>(&problem, cap)?];
        for found in found.into_iter().flatten() {
            let found = found.map_err(|error| format!("{error:?}"));
            check("a controller", found, "EmptyRange { input: 1 }");
        }
        let steps = [vec![0.25, 0.0], vec![0.25, cap]];
        let moments = steps.iter().zip([0.0, 1.0]).map(|(step, time)| ScheduledTick {
            time,
            inputs: step.iter().copied().enumerate().collect(),
        });
        let moments: Vec<_> = moments.collect();
        let replayed = |scalar| {
            replay(&problem, &moments, (Some(scalar), false), |_, _| Ok(())).map(|(_, ticks)| ticks)
        };
        for (at, found) in [
            ("a solve", directly(&problem, &steps[1]).map(|(_, _, values)| values["power"])),
            ("the desk", played(&problem, &steps).map(|ticks| ticks[1].outputs[0])),
            ("f64", replayed(ScalarKind::F64).map(|ticks| ticks[1].outputs[0])),
            ("f32", replayed(ScalarKind::F32).map(|ticks| ticks[1].outputs[0])),
        ] {
            let found = found.map(|power| power.expect("a flux"));
            check(at, found.map_err(|error| error.to_string()), "input.cap");
        }
    }
    Ok(())
}

/// u = q (1 − y) on an area of 2, where the scene has 1 for the one end of q and less, by less than a slack, for the other.
fn crossing(gap: &str, left: &str, input: &str) -> String {
    format!(
        "mesh = \"grid\"
material.default.conductivity = \"1\"
boundary.dirichlet = {{ kind = \"dirichlet\", value = \"0\" }}
boundary.left = {{ {left} }}
boundary.right = {{ kind = \"neumann\", flux = \"0\" }}
boundary.contact = {{ kind = \"contact\", gap = \"{gap}\", flux = \"1\", limit = \"1 - 2e-6 + 0*x\" }}
{input}
"
    )
}

/// How far either end is from their mean, in ‖∇u‖.
const OFF: f64 = 1e-6 * std::f64::consts::SQRT_2;
const INSULATED: &str = "kind = \"neumann\", flux = \"0\"";
const LEVEL: &str = "input.level = { of = \"dirichlet\", field = \"value\", pattern = \"1\" }";
const CAP: &str =
    "input.cap = { of = \"contact\", field = \"limit\", pattern = \"1\", range = [0, 1] }";

fn check_total(what: &str, total: f64, most: f64) {
    assert!(total >= OFF && total < most * OFF, "{what}: {total} beside {OFF}");
}

/// Off a gap, and on it. With an input of a limit everybody finds out at the tick.
#[test]
fn ends_that_cross_are_in_every_bound() -> Result<()> {
    for (gap, input) in [("-9", LEVEL), ("1 - 1e-6", LEVEL), ("-9", CAP), ("1 - 1e-6", CAP)] {
        let text = crossing(gap, INSULATED, input);
        let (_, problem) = on_grid(&text, grid(4, Cells::Triangles))?;
        let baked = full::Baked::<f64>::new(&problem)?;
        let mut on_mesh = full::Controller::<f64>::new(&baked);
        let small = exact::<f64>(&problem)?;
        let of_controllers = [
            on_mesh.tick_within(&[0.0], to_the_end()).expect("a tick").1.verdict,
            condensed::Controller::new(&small).tick(&[0.0]).expect("a tick").1.verdict,
        ];
        let totals = of_controllers.map(|verdict| verdict.certificate().expect("a bound").total);
        let solved = solve(&problem, &Options::default())?.bound.expect("a bound").total;
        let what = format!("{gap}, {input}");
        totals.into_iter().chain([solved]).for_each(|total| check_total(&what, total, 20.0));
    }
    Ok(())
}

/// An input moves the limit of another boundary, through which nothing passes below its gap.
#[test]
fn ends_cross_beside_an_input_of_another_limit() -> Result<()> {
    let left = "kind = \"contact\", gap = \"9\", flux = \"-inf\", limit = \"0\"";
    let cap = "input.cap = { of = \"left\", field = \"limit\", pattern = \"1\", range = [0, 1] }";
    let (_, problem) = on_grid(&crossing("-9", left, cap), grid(4, Cells::Triangles))?;
    let baked = full::Baked::<f64>::new(&problem)?;
    let mut on_mesh = full::Controller::<f64>::new(&baked);
    let verdict = on_mesh.tick_within(&[0.0], to_the_end()).expect("a tick").1.verdict;
    check_total("full", verdict.certificate().expect("a bound").total, 20.0);
    Ok(())
}

/// Far below its gap in every tick, the face would be taken out of a model for these ranges.
#[test]
fn edges_whose_ends_may_cross_stay_in_a_model() -> Result<()> {
    let text = crossing("-9", INSULATED, CAP);
    let (_, problem) = on_grid(&text, grid(4, Cells::Triangles))?;
    let moments = [ScheduledTick { time: 0.0, inputs: [(0, 0.0)].into() }];
    let (_, ticks) = replay(&problem, &moments, (Some(ScalarKind::F64), false), |_, _| Ok(()))?;
    check_total("a replay", ticks[0].bound.as_ref().expect("a bound").total, 40.0);
    Ok(())
}

/// A strip of 256 squares with u given at its far end: what crosses by δ on each edge below it leaves there, ‖∇w‖ = δ (L³/3)^½.
#[test]
fn what_crosses_leaves_at_the_far_end() -> Result<()> {
    let length = 256_u32;
    let row = |y: f64| (0..=length).map(move |x| [f64::from(x), y]);
    let (above, edge) = (length + 1, |name: &str, edges| Curve { name: name.to_owned(), edges });
    let mesh = Mesh {
        vertices: row(0.0).chain(row(1.0)).collect(),
        quads: (0..length).map(|x| [x, x + 1, above + x + 1, above + x]).collect(),
        curves: vec![
            edge("below", (0..length).map(|x| [x, x + 1]).collect()),
            edge("end", vec![[length, above + length]]),
        ],
        ..Mesh::default()
    };
    let text = "
mesh = \"strip\"
material.default.conductivity = \"1\"
boundary.below = { kind = \"contact\", gap = \"-9\", flux = \"1e-3\", limit = \"1e-3 - 3e-9 + 0*x\" }
boundary.end = { kind = \"dirichlet\", value = \"0\" }
boundary.default = { kind = \"neumann\", flux = \"0\" }
";
    let problem = Problem::new(&scene(text)?, mesh)?;
    let bound = solve(&problem, &Options::default())?.bound.expect("a bound");
    let off = 1.5e-9 * (f64::from(length).powi(3) / 3.0).sqrt();
    assert!(bound.oscillation >= off, "{} beside {off}", bound.oscillation);
    Ok(())
}
