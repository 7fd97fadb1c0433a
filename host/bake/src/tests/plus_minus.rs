//! Intervals of controllers' outputs hold for all inputs within the ranges: against meshes that are refined twice.

use std::path::{Path, PathBuf};

use signorini_certify::ErrorBound;
use signorini_intervals::{Coverage, of_outputs};
use signorini_problem::Problem;
use signorini_problem::functional::wanted;
use signorini_problem::inputs::{InputSpace, drawn};
use signorini_scene::error::Result;
use signorini_scene::mesh::{self, adapted};
use signorini_scene::scene::Scene;
use signorini_session::{Module, with_module};
use signorini_solve::outputs::outputs;
use signorini_solve::{Options, ScalarKind, SolverKind, solve};
use signorini_tolerances::some;

/// What is known of an output, or why nothing is.
type Known<T> = std::result::Result<T, String>;

/// What a tick says of its outputs.
struct Told {
    values: Vec<f64>,
    plus_minus: Vec<Known<f64>>,
    between: Vec<Known<[f64; 2]>>,
}

/// Inputs that are tried: drawn ones, corners of the ranges among them.
const TRIED: usize = 12;

fn on_mesh(scene: &Scene, refine: u32) -> Result<Problem> {
    Problem::new(scene, adapted::adapted(mesh::read(&scene.mesh.value)?, None, refine)?)
}

/// The outputs on a finer mesh.
fn exact(problem: &Problem, inputs: &[f64]) -> Result<Vec<Option<f64>>> {
    let problem = problem.with_inputs(inputs)?;
    let options = Options { solver: SolverKind::Factor, ..Options::default() };
    let mut values = outputs(&problem, &solve(&problem, &options)?)?;
    let all = wanted(&problem.scene);
    Ok(all.iter().map(|output| values.remove(&output.name.value).flatten()).collect())
}

/// Outputs with an interval of one answer, and the largest distance from what the finer meshes say, over the half-width.
fn holds(
    name: &str,
    [once, twice]: [&Problem; 2],
    Told { values, plus_minus, between }: &Told,
    inputs: &[f64],
) -> Result<usize> {
    let (once, twice) = (exact(once, inputs)?, exact(twice, inputs)?);
    let mut count = 0;
    for (at, (by, ends)) in plus_minus.iter().zip(between).enumerate() {
        assert_eq!(by.is_ok(), ends.is_ok(), "{name}, output {at}");
        let (Ok(by), Ok(ends), Some(once), Some(twice)) = (by, ends, once[at], twice[at]) else {
            continue;
        };
        let moved = (twice - once).abs();
        let apart = (twice - values[at]).abs() - moved;
        assert!(apart <= *by, "{name}, output {at} at {inputs:?}: {} ± {by}, {twice}", values[at]);
        let beyond = (ends[0] - twice).max(twice - ends[1]) - moved;
        assert!(beyond <= 0.0, "{name}, output {at} at {inputs:?}: {twice} is not in {ends:?}");
        count += 1;
    }
    Ok(count)
}

fn path(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/scenes");
    folder.join(name).with_extension("toml")
}

fn checked(name: &str, scene: &Scene, scalar: ScalarKind) -> Result<usize> {
    let meshes = [on_mesh(scene, 0)?, on_mesh(scene, 1)?, on_mesh(scene, 2)?];
    let [own, once, twice] = &meshes;
    with_module(own, Some(scalar), |session, module: &Module| {
        let mut counts = Vec::new();
        for inputs in drawn::<f64>(&InputSpace::of(scene), TRIED) {
            session.tick(&inputs)?;
            let answer = session.answer(&own.with_inputs(&inputs)?)?;
            let plus_minus = module.plus_minus(answer.bound.as_ref());
            let between = module.between(session, &answer.outputs, answer.bound.as_ref());
            let told = Told { values: answer.outputs, plus_minus, between };
            counts.push(holds(name, [once, twice], &told, &inputs)?);
        }
        assert!(counts.iter().all(|count| *count == counts[0]), "{name}: {counts:?}");
        Ok(counts[0])
    })
}

#[test]
fn every_output_of_the_standard_scenes_is_within_its_interval() -> Result<()> {
    let scenes = [("levee", 1), ("slab", 1), ("strip", 1), ("pit", 1), ("antiicing", 6)];
    let in_both = |of| [ScalarKind::F32, ScalarKind::F64].map(|scalar| (of, scalar));
    for ((name, with_interval), scalar) in some(3, scenes.into_iter().flat_map(in_both)) {
        let scene = Scene::read(&path(name))?;
        assert_eq!(checked(name, &scene, scalar)?, with_interval, "{name}");
    }
    Ok(())
}

