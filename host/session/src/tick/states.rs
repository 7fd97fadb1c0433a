//! States of controllers that step in time: bit for bit with the module, and as many as a condensed model needs.

use super::steps::{CONDENSED, SHARE, STILL, SWEPT, both, changed_heater, inputs, still, told};
use crate::with_module;
use signorini_bake::Bakes;
use signorini_bake::choice::{Choice, Wanted};
use signorini_bake::compiled::printed;
use signorini_bake::condensed::Controller;
use signorini_bake::emit::emit;
use signorini_bake::narrow::narrow;
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::Cells;
use signorini_solve::ScalarKind;

fn chosen<R: Bakes>(problem: &Problem) -> Result<Choice<R>> {
    Choice::new(problem, Wanted::default())
}

/// A program that prints four ticks, the bytes of the state then, and four ticks more; it checks that a state that is restored goes on
/// with the same bits, before the first tick too, and that a foreign or a damaged one changes nothing.
fn program(problem: &Problem) -> String {
    let log: Vec<_> = (1..9).map(|at| format!("{:?}", inputs(problem, at))).collect();
    format!(
        "
const LOG: [[f64; INPUTS]; 8] = [{}];

fn play(controller: &mut Controller, ticks: core::ops::Range<usize>) -> String {{
    LOG[ticks].iter().map(|inputs| {{
        let answer = controller.tick(Inputs::from_array(inputs.map(|x| x as Scalar))).unwrap();
        let total = answer.report.certificate().map(|of| of.total);
        let window = controller.window().map(|window| window.energy);
        let sweeps = answer.report.sweeps;
        format!(\"{{:?}} {{total:?}} {{window:?}} {{sweeps}}\\n\", answer.outputs.to_array())
    }}).collect()
}}

fn main() {{
    let [mut first, mut second, mut fresh] = [(); 3].map(|()| Box::new(Controller::new()));
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
    assert!(first.state() == second.state());
    let words = size_of::<State>() / 4;
    for at in [0, 2, 4, 9, 40, words - 2] {{
        let mut damaged = state;
        let bits = &raw mut damaged as *mut u32;
        unsafe {{ *bits.add(at.min(words - 2)) ^= 1 << 22 }};
        let before = second.state();
        let expected = if at == 0 {{ Error::ForeignState }} else {{ Error::DamagedState }};
        assert_eq!(second.restore(&damaged), Err(expected), \"{{at}}\");
        assert!(second.state() == before);
    }}
    second.restore(&start).unwrap();
    let whole = play(&mut fresh, 0..8);
    assert_eq!(play(&mut second, 0..8), whole);
    first.reset();
    assert_eq!(play(&mut first, 0..8), whole);
}}
",
        log.join(", ")
    )
}

/// The bits of a module, and of its state, are those of this machine's controller, which goes on from that state, and refuses others.
fn same_bits<R: Bakes>(scalar: ScalarKind, problem: &Problem) -> Result<()> {
    let module = emit(problem, &chosen::<R>(problem)?).source;
    let printed = printed(&(module + &program(problem)));
    with_module(problem, Some(scalar), |session, _| {
        let first = told::<R>(problem, session, 1..5)?;
        let state = session.state().expect("a state");
        let then = told::<R>(problem, session, 5..9)?;
        assert_eq!(printed, format!("{first}{:?}\n{then}", &state[..state.len() - 4]));
        session.restart();
        told::<R>(problem, session, 3..8)?;
        let before = session.state();
        for at in [0, 9, 16, state.len() - 5] {
            let mut damaged = state.clone();
            damaged[at] ^= 1;
            assert!(session.set_state(&damaged).is_err(), "{at}");
        }
        for foreign in [&state[..8], &state[..state.len() - 8], &vec![0; state.len()], &[]] {
            assert!(session.set_state(foreign).is_err());
        }
        assert_eq!(session.state(), before);
        session.set_state(&state)?;
        assert_eq!(told::<R>(problem, session, 5..9)?, then);
        Ok(())
    })
}

#[test]
fn a_module_steps_and_goes_on_with_the_same_bits() -> Result<()> {
    let (f32, f64) = (ScalarKind::F32, ScalarKind::F64);
    same_bits::<f64>(f64, &changed_heater(Cells::Triangles, &[])?)?;
    for cells in [Cells::Triangles, Cells::Mixed] {
        same_bits::<f32>(f32, &changed_heater(cells, &[])?)?;
    }
    for setting in
        [format!("{CONDENSED}6"), format!("{CONDENSED}6{SWEPT}"), "setting.memory = 6".to_owned()]
    {
        same_bits::<f32>(f32, &still(Cells::Triangles, &setting)?)?;
    }
    Ok(())
}

/// With the states that it gets by itself the bound over time is at most a tenth above that with all of them.
#[test]
fn a_condensed_model_gets_the_states_that_its_bound_needs() -> Result<()> {
    let few = |setting: &str| -> Result<(usize, f64)> {
        let problem = still(Cells::Mixed, setting)?;
        let choice = chosen::<f64>(&problem)?;
        let (baked, _) = choice.condensed().expect("a condensed model");
        let mut controller = Controller::new(baked);
        for at in 1..60 {
            controller.tick(&inputs(&problem, at)).expect("a tick");
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
        let inputs: Vec<R> = narrow(&inputs(problem, at));
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
        let problem = still(cells, "setting.memory = 24")?;
        for [found, host] in bounds::<f64>(&problem)? {
            assert!(found >= host && found < host * (1.0 + 1e-6), "{found} {host}");
        }
        for [found, host] in bounds::<f32>(&problem)? {
            assert!(found >= host && found < 1.2 * host, "f32: {found} {host}");
        }
        for both in &both(&still(cells, SHARE)?, &problem, "condensed")?[1..] {
            let pairs = [
                both.each_ref().map(|of| of.bound.expect("a bound").total),
                both.each_ref().map(|of| of.window.expect("a bound over time")[0]),
            ];
            for [own, found] in pairs {
                assert!(found > 0.7 * own && found < 1.6 * own, "{cells:?}: {found} {own}");
            }
        }
    }
    Ok(())
}

/// A coefficient that moves has no condensed steps; data whose steps have no bound are refused where one is asked for, and states where
/// nothing stores.
#[test]
fn what_no_controller_steps_is_refused() -> Result<()> {
    let bent = ("gap = \"0.35\"", "gap = \"0.35*x^2\"");
    let steady = [
        (", capacity = \"2\"", ""),
        ("output.sure = { kind = \"window\" }\n", ""),
        ("time.step = 0.05\n", ""),
        (SHARE, "setting.memory = 6"),
    ];
    let still = |setting| [&STILL[..], &[bent, (SHARE, setting)]].concat();
    let cases: [(&[(&str, &str)], &str); 6] = [
        (&[(SHARE, "setting.model = \"condensed\"")], "it changes the matrix"),
        (&[bent], "not linear along an edge"),
        (&[("time.step = 0.05", "")], "time.step: missing"),
        (&still("setting.memory = 6"), "not linear along an edge"),
        (&still("setting.memory = 6\nsetting.certificate = false"), ""),
        (&steady, "no material has a capacity"),
    ];
    for (changes, expected) in cases {
        let refused = chosen::<f64>(&changed_heater(Cells::Triangles, changes)?).err();
        let why = refused.map_or_else(String::new, |error| error.to_string());
        assert!(why.contains(expected) && why.is_empty() == expected.is_empty(), "{why}");
    }
    Ok(())
}
