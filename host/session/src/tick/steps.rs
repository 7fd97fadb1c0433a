//! Steps in time by the controller that `bake` writes: beside this machine's own, and bit for bit with the module.

use super::{Budget, ScheduledTick, TickRecord, play, replay};
use signorini_bake::Bakes;
use signorini_bake::choice::{Choice, Model, Wanted};
use signorini_bake::compiled::printed;
use signorini_bake::full::{Baked, Controller, source};
use signorini_problem::Problem;
use signorini_problem::fixtures::on_grid;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_solve::ScalarKind;

/// A heater below a Robin side and between Dirichlet ones, all of which inputs change; sweeps go on to rounding.
pub(super) const HEATED: &str = r#"
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

fn heated(cells: Cells, other: &str) -> Result<Problem> {
    Ok(on_grid(&format!("{HEATED}{other}"), grid(4, cells))?.1)
}

/// The values of the inputs in a step.
fn inputs(at: u32) -> [f64; 5] {
    let (t, jump) = (f64::from(at), f64::from(at / 7 % 2));
    [
        3.0 * (0.4 * t).sin(),
        1.0 + 0.9 * (0.3 * t).cos(),
        0.5 * jump + 0.2,
        0.1 * (0.2 * t).sin(),
        0.4 - 0.9 * jump,
    ]
}

fn moments(count: u32) -> Vec<ScheduledTick> {
    let of = |at: u32| ScheduledTick {
        time: 0.05 * f64::from(at),
        inputs: inputs(at).map(|x| x.clamp(-3.0, 3.0)).into_iter().enumerate().collect(),
    };
    (1..=count).map(of).collect()
}

pub(super) fn near(what: &str, found: f64, expected: f64, part: f64) {
    let off = (found - expected).abs();
    assert!(off <= part * expected.abs().max(1.0), "{what}: {found} {expected}");
}