/// A list is the sum of what each of its boundaries has, in every model, and its interval holds what finer meshes say.
#[test]
fn outputs_over_a_list_are_sums_with_one_interval() -> Result<()> {
    const LISTS: &str = r#"
[output]
crest = { kind = "flux", of = "crest" }
river = { kind = "flux", of = "river" }
out = { kind = "flux", of = ["seepage face", "crest"] }
pressed = { kind = "force", of = ["crest", "seepage face"] }
of_face = { kind = "force", of = "seepage face" }
of_crest = { kind = "force", of = ["crest"] }
"#;
    // All that takes flux: 0, of which a tick in f32 leaves what its sums round.
    const THROUGH: &str =
        "through = { kind = \"flux\", of = [\"crest\", \"river\", \"seepage face\"] }";
    let path = path("levee");
    for model in ["condensed", "full"] {
        let text = Scene::read(&path)?.text.to_string() + LISTS;
        let with = |more: &str| {
            Scene::parse(&format!("{text}{more}\n[setting]\nmodel = \"{model}\"\n"), &path)
        };
        let scene = with("")?;
        let scalar = if model == "full" { ScalarKind::F64 } else { ScalarKind::F32 };
        // The intervals of both models are weighed alike.
        if model == "condensed" {
            assert!(checked("levee", &scene, scalar)? >= 2);
        }
        let scene = with(THROUGH)?;
        let problem = on_mesh(&scene, 0)?;
        with_module(&problem, Some(scalar), |session, module: &Module| {
            for inputs in drawn::<f64>(&InputSpace::of(&scene), TRIED) {
                session.tick(&inputs)?;
                let answer = session.answer(&problem.with_inputs(&inputs)?)?;
                let [seepage, _, _, crest, river, out, pressed, face, top, through] =
                    answer.outputs[..]
                else {
                    panic!("{:?}", answer.outputs)
                };
                let sizes = [seepage, crest, river, pressed].map(f64::abs);
                let size = sizes.into_iter().fold(0.0, f64::max);
                for (sum, parts) in [
                    (out, seepage + crest),
                    (through, seepage + crest + river),
                    (pressed, face + top),
                ] {
                    let is_near = (sum - parts).abs() <= 1e-5 * size;
                    assert!(is_near, "{model} at {inputs:?}: {:?}", answer.outputs);
                }
                let by = module.plus_minus(answer.bound.as_ref());
                assert!(by[5].is_ok(), "{model}: {by:?}");
            }
            Ok(())
        })?;
    }
    Ok(())
}

/// With its supplies off by default the mats are a wall of a given flux there, and contact at every other input.
#[test]
fn defaults_at_which_a_flux_is_given_say_nothing_of_other_inputs() -> Result<()> {
    let path = path("antiicing");
    let text = Scene::read(&path)?
        .text
        .replace("default = 1.0\nrange = [0.4, 1.1]", "default = 0.0\nrange = [0.0, 1.1]");
    let off = Scene::parse(&text, &path)?;
    let on = Scene::read(&path)?;
    let weights = |scene: &Scene| {
        with_module(&on_mesh(scene, 0)?, Some(ScalarKind::F64), |_, module: &Module| {
            let bound = ErrorBound { total: 1.0, ..ErrorBound::default() };
            Ok(module.plus_minus(Some(&bound)))
        })
    };
    assert_ne!(off.text, on.text);
    // What may be contact is the same, and so is what is known of it.
    for (off, on) in weights(&off)?.into_iter().zip(weights(&on)?) {
        assert_eq!(off.is_ok(), on.is_ok());
        if let (Ok(off), Ok(on)) = (off, on) {
            assert!((off / on - 1.0).abs() < 1e-9, "{off} {on}");
        }
    }
    Ok(())
}

fn median(mut ratios: Vec<f64>) -> f64 {
    ratios.sort_by(f64::total_cmp);
    ratios[ratios.len() / 2]
}

/// A tick's own s and τ tell more than its bound: over inputs that are drawn evenly, an interval is in the median at most so many
/// times that of a solve with the same inputs, and an output is where a solve says that it is.
#[test]
fn intervals_of_controllers_are_near_those_of_solves() -> Result<()> {
    const TICKS: usize = 120;
    // On the strip six of eight edges that touch may also be open, and s follows the gap above all of them.
    let scenes = [("levee", 2.5), ("slab", 2.5), ("strip", 3.5), ("antiicing", 2.5)];
    for (name, most) in some(2, scenes) {
        let scene = Scene::read(&path(name))?;
        let problem = on_mesh(&scene, 0)?;
        let mut ratios = vec![[Vec::new(), Vec::new()]; scene.outputs.len()];
        with_module(&problem, Some(ScalarKind::F64), |session, module: &Module| {
            let spaces = InputSpace::of(&scene);
            let all = drawn::<f64>(&spaces, TICKS).enumerate();
            // Half of all ticks are at corners of the ranges: these are not drawn evenly.
            for (_, inputs) in all.filter(|(tick, _)| tick % 4 < 2) {
                session.tick(&inputs)?;
                let at = problem.with_inputs(&inputs)?;
                let answer = session.answer(&at)?;
                let outputs = &answer.outputs[..scene.outputs.len()];
                let between = module.between(session, outputs, answer.bound.as_ref());
                let by = module.plus_minus(answer.bound.as_ref());
                let solved = of_outputs(&at, &solve(&at, &Options::default())?, Coverage::Usual);
                let all = scene.outputs.iter().zip(between.into_iter().zip(by)).zip(&mut ratios);
                for ((output, told), [narrow, wide]) in all {
                    let ((Ok([least, most]), Ok(by)), Ok(of)) = (told, &solved[&output.name.value])
                    else {
                        continue;
                    };
                    let [low, high] = of.ends();
                    assert!(least <= high && low <= most, "{name}: {least} {most} {low} {high}");
                    narrow.push((most - least) / (high - low));
                    wide.push(2.0 * by / (high - low));
                }
            }
            Ok(())
        })?;
        let mut pooled = Vec::new();
        let all = scene.outputs.iter().zip(ratios).filter(|(_, [narrow, _])| !narrow.is_empty());
        for (output, [narrow, wide]) in all {
            pooled.extend_from_slice(&narrow);
            let [narrow, wide] = [narrow, wide].map(median);
            println!("{name} {}: plus_minus {wide:.1}, between {narrow:.1}", output.name.value);
        }
        let all = median(pooled);
        println!("{name}: {all:.2}");
        assert!(all <= most, "{name}: {all}");
    }
    Ok(())
}
