//! Condensed controllers that step in time: beside this machine's own steps, and bit for bit with the module.

use super::steps::{HEATED, near};
use super::{Budget, ScheduledTick, play, replay};
use signorini_bake::Bakes;
use signorini_bake::choice::{Choice, Wanted};
use signorini_bake::compiled::printed;
use signorini_bake::condensed::Controller;
use signorini_bake::emit::emit;
use signorini_bake::module_api::hash;
use signorini_problem::Problem;
use signorini_problem::fixtures::{changed, on_grid};
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_solve::ScalarKind;

const WIND: &str = "input.wind = { of = \"dirichlet\", field = \"coefficient\", pattern = \"1\", default = 1.0, range = [0.1, 2.0] }\n";

const BOUND: &str = "output.bound = { kind = \"bound\" }\n";

/// The heated scene in a wind that stays, by this setting.
fn heated(cells: Cells, setting: &str) -> Result<Problem> {
    let stays = [
        (WIND, ""),
        (BOUND, ""),
        ("coefficient = \"0\"", "coefficient = \"1\""),
        ("setting.share = 1e-9", setting),
    ];
    Ok(on_grid(&changed(HEATED, &stays), grid(4, cells))?.1)
}

const CONDENSED: &str = "setting.certificate = false\nsetting.memory = ";

/// The values of the inputs in a step.
fn inputs(at: u32) -> [f64; 4] {
    let (t, jump) = (f64::from(at), f64::from(at / 7 % 2));
    [3.0 * (0.4 * t).sin(), 0.5 * jump + 0.2, 0.1 * (0.2 * t).sin(), 0.4 - 0.9 * jump]
}

fn moments(count: u32) -> Vec<ScheduledTick> {
    let of = |at: u32| ScheduledTick {
        time: 0.05 * f64::from(at),
        inputs: inputs(at).into_iter().enumerate().collect(),
    };
    (1..=count).map(of).collect()
}

