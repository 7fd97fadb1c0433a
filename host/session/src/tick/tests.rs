//! The bits of a replay are those of the module that `bake` writes, compiled.

use std::path::Path;

use super::{ScheduledTick, replay};
use signorini_bake::choice::{Choice, Model, Wanted};
use signorini_bake::compiled::printed;
use signorini_bake::module_api::ModuleApi;
use signorini_bake::{condensed, full};
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_scene::mesh;
use signorini_scene::scene::Scene;
use signorini_scene::setting::{Method, ModelKind, Setting, Start};

/// A program whose module prints, for a log, the bits of the outputs, the sweeps and the end of each tick.
fn main(ticks: &[Vec<f32>]) -> String {
    let log: Vec<_> = ticks.iter().map(|inputs| format!("{inputs:?}")).collect();
    format!(
        "
fn main() {{
    let mut controller = Box::new(Controller::new());
    for inputs in [{}] {{
        let answer = controller.tick(Inputs::from_array(inputs)).unwrap();
        let bits = answer.outputs.to_array().map(f32::to_bits);
        println!(\"{{bits:?}} {{}} {{:?}}\", answer.report.sweeps, answer.report.ended);
    }}
}}
",
        log.join(", ")
    )
}

/// A slow drift with jumps and a tick that repeats another.
fn log(inputs: usize) -> Vec<ScheduledTick> {
    let values = [0.0, 0.01, 0.02, 0.3, 0.3, 0.05, 0.04];
    let moment = |(at, value): (usize, &f64)| ScheduledTick {
        time: at as f64,
        inputs: (0..inputs).map(|input| (input, value / (1.0 + input as f64))).collect(),
    };
    values.iter().enumerate().map(moment).collect()
}

/// `OutOfWork` as `ticks.csv` has it.
fn word(ended: &str) -> String {
    let parts = ended.split_inclusive(|_: char| true).map(|letter| match letter {
        letter if letter.chars().all(char::is_uppercase) => format!("-{}", letter.to_lowercase()),
        letter => letter.to_owned(),
    });
    parts.collect::<String>().trim_start_matches('-').to_owned()
}

/// Replays a log of the scene in this setting, and compares with the module; the controller's name.
fn same_bits(name: &str, setting: Option<Setting>) -> Result<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/scenes").join(name);
    let scene = Scene { setting, ..Scene::read(&path)? };
    let problem = Problem::new(&scene, mesh::read(&scene.mesh.value)?)?;
    let moments = log(scene.inputs.len());
    let (model, ticks) = replay(&problem, &moments, None, |_, _| Ok(()))?;

    let choice = Choice::<f32>::new(&problem, Wanted::default())?;
    let module = match &choice.candidate().model {
        Model::Condensed(baked) => condensed::source(&ModuleApi::new(&problem), baked),
        Model::Full(baked) => full::source(baked),
    };
    let narrow = |moment: &ScheduledTick| moment.inputs.iter().map(|(_, x)| *x as f32).collect();
    let inputs: Vec<Vec<f32>> = moments.iter().map(narrow).collect();
    let of_module = printed(&(module + &main(&inputs)));
    assert_eq!(of_module.lines().count(), ticks.len());
    for (line, tick) in of_module.lines().zip(&ticks) {
        let bits = tick.outputs.iter().map(|x| (x.expect("a number") as f32).to_bits());
        let (numbers, ended) = line.rsplit_once(' ').expect("an end");
        assert_eq!(numbers, format!("{:?} {}", bits.collect::<Vec<_>>(), tick.sweeps), "{name}");
        assert_eq!(word(ended), tick.status.name(), "{name}");
    }
    Ok(model)
}

#[test]
fn the_levee_is_replayed_condensed() -> Result<()> {
    assert_eq!(same_bits("levee.toml", None)?, "condensed, exact method, f32");
    Ok(())
}

#[test]
fn full_models_are_replayed_swept_and_by_a_factor() -> Result<()> {
    let full = Setting { model: Some(ModelKind::Full), ..Setting::default() };
    let swept = Setting { solver: Some(Method::Sweeps), ..full };
    assert_eq!(same_bits("strip.toml", Some(swept))?, "full, f32");
    let factored = Setting { solver: Some(Method::Factor), ..full };
    assert_eq!(same_bits("strip.toml", Some(factored))?, "full, by a factor, f32");
    let cut_off = Setting { sweeps: Some(9), start: Start::Cold, certificate: false, ..swept };
    assert_eq!(same_bits("strip.toml", Some(cut_off))?, "full, no error bound, f32");
    Ok(())
}
