//! The bits of a replay are those of the module that `bake` writes, compiled.

use std::path::Path;

use super::columns::bounds_csv;
use super::{Budget, ScheduledTick, TickRecord, play, replay, schedule};
use signorini_bake::choice::{Choice, Model, Wanted};
use signorini_bake::compiled::printed;
use signorini_bake::module_api::ModuleApi;
use signorini_bake::{condensed, full};
use signorini_problem::Problem;
use signorini_problem::fixtures::on_grid;
use signorini_scene::error::Result;
use signorini_scene::mesh;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::scene::Scene;
use signorini_scene::setting::{Method, ModelKind, Setting, Start};
use signorini_solve::{Ending, Options, ScalarKind, SolverKind, solve};
use signorini_tolerances::Tolerance;
use signorini_tolerances::solve::{ENDED_STEPS, ZERO, ZERO_NARROW, ZERO_SWEPT};

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

/// A tick without inputs.
fn at(time: f64) -> ScheduledTick {
    ScheduledTick { time, inputs: Vec::new() }
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
    let (model, ticks) = replay(&problem, &moments, (None, false), |_, _| Ok(()))?;

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

/// Steps whose contact opens and closes, each to this residual and by the direct solver on K + M/dt: the largest distance of u over its
/// range, and how often an edge has changed sides.
fn off_by(scalar: ScalarKind, tolerance: f64, cells: Cells) -> Result<(f64, usize)> {
    let text = r#"
mesh = "grid"
material.default = { conductivity = "2 + x", capacity = 1 }
boundary.dirichlet = { kind = "dirichlet", value = "0.2 + 0.1*sin(9*t)" }
boundary.contact = { kind = "contact", gap = "0.05*x" }
source.f = "6*sin(12*t + 4*x)"
time = { step = 0.02, end = 0.5 }
"#;
    let problem = on_grid(text, grid(10, cells))?.1;
    let own = Budget { scalar, tolerance: Some(tolerance), ..Budget::of(&problem.scene) };
    let budget = Budget { intervals: false, ..own };
    let moments = schedule::moments_after(&problem.scene, None, None)?;
    let (mut reference, mut found) = (problem.clone(), (0.0_f64, 0));
    let mut before = 0;
    play(&problem, None, &moments, &budget, |tick, solution| {
        let solution = solution.expect("an answer");
        if tick.status == Ending::Start {
            reference = problem.stepping(0.02, solution.state())?;
            return Ok(());
        }
        assert_eq!(tick.status.name(), "converged");
        reference.set_time(tick.time)?;
        let direct = Options { solver: SolverKind::Direct, ..Options::default() };
        let exact = solve(&reference, &direct)?;
        let ends = exact.u.iter().fold([f64::MAX, f64::MIN], |[a, b], u| [a.min(*u), b.max(*u)]);
        let apart = exact.u.iter().zip(&solution.u).map(|(a, b)| (a - b).abs());
        found.0 = found.0.max(apart.fold(0.0, f64::max) / (ends[1] - ends[0]));
        found.1 += usize::from(exact.contact_active != before);
        before = exact.contact_active;
        reference.advance(exact.state());
        Ok(())
    })?;
    Ok(found)
}

#[test]
fn a_tolerance_ends_steps_where_it_says() -> Result<()> {
    for (scalar, tolerance, cells) in [
        (ScalarKind::F64, 1e-12, Cells::Triangles),
        (ScalarKind::F64, 1e-12, Cells::Quads),
        (ScalarKind::F32, 1e-4, Cells::Triangles),
    ] {
        let (off, changes) = off_by(scalar, tolerance, cells)?;
        let what = format!("{scalar:?} to {tolerance:e} on {cells:?}");
        ENDED_STEPS.check_over(&what, off, tolerance);
        // It is the tolerance that ends them, not the default, which goes on to the last digits.
        assert!(off > 0.1 * tolerance && changes > 3, "{what}: {off:e}, {changes} changes");
    }
    Ok(())
}

/// A cold spot above a heater; `c` is in every datum of u.
fn slab(c: f64) -> Result<Problem> {
    let text = format!(
        r#"
mesh = "grid"
material.default.conductivity = "1"
boundary.dirichlet = {{ kind = "robin", coefficient = "20", ambient = "{c:?} - 10*exp(-((x-0.5)/0.4)^2)" }}
boundary.left = {{ kind = "dirichlet", value = "{c:?} + 2" }}
boundary.right = {{ kind = "dirichlet", value = "{c:?} + 2" }}
boundary.contact = {{ kind = "contact", gap = "{c:?}", flux = "0", limit = "9" }}
input.air = {{ of = "dirichlet", field = "ambient", pattern = "1", default = -1.0, range = [-3.0, 1.0] }}
output.force = {{ kind = "force" }}
output.skin = {{ kind = "mean", of = "contact" }}
output.inside = {{ kind = "probe", at = [0.21, 0.37] }}
output.bound = {{ kind = "bound" }}
"#
    );
    Ok(on_grid(&text, grid(6, Cells::Triangles))?.1)
}

/// Outputs of a tick, u without `c` and the bound without rounding; then the ends of the intervals, likewise.
fn heights(tick: &TickRecord, c: f64) -> Vec<f64> {
    let rounding = tick.bound.map_or(0.0, |bound| bound.rounding);
    let zeros = [0.0, c, c, rounding];
    let outputs = tick.outputs.iter().zip(zeros).map(|(x, zero)| x.expect("a number") - zero);
    let intervals = tick.intervals.iter().zip(zeros);
    let ends = intervals.filter_map(|(ends, zero)| Some(ends.as_ref().ok()?.map(|end| end - zero)));
    outputs.chain(ends.flatten()).collect()
}

#[test]
fn a_constant_in_all_data_of_u_is_added_to_u_alone() -> Result<()> {
    for (scalar, c, allowed, swept) in [
        (ScalarKind::F64, 273.15, ZERO, ZERO_SWEPT),
        (ScalarKind::F64, 1.3e4, ZERO, ZERO_SWEPT),
        (ScalarKind::F32, 273.15, ZERO_NARROW, ZERO_NARROW),
    ] {
        let exactly = Setting { solver: Some(Method::Factor), ..Setting::default() };
        let full = Setting { model: Some(ModelKind::Full), ..exactly };
        // A module keeps its zero of u: a thousand ranges take some digits of it.
        let settings = if c < 1e3 { &[None, Some(full)][..] } else { &[] };
        for &setting in settings {
            let replayed = |c: f64| -> Result<Vec<Vec<f64>>> {
                let problem = slab(c)?.with_setting(setting);
                let (_, ticks) = replay(&problem, &log(1), (Some(scalar), false), |_, _| Ok(()))?;
                Ok(ticks.iter().map(|tick| heights(tick, c)).collect())
            };
            same(&format!("{scalar:?}, {c}, {setting:?}"), &replayed(0.0)?, &replayed(c)?, allowed);
        }
        let played = |c: f64| -> Result<Vec<Vec<f64>>> {
            let problem = slab(c)?;
            let budget = Budget { scalar, ..Budget::of(&problem.scene) };
            let ticks = play(&problem, None, &log(1), &budget, |_, _| Ok(()))?;
            Ok(ticks.iter().map(|tick| heights(tick, c)).collect())
        };
        same(&format!("{scalar:?}, {c}, played"), &played(0.0)?, &played(c)?, swept);
    }
    Ok(())
}

fn same(what: &str, near: &[Vec<f64>], far: &[Vec<f64>], allowed: Tolerance) {
    assert_eq!(near.len(), far.len());
    for (tick, (near, far)) in near.iter().zip(far).enumerate() {
        assert_eq!(near.len(), far.len(), "{near:?} {far:?}");
        for (near, far) in near.iter().zip(far) {
            let what = format!("{what}, tick {tick}: {far} and {near}");
            allowed.check_over(what, far - near, near.abs().max(1.0));
        }
    }
}

/// The left half stores u, the right one does if `right` is not 0; `zero` is in every datum of u.
fn storing(right: f64, zero: f64, step: f64) -> Scene {
    let text = format!(
        r#"
mesh = "grid"
material.left = {{ conductivity = "1", capacity = "2" }}
material.right = {{ conductivity = "3", capacity = "{right:?}" }}
source.f = "8*sign(cos(9*t))"
boundary.dirichlet = {{ kind = "robin", coefficient = "5", ambient = "{zero:?} + x" }}
boundary.contact = {{ kind = "contact", gap = "{zero:?}" }}
output.heat = {{ kind = "content" }}
output.cold = {{ kind = "content", of = "left" }}
output.mean = {{ kind = "mean", of = "right" }}
output.sure = {{ kind = "window" }}
output.step = {{ kind = "bound" }}
time.step = {step}
"#
    );
    Scene::parse(&text, Path::new("storing.toml")).expect("a scene")
}

/// `parts` steps a tick of length `dt`, with the data at the end of the tick.
fn stored(right: f64, zero: f64, (n, parts): (u32, u32)) -> Result<Vec<TickRecord>> {
    let (dt, ticks) = (0.1, 10);
    let scene = storing(right, zero, dt / f64::from(parts));
    let problem = Problem::new(&scene, grid(n, Cells::Triangles))?;
    let moments = (1..=ticks).flat_map(|tick| (0..parts).map(move |_| tick));
    let moments: Vec<_> = moments.map(|tick| at(f64::from(tick) * dt)).collect();
    let budget = Budget { shows_start: false, ..Budget::of(&scene) };
    let ticks = play(&problem, None, &moments, &budget, |_, _| Ok(()))?;
    Ok(ticks.into_iter().skip(parts as usize - 1).step_by(parts as usize).collect())
}

/// A finer mesh with a quarter of the step says what is true. Both begin from the same steady state.
#[test]
fn contents_and_means_lie_between_what_the_bound_of_the_evolution_says() -> Result<()> {
    for (right, zero) in [(1.0, 0.0), (1.0, 273.15), (0.0, 0.0)] {
        let (coarse, fine) = (stored(right, zero, (4, 1))?, stored(right, zero, (16, 4))?);
        let mut ratios = Vec::new();
        for (tick, truth) in coarse.iter().zip(&fine) {
            for at in 0..3 {
                let Some([least, most]) = tick.over_time[at] else {
                    assert!(at == 2 && right == 0.0, "output {at}, {right}");
                    continue;
                };
                let (value, own) = (truth.outputs[at].unwrap(), tick.outputs[at].unwrap());
                assert!(least <= value && value <= most, "{at}: {value} in [{least}, {most}]");
                assert!(least <= own && own <= most, "{at}: {own} in [{least}, {most}]");
                ratios.push(0.5 * (most - least) / (value - 0.5 * (least + most)).abs());
            }
            // Where nothing stores u the evolution says nothing of it.
            assert_eq!(tick.over_time[2].is_some(), right > 0.0);
            assert_eq!(tick.over_time[3..], [None, None]);
            assert_eq!(tick.outputs[3], tick.window.map(|[energy, _]| energy));
            assert_eq!(tick.outputs[4], tick.bound.map(|bound| bound.total));
        }
        println!("{right}, {zero}: {ratios:.1?}");
    }
    Ok(())
}

/// Controllers say how far their evolution is off, as the desk's own ticks do: contents and means lie in what that leaves.
#[test]
fn controllers_have_intervals_of_what_is_stored() -> Result<()> {
    let text = storing(1.0, 0.0, 0.1).text;
    let heat = "8*sign(cos(9*t))";
    assert!(text.contains(heat));
    let text =
        text.replace(heat, "0") + "input.q = { of = \"source\", field = \"f\", pattern = \"8\" }\n";
    let moments = |parts: usize| -> Vec<_> {
        let tick = |k: u32| {
            let time = 0.1 * f64::from(k);
            ScheduledTick { time, inputs: vec![(0, (9.0 * time).cos().signum())] }
        };
        (1..=10).flat_map(|k| vec![tick(k); parts]).collect()
    };
    let played = |(n, parts): (u32, usize)| -> Result<Vec<TickRecord>> {
        let mut scene = Scene::parse(&text, Path::new("a.toml"))?;
        scene.set_step(0.1 / parts as f64);
        let problem = Problem::new(&scene, grid(n, Cells::Triangles))?;
        let budget = Budget { shows_start: false, ..Budget::of(&scene) };
        let ticks = play(&problem, None, &moments(parts), &budget, |_, _| Ok(()))?;
        Ok(ticks.into_iter().skip(parts - 1).step_by(parts).collect())
    };
    let (truth, plain) = (played((16, 4))?, played((4, 1))?);
    for (model, scalar) in ["full", "condensed"]
        .into_iter()
        .flat_map(|model| [ScalarKind::F32, ScalarKind::F64].map(|scalar| (model, scalar)))
    {
        let text = format!("{text}setting.model = \"{model}\"\n");
        let scene = Scene::parse(&text, Path::new("a.toml"))?;
        let problem = Problem::new(&scene, grid(4, Cells::Triangles))?;
        // The condensed one has a single state.
        let wider = if model == "full" { 1.3 } else { 2.0 };
        let asked = (Some(scalar), false);
        let (name, ticks) = replay(&problem, &moments(1), asked, |_, _| Ok(()))?;
        assert!(name.starts_with(model), "{name}");
        for ((tick, truth), plain) in ticks.iter().zip(&truth).zip(&plain) {
            assert!(tick.window.is_some());
            assert_eq!(tick.outputs[3], tick.window.map(|[energy, _]| energy), "{name}");
            for at in 0..3 {
                let ([least, most], value) =
                    (tick.over_time[at].unwrap(), truth.outputs[at].unwrap());
                assert!(
                    least <= value && value <= most,
                    "{name}: {at}: {value} in [{least}, {most}]"
                );
                let [below, above] = plain.over_time[at].unwrap();
                assert!(
                    most - least <= wider * (above - below),
                    "{name}: {at}: {least} {most}, {below} {above}"
                );
            }
        }
    }
    Ok(())
}

/// u = x at all times: a controller has the error that its bound over time is for, and without a certificate neither.
#[test]
fn controllers_know_the_error_over_time_where_they_have_a_certificate() -> Result<()> {
    for (model, certificate) in
        [("full", true), ("condensed", true), ("full", false), ("condensed", false)]
    {
        let text = format!(
            r#"
mesh = "grid"
material.default = {{ conductivity = "1", capacity = "1" }}
boundary.dirichlet = {{ kind = "dirichlet", value = "x" }}
boundary.contact = {{ kind = "contact", gap = "-5" }}
exact = {{ u = "x", gradient = ["1", "0"] }}
setting = {{ model = "{model}", certificate = {certificate} }}
time = {{ step = 0.1, initial = "x" }}
"#
        );
        let (_, problem) = on_grid(&text, grid(4, Cells::Triangles))?;
        let moments: Vec<_> = (1..4).map(|tick| at(0.1 * f64::from(tick))).collect();
        let (_, ticks) = replay(&problem, &moments, (None, true), |_, _| Ok(()))?;
        assert_eq!(ticks.len(), 4);
        for tick in &ticks[1..] {
            let found = tick.window_error.zip(tick.window);
            assert_eq!(found.is_some(), certificate, "{model}, {certificate}: {tick:?}");
            assert!(found.is_none_or(|(error, [energy, _])| error <= energy), "{model}: {found:?}");
        }
    }
    Ok(())
}

/// s − ψ of a start that touches is a sum of rounded numbers: it is 0 for the controller, too, whatever the gap.
#[test]
fn condensed_steps_in_f32_have_their_bound_over_time_from_any_gap() -> Result<()> {
    for (cells, gap) in [Cells::Triangles, Cells::Quads].into_iter().flat_map(|cells| {
        (-4..8).map(move |k| (cells, format!("{} + 0.15*x", 0.05 * f64::from(k))))
    }) {
        let text = format!(
            r#"
mesh = "grid"
material.default = {{ conductivity = "1", capacity = "1" }}
boundary.dirichlet = {{ kind = "robin", coefficient = "2", ambient = "4*x - 1" }}
boundary.contact = {{ kind = "contact", gap = "{gap}" }}
input.air = {{ of = "dirichlet", field = "ambient", pattern = "1" }}
setting.model = "condensed"
time.step = 0.1
"#
        );
        let (_, problem) = on_grid(&text, grid(4, cells))?;
        let moments: Vec<_> = (1..4).map(|tick| at(0.1 * f64::from(tick))).collect();
        for scalar in [ScalarKind::F32, ScalarKind::F64] {
            let (model, ticks) = replay(&problem, &moments, (Some(scalar), true), |_, _| Ok(()))?;
            assert!(
                model.starts_with("condensed") && ticks[0].contact_length > Some(0.0),
                "{model}"
            );
            let windows = ticks.iter().map(|tick| tick.window);
            assert!(
                windows.clone().all(|of| of.is_some()),
                "{gap}: {:?}",
                windows.collect::<Vec<_>>()
            );
        }
    }
    Ok(())
}

/// What comes in and is not let out is stored: ∫ c u follows the balance of each step.
#[test]
fn the_content_follows_the_balance_of_its_steps() -> Result<()> {
    let scene = storing(1.0, 0.0, 0.1);
    let out = "\noutput.out = { kind = \"flux\", of = [\"dirichlet\", \"contact\"] }\n";
    let text = scene.text.to_string() + out;
    let problem = Problem::new(&Scene::parse(&text, Path::new("a.toml"))?, grid(4, Cells::Mixed))?;
    let moments = [0.1, 0.2, 0.5].map(at);
    let budget = Budget { intervals: false, ..Budget::of(&problem.scene) };
    let ticks = play(&problem, None, &moments, &budget, |_, _| Ok(()))?;
    for (before, after) in ticks.iter().zip(&ticks[1..]) {
        let of = |tick: &TickRecord, at: usize| tick.outputs[at].expect("a value");
        let stored = of(after, 0) - of(before, 0);
        let loads = 16.0 * (9.0 * after.time).cos().signum();
        let balance = 0.1 * (loads + of(after, 5));
        assert!((stored - balance).abs() < 1e-3 * stored.abs().max(0.1), "{stored} {balance}");
    }
    Ok(())
}

/// A plate that cools above a heater, `a` times as conductive and as heavy as another one.
fn cooling(a: f64) -> Result<Vec<TickRecord>> {
    let text = format!(
        r#"
mesh = "grid"
material.default = {{ conductivity = "{a:?}", capacity = "{a:?}" }}
source.f = "0"
boundary.dirichlet = {{ kind = "robin", coefficient = "{:?}", ambient = "-8*x - 4*t" }}
boundary.left = {{ kind = "dirichlet", value = "2" }}
boundary.right = {{ kind = "dirichlet", value = "2" }}
boundary.contact = {{ kind = "contact", gap = "0", flux = "0" }}
time = {{ step = 0.1, end = 0.4 }}
output.skin = {{ kind = "mean", of = "contact" }}
output.inside = {{ kind = "probe", at = [0.21, 0.37] }}
output.out = {{ kind = "flux", of = "dirichlet" }}
"#,
        20.0 * a
    );
    let (scene, problem) = on_grid(&text, grid(4, Cells::Mixed))?;
    let moments = [0.1, 0.2, 0.3].map(at);
    let ticks = play(&problem, None, &moments, &Budget::of(&scene), |_, _| Ok(()))?;
    let names = String::from_utf8(bounds_csv(&scene, &ticks).expect("a table")).expect("text");
    let header = "t,skin_step_least,skin_step_most,inside_cell_step_least,inside_cell_step_most";
    assert!(names.starts_with(header), "{names}");
    Ok(ticks)
}

#[test]
fn intervals_of_steps_are_those_of_any_units() -> Result<()> {
    let (plain, heavy) = (cooling(1.0)?, cooling(1e9)?);
    let mut found = 0;
    for (plain, heavy) in plain.iter().zip(&heavy) {
        for (at, unit) in [1.0, 1.0, 1e9].into_iter().enumerate() {
            let [Some(Ok(plain)), Some(Ok(heavy))] =
                [plain, heavy].map(|tick| tick.intervals.get(at))
            else {
                continue;
            };
            found += 1;
            for (plain, heavy) in plain.iter().zip(heavy) {
                let off = (plain - heavy / unit).abs();
                assert!(off < 1e-6 * (plain.abs() + 1.0), "{at}: {plain} {heavy}");
            }
        }
    }
    // The start has none.
    assert_eq!(found, 9);
    Ok(())
}

/// Units of A and of u that are far from 1: contents of controllers are those of this machine's own ticks.
#[test]
fn contents_of_controllers_are_in_the_units_of_the_scene() -> Result<()> {
    for (k, u) in [(1e12, 1.0), (1e-12, 1.0), (1.0, 1e6), (5e4, 300.0)] {
        for model in ["full", "condensed"] {
            let text = format!(
                r#"
mesh = "grid"
material.default = {{ conductivity = "{k:e}", capacity = "{k:e}" }}
boundary.dirichlet = {{ kind = "dirichlet", value = "{u:e}" }}
boundary.contact = {{ kind = "contact", gap = "0" }}
output.heat = {{ kind = "content" }}
output.mean = {{ kind = "mean", of = "default" }}
time = {{ step = 0.1, initial = "{u:e}" }}
setting = {{ model = "{model}" }}
"#
            );
            let (_, problem) = on_grid(&text, grid(3, Cells::Triangles))?;
            let moments = [at(0.1), at(0.2)];
            let asked = (Some(ScalarKind::F64), false);
            let (_, baked) = replay(&problem, &moments, asked, |_, _| Ok(()))?;
            let budget = Budget { shows_start: false, ..Budget::of(&problem.scene) };
            let own = play(&problem, None, &moments, &budget, |_, _| Ok(()))?;
            for (baked, own) in baked.iter().zip(&own) {
                let pairs = baked.outputs.iter().zip(&own.outputs);
                for (baked, own) in pairs.map(|(a, b)| (a.unwrap(), b.unwrap())) {
                    assert!((baked - own).abs() <= 1e-6 * own.abs(), "{model}: {baked} {own}");
                }
            }
        }
    }
    Ok(())
}

/// u ≤ ψ: what is stated below the gap stays there.
#[test]
fn a_stated_start_below_an_upper_gap_is_not_moved() -> Result<()> {
    let text = r#"
mesh = "grid"
material.default = { conductivity = "1", capacity = "1" }
boundary.dirichlet = { kind = "dirichlet", value = "0" }
boundary.contact = { kind = "contact", gap = "2", flux = "-inf", limit = "0" }
output.heat = { kind = "content" }
time = { step = 0.1, initial = "0" }
"#;
    let (_, problem) = on_grid(text, grid(2, Cells::Triangles))?;
    let budget = Budget { shows_start: true, ..Budget::of(&problem.scene) };
    let ticks = play(&problem, None, &[at(0.1), at(0.2)], &budget, |_, _| Ok(()))?;
    let heat = ticks.iter().map(|tick| tick.outputs[0].expect("a value").abs());
    assert!(heat.fold(0.0, f64::max) < 1e-12, "{ticks:?}");
    Ok(())
}

/// u = x² stands still: beside a large transfer coefficient s of a condensed start is another one than that of a solve, and its error too.
#[test]
fn the_error_of_a_condensed_controller_begins_at_its_own_start() -> Result<()> {
    let text = r#"
mesh = "grid"
material.default = { conductivity = "1", capacity = "1" }
source.f = "-2"
boundary.dirichlet = { kind = "robin", coefficient = "1e4", ambient = "x^2" }
boundary.left = { kind = "neumann", flux = "2" }
boundary.right = { kind = "neumann", flux = "2" }
boundary.contact = { kind = "contact", gap = "-5" }
exact = { u = "x^2", gradient = ["2*x", "0"] }
setting = { model = "condensed", memory = 2 }
time = { step = 0.1, initial = "x^2" }
"#;
    for cells in [Cells::Triangles, Cells::Quads] {
        let (_, problem) = on_grid(text, grid(2, cells))?;
        let moments: Vec<_> = (1..4).map(|tick| at(0.1 * f64::from(tick))).collect();
        let asked = (Some(ScalarKind::F64), false);
        let (_, ticks) = replay(&problem, &moments, asked, |_, _| Ok(()))?;
        for tick in &ticks {
            let (error, [energy, _]) = (tick.window_error.unwrap(), tick.window.unwrap());
            assert!(error <= energy, "{cells:?}: {error} {energy}");
        }
        let [first, .., last] = [&ticks[0], &ticks[2]].map(|tick| tick.window_error.unwrap());
        assert!(first > 0.95 * last, "{cells:?}: nothing moves, {first} {last}");
    }
    Ok(())
}

/// Both ends of the flux are one, so that the data give it: an interval of no width would leave out what a sum rounds.
#[test]
fn a_flux_that_the_data_give_has_no_interval() -> Result<()> {
    let text = r#"
mesh = "grid"
material.default.conductivity = "1"
boundary.dirichlet = { kind = "dirichlet", value = "1" }
boundary.contact = { kind = "contact", gap = "0", flux = "0.38962", limit = "0.38962" }
input.level = { of = "dirichlet", field = "value", pattern = "1" }
output.through = { kind = "flux", of = "contact" }
"#;
    for model in ["full", "condensed"] {
        let text = format!("{text}setting.model = \"{model}\"\n");
        let (_, problem) = on_grid(&text, grid(3, Cells::Triangles))?;
        let asked = (Some(ScalarKind::F32), false);
        let (_, ticks) = replay(&problem, &[at(0.0)], asked, |_, _| Ok(()))?;
        let why = ticks[0].intervals[0].as_ref().unwrap_err();
        assert!(why.contains("the data give it"), "{model}: {why}");
    }
    Ok(())
}
