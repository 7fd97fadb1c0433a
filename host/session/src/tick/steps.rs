//! Steps in time by the controllers that `bake` writes: beside this machine's own, and after what is refused.

use std::ops::Range;

use super::{Budget, ScheduledTick, TickRecord, play, replay};
use crate::{Session, with_module};
use signorini_bake::narrow::narrow;
use signorini_problem::Problem;
use signorini_problem::fixtures::{changed, on_grid};
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_solve::ScalarKind;

/// A heater below a Robin side and between Dirichlet ones, all of which inputs change; sweeps go on to rounding.
const HEATED: &str = r#"
mesh = "grid"
material.default = { conductivity = "1", capacity = "2" }
boundary.dirichlet = { kind = "robin", coefficient = "0", ambient = "1" }
boundary.left = { kind = "dirichlet", value = "0" }
boundary.right = { kind = "neumann", flux = "0.1" }
boundary.contact = { kind = "contact", gap = "0.35", flux = "0", limit = "0.6" }
input.heat = { of = "source", field = "f", pattern = "1 - y", default = -1.0, range = [-3.0, 3.0] }
input.wind = { of = "dirichlet", field = "coefficient", pattern = "1", default = 1.0, range = [0.1, 2.0] }
input.level = { of = "left", field = "value", pattern = "1 - y", default = 0.2, range = [0.0, 1.0] }
input.lift = { of = "contact", field = "gap", pattern = "1", default = 0.0, range = [-0.1, 0.1] }
input.supply = { of = "contact", field = "limit", pattern = "1", default = 0.0, range = [-0.5, 0.5] }
output.force = { kind = "force" }
output.saturated = { kind = "saturated" }
output.flux = { kind = "flux", of = "dirichlet" }
output.face = { kind = "mean", of = "contact" }
output.bound = { kind = "bound" }
output.sure = { kind = "window" }
time.step = 0.05
setting.share = 1e-9
"#;

/// The output that is the bound over time.
const SURE: usize = 5;

/// Changes by which the wind of [`HEATED`] stays, as condensed steps want it.
pub(super) const STILL: [(&str, &str); 3] = [
    (
        "input.wind = { of = \"dirichlet\", field = \"coefficient\", pattern = \"1\", default = 1.0, range = [0.1, 2.0] }\n",
        "",
    ),
    ("output.bound = { kind = \"bound\" }\n", ""),
    ("coefficient = \"0\"", "coefficient = \"1\""),
];

/// The setting of [`HEATED`].
pub(super) const SHARE: &str = "setting.share = 1e-9";

pub(super) fn changed_heater(cells: Cells, changes: &[(&str, &str)]) -> Result<Problem> {
    Ok(on_grid(&changed(HEATED, changes), grid(4, cells))?.1)
}

/// The heated scene in a wind that stays, by this setting.
pub(super) fn still(cells: Cells, setting: &str) -> Result<Problem> {
    changed_heater(cells, &[&STILL[..], &[(SHARE, setting)]].concat())
}

pub(super) const CONDENSED: &str = "setting.certificate = false\nsetting.memory = ";
pub(super) const SWEPT: &str = "\nsetting.model = \"condensed\"\nsetting.solver = \"sweeps\"";

/// The values of the inputs in a step.
pub(super) fn inputs(problem: &Problem, at: u32) -> Vec<f64> {
    let (t, jump) = (f64::from(at), f64::from(at / 7 % 2));
    let of = |name: &str| match name {
        "heat" => 3.0 * (0.4 * t).sin(),
        "wind" => 1.0 + 0.9 * (0.3 * t).cos(),
        "level" => 0.5 * jump + 0.2,
        "lift" => 0.1 * (0.2 * t).sin(),
        _ => 0.4 - 0.9 * jump,
    };
    problem.scene.inputs.iter().map(|input| of(&input.name.value)).collect()
}

fn moments(problem: &Problem, count: u32) -> Vec<ScheduledTick> {
    let of = |at: u32| ScheduledTick {
        time: 0.05 * f64::from(at),
        inputs: inputs(problem, at).into_iter().enumerate().collect(),
    };
    (1..=count).map(of).collect()
}

/// 30 steps of this machine, and as many of the controller, whose name begins so; before them the start.
pub(super) fn both(of: &Problem, baked: &Problem, name: &str) -> Result<Vec<[TickRecord; 2]>> {
    let budget = Budget { intervals: false, ..Budget::of(&of.scene) };
    let own = play(of, None, &moments(of, 30), &budget, |_, _| Ok(()))?;
    let asked = (Some(ScalarKind::F64), true);
    let (model, baked) = replay(baked, &moments(baked, 30), asked, |_, _| Ok(()))?;
    assert!(model.starts_with(name), "{model}");
    assert_eq!((own.len(), baked.len()), (31, 31));
    Ok(own.into_iter().zip(baked).map(|(own, baked)| [own, baked]).collect())
}