/// 30 steps with all inputs moving: the numbers of this machine's own play but for what either leaves to its sweeps.
#[test]
fn a_controller_steps_as_this_machine_does() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        let problem = heated(cells, "")?;
        let moments = moments(30);
        let budget = Budget { intervals: false, ..Budget::of(&problem.scene) };
        let own = play(&problem, None, &moments, &budget, |_, _| Ok(()))?;
        let (model, baked) =
            replay(&problem, &moments, (Some(ScalarKind::F64), true), |_, _| Ok(()))?;
        assert!(model.starts_with("full"), "{model}");
        assert_eq!((own.len(), baked.len()), (31, 31));
        // What cells hand on is no part that sweeps remove: they would go on for it to their last.
        assert!(baked.iter().all(|tick| tick.sweeps < 2000), "{cells:?}");
        let sometimes = |output: usize| own.iter().any(|tick| tick.outputs[output] > Some(0.1));
        assert!([0, 1].into_iter().all(sometimes), "edges hold, and are saturated");
        for (own, baked) in own.iter().zip(&baked) {
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

/// Outputs, total and window of ticks from `first` on.
fn played<R: Bakes>(controller: &mut Controller<R>, ticks: std::ops::Range<u32>) -> Vec<Vec<R>> {
    let tick = |at| {
        let (mut numbers, report) = controller.tick(&inputs(at).map(R::narrow)).expect("a tick");
        numbers.push(report.verdict.certificate().expect("a bound").total);
        numbers.push(controller.window().expect("a window").energy);
        numbers
    };
    ticks.map(tick).collect()
}

fn stepping<R: Bakes>(problem: &Problem) -> Result<Baked<R>> {
    match Choice::<R>::new(problem, Wanted::default())?.candidates.pop().expect("a model").model {
        Model::Full(baked) => Ok(*baked),
        Model::Condensed(_) => panic!("a condensed model"),
    }
}

/// A tick that is refused leaves u, s and B, and a reset goes back to the start.
#[test]
fn a_refused_tick_advances_nothing_and_a_reset_all() -> Result<()> {
    let baked = stepping::<f32>(&heated(Cells::Mixed, "")?)?;
    let mut controller = Controller::<f32>::new(&baked);
    let whole = played(&mut controller, 1..9);
    controller.reset();
    let start = controller.window();
    let first = played(&mut controller, 1..5);
    for refused in
        [[9.0, 1.0, 0.2, 0.0, 0.0], [f32::NAN, 1.0, 0.2, 0.0, 0.0], [0.0, 1.0, 0.2, 0.0, -0.6]]
    {
        let before = controller.window();
        assert!(controller.tick(&refused).is_err());
        assert_eq!(controller.window(), before);
    }
    let then = played(&mut controller, 5..9);
    assert_eq!([first, then].concat(), whole);
    controller.reset();
    assert_eq!(controller.window(), start);
    assert_eq!(Controller::<f32>::new(&baked).window(), start);
    Ok(())
}

/// The bits of a module are those of this machine's controller, in both scalars.
#[test]
fn a_module_steps_with_the_same_bits() -> Result<()> {
    let main = |scalar: &str| {
        let log: Vec<_> = (1..9).map(|at| format!("{:?}", inputs(at))).collect();
        format!(
            "
fn main() {{
    let mut controller = Box::new(Controller::new());
    for inputs in [{}] {{
        let answer = controller.tick(Inputs::from_array(inputs.map(|x: f64| x as {scalar}))).unwrap();
        let total = answer.report.verdict.certificate().unwrap().total;
        let window = controller.window().unwrap().energy;
        println!(\"{{:?}} {{total:?}} {{window:?}}\", answer.outputs.to_array());
    }}
}}
",
            log.join(", ")
        )
    };
    let told =
        |numbers: &[f64], total: f64, window: f64| format!("{numbers:?} {total:?} {window:?}\n");
    let problem = heated(Cells::Triangles, "")?;
    let baked = stepping::<f64>(&problem)?;
    let mut controller = Controller::<f64>::new(&baked);
    let expected: String = played(&mut controller, 1..9)
        .iter()
        .map(|numbers| match &numbers[..] {
            [outputs @ .., total, window] => told(outputs, *total, *window),
            _ => String::new(),
        })
        .collect();
    assert_eq!(printed(&(source(&baked) + &main("f64"))), expected);
    Ok(())
}

/// A coefficient that moves has no condensed steps; data that leave a step no bound are refused.
#[test]
fn what_no_controller_steps_is_refused() -> Result<()> {
    let refused = |stated: &str, instead: &str| -> Result<String> {
        let scene = HEATED.replace(stated, instead);
        let problem = on_grid(&scene, grid(4, Cells::Triangles))?.1;
        let choice = Choice::<f64>::new(&problem, Wanted::default());
        Ok(choice.err().map_or_else(String::new, |error| error.to_string()))
    };
    let why = refused("setting.share = 1e-9", "setting.model = \"condensed\"")?;
    assert!(why.contains("it changes the matrix"), "{why}");
    let why = refused("gap = \"0.35\"", "gap = \"0.35*x^2\"")?;
    assert!(why.contains("not linear along an edge"), "{why}");
    let why = refused("time.step = 0.05", "")?;
    assert!(why.contains("time.step: missing"), "{why}");
    Ok(())
}

/// A state that is restored goes on with the same bits, before the first tick too; a foreign or a damaged one changes nothing.
#[test]
fn a_state_goes_on_with_the_same_bits() -> Result<()> {
    let log: Vec<_> = (1..9).map(|at| format!("{:?}", inputs(at))).collect();
    let program = format!(
        "
const LOG: [[f32; INPUTS]; 8] = [{}];

fn play(controller: &mut Controller, ticks: core::ops::Range<usize>) -> Vec<u32> {{
    LOG[ticks].iter().flat_map(|inputs| {{
        let answer = controller.tick(Inputs::from_array(*inputs)).unwrap();
        let window = controller.window().unwrap().energy;
        let sweeps = answer.report.sweeps;
        answer.outputs.to_array().map(f32::to_bits).into_iter().chain([window.to_bits(), sweeps])
    }}).collect()
}}

fn main() {{
    let (mut first, mut second) = (Box::new(Controller::new()), Box::new(Controller::new()));
    let start = first.state();
    play(&mut first, 0..4);
    let state = first.state();
    let expected = play(&mut first, 4..8);
    play(&mut second, 2..7);
    second.restore(&state).unwrap();
    assert_eq!(play(&mut second, 4..8), expected);
    assert!(first.state() == second.state());
    let mut damaged = state;
    let words = size_of::<State>() / 4;
    for at in [0, 2, 4, 40, words - 2] {{
        let bits = &raw mut damaged as *mut u32;
        unsafe {{ *bits.add(at) ^= 1 << 22 }};
        let before = second.state();
        let refused = second.restore(&damaged).unwrap_err();
        let expected = if at == 0 {{ Error::ForeignState }} else {{ Error::DamagedState }};
        assert_eq!(refused, expected, \"{{at}}\");
        assert!(second.state() == before);
        damaged = state;
    }}
    second.restore(&start).unwrap();
    let mut fresh = Box::new(Controller::new());
    assert_eq!(play(&mut second, 0..3), play(&mut fresh, 0..3));
    println!(\"the same\");
}}
",
        log.join(", ")
    );
    for cells in [Cells::Triangles, Cells::Mixed] {
        let baked = stepping::<f32>(&heated(cells, "")?)?;
        assert_eq!(printed(&(source(&baked) + &program)), "the same\n", "{cells:?}");
    }
    Ok(())
}

/// The bytes of a state in firmware are those of this machine's controller, which goes on from them, and refuses others.
#[test]
fn a_state_of_firmware_goes_on_at_the_desk() -> Result<()> {
    let log: Vec<_> = (1..5).map(|at| format!("{:?}", inputs(at))).collect();
    let program = format!(
        "
fn main() {{
    let mut controller = Box::new(Controller::new());
    for inputs in [{}] {{
        controller.tick(Inputs::from_array(inputs.map(|x: f64| x as f32))).unwrap();
    }}
    let state = controller.state();
    // The last four bytes may be none of its.
    let bytes = unsafe {{ std::slice::from_raw_parts((&raw const state).cast::<u8>(), size_of::<State>() - 4) }};
    println!(\"{{bytes:?}}\");
}}
",
        log.join(", ")
    );
    let problem = heated(Cells::Triangles, "")?;
    let baked = stepping::<f32>(&problem)?;
    let told = printed(&(source(&baked) + &program));
    let [mut one, mut other] = [(); 2].map(|()| Controller::<f32>::new(&baked));
    played(&mut one, 1..5);
    let state = one.state().expect("a state");
    assert_eq!(told.trim(), format!("{:?}", &state[..state.len() - 4]));
    let then = played(&mut one, 5..9);
    played(&mut other, 3..6);
    let before = other.state();
    for at in [0, 9, 16, state.len() - 5] {
        let mut damaged = state.clone();
        damaged[at] ^= 1;
        assert!(other.restore(&damaged).is_err(), "{at}");
    }
    for foreign in [&state[..8], &state[..state.len() - 8], &vec![0; state.len()], &[]] {
        assert!(other.restore(foreign).is_err());
    }
    assert_eq!(other.state(), before);
    other.restore(&state).expect("its own state");
    assert_eq!(played(&mut other, 5..9), then);
    Ok(())
}