/// By how much outputs of the condensed controller are off those of this machine's own steps, at most.
fn off(cells: Cells, memory: &str) -> Result<f64> {
    let moments = moments(30);
    let full = heated(cells, "setting.share = 1e-9")?;
    let budget = Budget { intervals: false, ..Budget::of(&full.scene) };
    let own = play(&full, None, &moments, &budget, |_, _| Ok(()))?;
    let problem = heated(cells, &format!("{CONDENSED}{memory}"))?;
    let (model, baked) = replay(&problem, &moments, (Some(ScalarKind::F64), true), |_, _| Ok(()))?;
    assert!(model.starts_with("condensed with"), "{model}");
    assert_eq!((own.len(), baked.len()), (31, 31));
    let mut most = 0.0_f64;
    for (own, baked) in own.iter().zip(&baked).skip(1) {
        assert!(baked.bound.is_none() && baked.window.is_none());
        let [own, baked] = [own, baked].map(|of| &of.outputs[..4]);
        for (own, baked) in own.iter().zip(baked) {
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

fn chosen<R: Bakes>(problem: &Problem) -> Result<Choice<R>> {
    Choice::new(problem, Wanted::default())
}

/// Outputs of ticks, and what they leave.
fn played<R: Bakes>(controller: &mut Controller<R>, ticks: std::ops::Range<u32>) -> Vec<Vec<R>> {
    let tick = |at| {
        let (mut outputs, _) = controller.tick(&inputs(at).map(R::narrow)).expect("a tick");
        outputs.truncate(4);
        outputs.extend(controller.past());
        outputs
    };
    ticks.map(tick).collect()
}

/// A tick that is refused leaves everything, bit for bit, and a reset goes back to the start.
#[test]
fn a_refused_tick_advances_nothing_and_a_reset_all() -> Result<()> {
    let swept = "\nsetting.model = \"condensed\"\nsetting.solver = \"sweeps\"";
    for setting in [format!("{CONDENSED}6{swept}"), "setting.memory = 6".to_owned()] {
        let choice = chosen::<f32>(&heated(Cells::Mixed, &setting)?)?;
        let (baked, _) = choice.condensed().expect("a condensed model");
        let mut controller = Controller::<f32>::new(baked);
        let start = controller.past().to_vec();
        let whole = played(&mut controller, 1..9);
        controller.reset();
        assert_eq!(controller.past(), start);
        let first = played(&mut controller, 1..5);
        for refused in [[9.0, 0.2, 0.0, 0.0], [f32::NAN, 0.2, 0.0, 0.0], [0.0, 0.2, 0.0, -0.6]] {
            let before = controller.past().to_vec();
            assert!(controller.tick(&refused).is_err());
            assert_eq!(controller.past(), before);
        }
        assert_eq!([first, played(&mut controller, 5..9)].concat(), whole);
    }
    Ok(())
}

/// The bits of a module, and of its state, are those of this machine's controller; a state that is restored goes on with them, and a foreign or a damaged
/// one changes nothing.
#[test]
fn a_module_steps_and_goes_on_with_the_same_bits() -> Result<()> {
    let log: Vec<_> = (1..9).map(|at| format!("{:?}", inputs(at))).collect();
    let main = format!(
        "
const LOG: [[f64; INPUTS]; 8] = [{}];

fn play(controller: &mut Controller, ticks: core::ops::Range<usize>) -> String {{
    LOG[ticks].iter().map(|inputs| {{
        let answer = controller.tick(Inputs::from_array(inputs.map(|x| x as Scalar))).unwrap();
        let window = controller.window().map(|window| window.energy);
        format!(\"{{:?}} {{window:?}}\\n\", answer.outputs.to_array())
    }}).collect()
}}

fn main() {{
    let (mut first, mut second) = (Box::new(Controller::new()), Box::new(Controller::new()));
    let start = first.state();
    print!(\"{{}}\", play(&mut first, 0..4));
    let state = first.state();
    // The last four bytes may be none of its.
    let bytes = unsafe {{ std::slice::from_raw_parts((&raw const state).cast::<u8>(), size_of::<State>() - 4) }};
    println!(\"{{bytes:?}}\");
    let expected = play(&mut first, 4..8);
    print!(\"{{expected}}\");
    play(&mut second, 2..7);
    second.restore(&state).unwrap();
    assert_eq!(play(&mut second, 4..8), expected);
    second.restore(&start).unwrap();
    let whole = play(&mut second, 0..8);
    first.reset();
    assert_eq!(play(&mut first, 0..8), whole);
    let mut damaged = first.state();
    let bits = &raw mut damaged as *mut u32;
    unsafe {{ *bits.add(9) ^= 1 << 22 }};
    let before = first.state();
    assert_eq!(first.restore(&damaged), Err(Error::DamagedState));
    unsafe {{ *bits ^= 1 }};
    assert_eq!(first.restore(&damaged), Err(Error::ForeignState));
    assert!(first.state() == before);
}}
",
        log.join(", ")
    );
    let swept = "\nsetting.model = \"condensed\"\nsetting.solver = \"sweeps\"";
    for setting in
        [format!("{CONDENSED}6"), format!("{CONDENSED}6{swept}"), "setting.memory = 6".to_owned()]
    {
        let problem = heated(Cells::Triangles, &setting)?;
        let choice = chosen::<f32>(&problem)?;
        let (baked, _) = choice.condensed().expect("a condensed model");
        let [mut one, mut other] = [(); 2].map(|()| Controller::new(baked));
        let first = told(&mut one, 1..5);
        let state = one.state(hash(&problem)).expect("a state");
        let then = told(&mut one, 5..9);
        let expected = format!("{first}{:?}\n{then}", &state[..state.len() - 4]);
        assert_eq!(printed(&(emit(&problem, &choice).source + &main)), expected);
        played(&mut other, 3..8);
        assert!(other.restore(hash(&problem), &state[..state.len() - 8]).is_err());
        other.restore(hash(&problem), &state).expect("its own state");
        assert_eq!(told(&mut other, 5..9), then);
    }
    Ok(())
}

/// Outputs and the bound of the evolution, as the program prints them.
fn told(controller: &mut Controller<f32>, ticks: std::ops::Range<u32>) -> String {
    let tick = |at| {
        let (outputs, _) = controller.tick(&inputs(at).map(f32::narrow)).expect("a tick");
        let window = controller.window().map(|window| window.energy);
        format!("{outputs:?} {window:?}\n")
    };
    ticks.map(tick).collect()
}

/// With the states that it gets by itself the bound over time is at most a tenth above that with all of them.
#[test]
fn a_condensed_model_gets_the_states_that_its_bound_needs() -> Result<()> {
    let few = |setting: &str| -> Result<(usize, f64)> {
        let problem = heated(Cells::Mixed, setting)?;
        let choice = chosen::<f64>(&problem)?;
        let (baked, _) = choice.condensed().expect("a condensed model");
        let mut controller = Controller::new(baked);
        for at in 1..60 {
            controller.tick(&inputs(at)).expect("a tick");
        }
        let states = baked.steps.as_ref().expect("steps").count();
        Ok((states, controller.window().expect("a bound over time").energy))
    };
    let ((by_itself, window), (all, least)) =
        (few("setting.model = \"condensed\"")?, few("setting.memory = 1000")?);
    assert!(by_itself < all / 2, "{by_itself} of {all}");
    assert!(window < 1.1 * least, "{window} {least}");
    Ok(())
}

/// Error bounds of a tick by the controller in its scalar, and by the host for the same terms and x, which is never above.
fn bounds<R: Bakes>(problem: &Problem) -> Result<Vec<[f64; 2]>> {
    let choice = chosen::<R>(problem)?;
    let (baked, origin) = choice.condensed().expect("a condensed model");
    let mut controller = Controller::new(baked);
    let tick = |at| {
        let inputs = inputs(at).map(R::narrow);
        let past = controller.past().to_vec();
        let (_, report) = controller.tick(&inputs).expect("a tick");
        let wide = |all: &[R]| all.iter().map(|x| x.wide()).collect::<Vec<_>>();
        let mut terms = [vec![1.0], wide(&inputs), wide(&past)].concat();
        terms.truncate(origin.recovered().inputs);
        let host = origin.recovered().bound(&terms, &wide(controller.x())).expect("a bound");
        [report.certificate().expect("a bound").total.wide(), host]
    };
    Ok((1..30).map(tick).collect())
}

/// The bound of a step by a controller: that of the host, with what its scalar rounds, and near that of the full model's step.
#[test]
fn a_condensed_step_has_the_bound_of_its_form() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        let problem = heated(cells, "setting.memory = 24")?;
        for [found, host] in bounds::<f64>(&problem)? {
            assert!(found >= host && found < host * (1.0 + 1e-6), "{found} {host}");
        }
        for [found, host] in bounds::<f32>(&problem)? {
            assert!(found >= host && found < 1.2 * host, "f32: {found} {host}");
        }
        let moments = moments(30);
        let full = heated(cells, "setting.share = 1e-9")?;
        let budget = Budget { intervals: false, ..Budget::of(&full.scene) };
        let own = play(&full, None, &moments, &budget, |_, _| Ok(()))?;
        let (_, baked) = replay(&problem, &moments, (Some(ScalarKind::F64), true), |_, _| Ok(()))?;
        for (own, baked) in own.iter().zip(&baked).skip(1) {
            let pairs = [
                [own, baked].map(|of| of.bound.expect("a bound").total),
                [own, baked].map(|of| of.window.expect("a bound over time")[0]),
            ];
            for [own, found] in pairs {
                assert!(found > 0.7 * own && found < 1.6 * own, "{cells:?}: {found} {own}");
            }
        }
    }
    Ok(())
}

/// Data whose steps have no bound are refused where one is asked for, and states where nothing stores.
#[test]
fn what_has_no_condensed_steps_is_refused() -> Result<()> {
    let why = |problem: &Problem| {
        chosen::<f64>(problem).err().map_or_else(String::new, |error| error.to_string())
    };
    let bent = changed(
        HEATED,
        &[
            (WIND, ""),
            (BOUND, ""),
            ("coefficient = \"0\"", "coefficient = \"1\""),
            ("gap = \"0.35\"", "gap = \"0.35*x^2\""),
            ("setting.share = 1e-9", "setting.memory = 6"),
        ],
    );
    let (_, problem) = on_grid(&bent, grid(4, Cells::Triangles))?;
    assert!(why(&problem).contains("not linear along an edge"), "{}", why(&problem));
    let without = changed(
        &bent,
        &[("setting.memory = 6", "setting.memory = 6\nsetting.certificate = false")],
    );
    let (_, problem) = on_grid(&without, grid(4, Cells::Triangles))?;
    assert_eq!(why(&problem), "");
    let steady = changed(
        HEATED,
        &[
            (", capacity = \"2\"", ""),
            ("output.sure = { kind = \"window\" }\n", ""),
            ("time.step = 0.05\n", ""),
            ("setting.share = 1e-9", "setting.memory = 6"),
        ],
    );
    let (_, problem) = on_grid(&steady, grid(4, Cells::Triangles))?;
    assert!(why(&problem).contains("no material has a capacity"), "{}", why(&problem));
    Ok(())
}