fn near(what: &str, found: f64, expected: f64, part: f64) {
    let off = (found - expected).abs();
    assert!(off <= part * expected.abs().max(1.0), "{what}: {found} {expected}");
}

/// 30 steps with all inputs moving: the numbers of this machine's own play but for what either leaves to its sweeps.
#[test]
fn a_controller_steps_as_this_machine_does() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        let problem = changed_heater(cells, &[])?;
        let ticks = both(&problem, &problem, "full")?;
        // What cells hand on is no part that sweeps remove: they would go on for it to their last.
        assert!(ticks.iter().all(|[_, baked]| baked.sweeps < 2000), "{cells:?}");
        let sometimes =
            |output: usize| ticks.iter().any(|[own, _]| own.outputs[output] > Some(0.1));
        assert!([0, 1].into_iter().all(sometimes), "edges hold, and are saturated");
        for [own, baked] in &ticks {
            let what = format!("{cells:?} at {}", own.time);
            for (at, (own, baked)) in own.outputs.iter().zip(&baked.outputs).enumerate() {
                let [own, baked] = [own, baked].map(|number| number.expect("a number"));
                near(&format!("{what}, {at}"), baked, own, if at == SURE { 1e-6 } else { 1e-8 });
            }
            let total = |of: &TickRecord| of.bound.expect("a bound").total;
            near(&format!("{what}, total"), total(baked), total(own), 1e-6);
            let [[found, seconds], [expected, same]] =
                [baked, own].map(|of| of.window.expect("a window"));
            near(&format!("{what}, window"), found, expected, 1e-6);
            assert_eq!(baked.outputs[SURE], Some(found));
            near(&what, seconds, same, 1e-12);
        }
    }
    Ok(())
}

/// By how much outputs of the condensed controller are off those of this machine's own steps, at most.
fn off(cells: Cells, memory: &str) -> Result<f64> {
    let baked = still(cells, &format!("{CONDENSED}{memory}"))?;
    let ticks = both(&still(cells, SHARE)?, &baked, "condensed with")?;
    let mut most = 0.0_f64;
    for [own, baked] in &ticks[1..] {
        assert!(baked.bound.is_none() && baked.window.is_none());
        for (own, baked) in own.outputs[..4].iter().zip(&baked.outputs) {
            most = most.max((own.expect("a number") - baked.expect("a number")).abs());
        }
    }
    Ok(most)
}

/// 30 steps with all inputs moving: with all states the numbers of this machine's own play but for what that leaves to its sweeps.
#[test]
fn a_condensed_controller_steps_as_this_machine_does() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        near(&format!("{cells:?}"), off(cells, "1000")?, 0.0, 1e-8);
    }
    let [few, more] = [off(Cells::Mixed, "2")?, off(Cells::Mixed, "24")?];
    assert!(more < 0.02 * few && few < 0.5, "{few} {more}");
    Ok(())
}

/// Outputs, total and window of ticks, as a program prints them, and what they took.
pub(super) fn told<R: Scalar>(
    problem: &Problem,
    session: &mut dyn Session,
    ticks: Range<u32>,
) -> Result<String> {
    let tick = |at| {
        session.tick(&inputs(problem, at))?;
        let answer = session.answer(problem)?;
        let outputs: Vec<R> = narrow(&answer.outputs);
        let bounds = [answer.bound.map(|of| of.total), session.window().map(|[energy, _]| energy)];
        let [total, window] = bounds.map(|of| of.map(R::narrow));
        Ok(format!("{outputs:?} {total:?} {window:?} {}\n", answer.sweeps))
    };
    ticks.map(tick).collect()
}

/// A tick that is refused leaves everything, bit for bit, and a reset goes back to the start.
#[test]
fn a_refused_tick_advances_nothing_and_a_reset_all() -> Result<()> {
    let cells = Cells::Mixed;
    for problem in [
        changed_heater(cells, &[])?,
        still(cells, &format!("{CONDENSED}6{SWEPT}"))?,
        still(cells, "setting.memory = 6")?,
    ] {
        with_module(&problem, Some(ScalarKind::F32), |session, _| {
            let (start, begin) = (session.state(), session.window());
            let whole = told::<f32>(&problem, session, 1..9)?;
            session.restart();
            assert_eq!((session.state(), session.window()), (start, begin));
            let first = told::<f32>(&problem, session, 1..5)?;
            let sound = inputs(&problem, 4);
            let last = sound.len() - 1;
            for (input, value) in [(0, 9.0), (0, f64::NAN), (last, -0.6)] {
                let before = (session.state(), session.window());
                let mut refused = sound.clone();
                refused[input] = value;
                assert!(session.tick(&refused).is_err());
                assert_eq!((session.state(), session.window()), before);
            }
            assert_eq!(first + &told::<f32>(&problem, session, 5..9)?, whole);
            Ok(())
        })?;
    }
    Ok(())
}
