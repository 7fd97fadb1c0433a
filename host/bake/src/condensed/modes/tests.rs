//! Ticks with any coefficient give what a solve with that coefficient gives, with the bits of the module.

use std::path::Path;

use signorini_certify::exact::distance;
use signorini_condense::{condense, modal};
use signorini_kernel::Error;
use signorini_problem::Problem;
use signorini_problem::fixtures::{distorted, on_grid, scatter, scene};
use signorini_scene::error::Result;
use signorini_scene::mesh;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::scene::Scene;
use signorini_scene::setting::{Method, ModelKind, Setting};
use signorini_solve::fixtures::full_at;
use signorini_solve::{Options, ScalarKind, solve};
use signorini_tolerances::bake::{GUARANTEE, MODAL, MODAL_BEST, MODAL_BOUND, MODAL_NARROW};
use signorini_tolerances::some;

use super::super::{Baked, Controller, Work, source};
use crate::Bakes;
use crate::choice::{Choice, Model, Wanted};
use crate::module_api::ModuleApi;
use crate::tests::{self, transfer::smooth};
use signorini_session::with_module;

/// Contact below, air on the right with a coefficient from 1 to 60.
const AIR: &str = r#"
mesh = "grid"
material.default.conductivity = ["2", "0.5", "1"]
source.f = "-1 - x"
boundary.dirichlet = { kind = "neumann", flux = "0.1*x" }
boundary.left = { kind = "dirichlet", value = "0.1*y" }
boundary.right = { kind = "robin", coefficient = "2", ambient = "y" }
boundary.contact = { kind = "contact", gap = "-0.3 + 0.1*x^2" }
input.gap = { of = "contact", field = "gap", pattern = "cos(3*x)/5", default = -0.3 }
input.ambient = { of = "right", field = "ambient", pattern = "1 + y", default = 0.7 }
input.h = { of = "right", field = "coefficient", pattern = "1", default = 1.5, range = [-1.0, 58.0] }
output.flux = { kind = "flux", of = "right" }
output.force = { kind = "force", of = "contact" }
output.inside = { kind = "probe", at = [0.1, 0.4] }
output.mean = { kind = "mean", of = "right" }
"#;

/// [`AIR`], where contact pushes no harder than so much.
fn limited() -> String {
    let text = AIR.replace("gap = \"-0.3", "limit = \"0.4\", gap = \"-0.3");
    text + "[output.saturated]\nkind = \"saturated\"\n"
}

/// Both ends, repetitions, jumps, and what lies between.
fn coefficient(tick: usize) -> f64 {
    match tick % 6 {
        0 | 1 => -1.0,
        2 => 58.0,
        3 => -0.999,
        _ => -1.0 + 29.5 * (1.0 + scatter(7 * (tick - tick % 2))),
    }
}

fn inputs(tick: usize) -> Vec<f64> {
    let [a, b] = [3 * tick, 3 * tick + 1].map(scatter);
    [-0.3 + 0.4 * a, 0.7 + b, coefficient(tick)].map(|x| f64::from(x as f32)).to_vec()
}

fn with(text: &str, cells: Cells, setting: Setting) -> Result<Problem> {
    let (scene, problem) = on_grid(text, distorted(grid(5, cells)))?;
    let setting = Setting { model: Some(ModelKind::Condensed), ..setting };
    let scene = Scene { setting: Some(setting), ..scene };
    Problem::new(&scene, problem.mesh)
}

/// Ticks against the direct solver on the mesh, and their bounds against those of a model of that coefficient.
fn ticks(text: &str, setting: (Cells, Setting), scalar: ScalarKind, name: &str) -> Result<()> {
    let allowed = if scalar == ScalarKind::F32 { MODAL_NARROW } else { MODAL };
    let problem = &with(text, setting.0, setting.1)?;
    let (modes, _) = modal(problem, 0.0)?;
    with_module(problem, Some(scalar), |session, found| {
        assert_eq!(found.name, name);
        let (mut touching, mut open, mut last) = (0, 0, 0.0);
        for tick in 0..24 {
            let values = inputs(tick);
            let p: Vec<f64> = std::iter::once(1.0).chain(values.iter().copied()).collect();
            let (now, solution, expected) = full_at(problem, &p)?;
            session.tick(&values)?;
            let answer = session.answer(&now)?;
            let size = solution.largest_flux();
            for (found, expected) in answer.outputs.iter().zip(&expected) {
                let expected = expected.expect("a value");
                let size = size.max(expected.abs());
                allowed.check_over(format_args!("tick {tick}"), found - expected, size);
            }
            let largest = solution.u.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
            for (found, expected) in answer.u.iter().zip(&solution.u) {
                allowed.check_over(format_args!("u of tick {tick}"), found - expected, largest);
            }
            let (active, contact) = (answer.contact_active, now.topology.counts.contact);
            (touching, open) = (touching + active, open + contact - active);
            last += answer.outputs.last().copied().unwrap_or_default();
            if scalar == ScalarKind::F64 {
                let fresh = condense(&stated(text, problem, &values)?)?;
                let x = fresh.solve(&p[..3]).expect("a solution");
                let best = fresh.bound(&p[..3], &x).expect("a bound");
                let bound = answer.bound.expect("a bound").total;
                let x = modes.in_own_scale(values[2]).solve(&p).expect("a solution");
                let of_host = modes.bound(values[2], &p, &x).expect("a bound");
                // Where s may cross the gap, host and kernel move it by other amounts: both bounds hold.
                if text == AIR {
                    MODAL_BOUND.check_relative(format_args!("tick {tick}"), bound, of_host);
                }
                MODAL_BEST.check_relative(format_args!("tick {tick}"), bound, best);
            }
        }
        assert!(touching > 5 && open > 5 && last != 0.0, "{touching} {open} {last}");
        Ok(())
    })
}

/// The scene with its coefficient as a number.
fn stated(text: &str, problem: &Problem, values: &[f64]) -> Result<Problem> {
    let text = text.split("input.h = ").next().unwrap_or_default();
    let coefficient = format!("coefficient = \"{}\"", 2.0 + values[2]);
    let fresh = scene(&text.replace("coefficient = \"2\"", &coefficient))?;
    let fresh = Problem::new(&fresh, problem.mesh.clone())?;
    fresh.with_inputs(&values[..2])
}

#[test]
fn ticks_follow_the_coefficient() -> Result<()> {
    let exact = "condensed by modes, exact method";
    let scalars = [(ScalarKind::F64, "f64"), (ScalarKind::F32, "f32")];
    let kinds = [Cells::Triangles, Cells::Quads, Cells::Mixed].into_iter();
    let kinds: Vec<_> = kinds.flat_map(|cells| scalars.map(|scalar| (cells, scalar))).collect();
    for text in [AIR, &limited()] {
        // The first and the last: triangles in f64, both kinds of cells in f32.
        for &(cells, (scalar, name)) in some(5, &kinds) {
            ticks(text, (cells, Setting::default()), scalar, &format!("{exact}, {name}"))?;
        }
    }
    let sweeps = Setting { solver: Some(Method::Sweeps), ..Setting::default() };
    for text in some(2, [AIR, &limited()]) {
        let setting = (Cells::Triangles, sweeps);
        ticks(text, setting, ScalarKind::F64, "condensed by modes, sweeps alone, f64")?;
    }
    Ok(())
}

#[test]
fn bounds_are_above_the_error_for_every_coefficient() -> Result<()> {
    for (cells, scalar) in [
        (Cells::Triangles, ScalarKind::F64),
        (Cells::Quads, ScalarKind::F64),
        (Cells::Mixed, ScalarKind::F32),
    ] {
        let problem = with(&smooth("1"), cells, Setting::default())?;
        with_module(&problem, Some(scalar), |session, _| {
            for h in [0.0625_f64, 0.5, 1.0, 16.0, 64.0] {
                let values = [h, 1.0 / h];
                session.tick(&values)?;
                let now = problem.with_inputs(&values)?;
                let answer = session.answer(&now)?;
                let exact = now.scene.exact.as_ref().expect("an exact solution");
                let error = distance(exact, &now, &answer.certified.admissible())?.combined;
                let bound = answer.bound.expect("a bound").total;
                GUARANTEE.check_at_most(format_args!("{cells:?}, {h}"), error, bound);
                assert!(bound < 4.0 * error, "{cells:?}, {h}: {bound}, {error}");
            }
            Ok(())
        })?;
    }
    Ok(())
}

#[test]
fn modes_that_are_left_out_are_paid_for() -> Result<()> {
    let work = Work { pivots: Some(40), sweeps: 4 };
    for cells in [Cells::Triangles, Cells::Quads] {
        let problem = with(&smooth("1"), cells, Setting::default())?;
        let (all, _) = modal(&problem, 0.0)?;
        let (some, recovery) = modal(&problem, 0.1)?;
        let kept = some.compliance.len();
        assert!(kept > 0 && kept + some.left_out.count == all.compliance.len(), "{kept}");
        assert!(some.left_out.count > 0 && all.left_out.count == 0);
        let baked = [&all, &some].map(|of| Baked::<f64>::modal(of, work, true).expect("in range"));
        let [mut whole, mut less] = baked.each_ref().map(Controller::new);
        for h in [0.0625_f64, 1.0, 16.0] {
            let values = [h, 1.0 / h];
            let total = |controller: &mut Controller<f64>| {
                let (_, report) = controller.tick(&values).expect("a tick");
                report.certificate().expect("a bound").total
            };
            let [best, bound] = [total(&mut whole), total(&mut less)];
            let p = some.amplitudes(h, &[1.0, h, 1.0 / h], less.x());
            let fields = recovery.admissible(&some.model, &problem, &p, less.x()).expect("s and τ");
            let now = problem.with_inputs(&values)?;
            let exact = now.scene.exact.as_ref().expect("an exact solution");
            let error = distance(exact, &now, &fields.admissible())?.combined;
            GUARANTEE.check_at_most(format_args!("{cells:?}, {h}"), error, bound);
            assert!(bound > best, "{cells:?}, {h}: {bound}, {best} with all");
        }
    }
    Ok(())
}

fn same_bits<R: Bakes>(text: &str, work: Work, certified: bool) -> Result<()> {
    let (_, problem) = on_grid(text, grid(3, Cells::Mixed))?;
    let (modes, _) = modal(&problem, 0.0)?;
    let baked = Baked::<R>::modal(&modes, work, certified).expect("numbers in range");
    let mut controller = Controller::new(&baked);
    let tick = |inputs: &[R]| controller.tick(inputs).map(|(outputs, _)| outputs);
    let mut log: Vec<_> = (0..8).map(inputs).collect();
    log[4][2] = 59.0;
    let text = source(&ModuleApi::new(&problem), &baked);
    let lines = tests::same_bits(&problem, text, &log, tick);
    assert!(lines[0] != lines[2] && lines[4] == "Err(InputOutOfRange { input: 2 })\n", "{lines:?}");
    Ok(())
}

#[test]
fn modules_have_the_same_bits() -> Result<()> {
    let exact = Work { pivots: Some(40), sweeps: 4 };
    let swept = Work { pivots: None, sweeps: 6 };
    same_bits::<f32>(AIR, exact, true)?;
    same_bits::<f64>(AIR, Work { pivots: Some(2), ..exact }, false)?;
    same_bits::<f64>(AIR, swept, true)?;
    same_bits::<f32>(&limited(), exact, true)?;
    let linear = AIR.replace("kind = \"contact\", gap = ", "kind = \"dirichlet\", value = ");
    let linear = linear.replace("field = \"gap\"", "field = \"value\"");
    same_bits::<f32>(&linear.replace("kind = \"force\"", "kind = \"flux\""), swept, true)
}

#[test]
fn what_is_refused_leaves_the_last_answer() -> Result<()> {
    let (_, problem) = on_grid(AIR, grid(4, Cells::Triangles))?;
    let (modes, _) = modal(&problem, 0.0)?;
    let work = Work { pivots: Some(40), sweeps: 4 };
    let baked = Baked::<f32>::modal(&modes, work, true).expect("numbers in range");
    assert!(baked.is_monotone, "no entry is positive on these triangles");
    let (mut one, mut other) = (Controller::new(&baked), Controller::new(&baked));
    for tick in 0..12 {
        let inputs: Vec<f32> = inputs(tick).iter().map(|&x| x as f32).collect();
        let huge = one.tick(&[1e38, inputs[1], 3.0]).expect_err("too large");
        assert!(matches!(huge, Error::NotFinite { .. }), "{huge}");
        assert_eq!(one.tick(&[0.0, 0.0, 58.5]), Err(Error::InputOutOfRange { input: 2 }));
        assert_eq!(one.tick(&inputs), other.tick(&inputs), "{tick}");
    }
    Ok(())
}

#[test]
fn what_modes_cannot_do_takes_the_full_model() -> Result<()> {
    let second = AIR
        .replace("field = \"ambient\"", "field = \"coefficient\"")
        .replace("default = 0.7", "default = 0.7, range = [0, 1]");
    let signs = AIR
        .replace("pattern = \"1\",", "pattern = \"y - 0.5\",")
        .replace("[-1.0, 58.0]", "[-1.0, 2.0]");
    for (text, reason) in [
        (second, "input.ambient.field: it changes the matrix, and one is written for all ticks"),
        (signs, "input.h.pattern: negative on an edge"),
    ] {
        let (_, problem) = on_grid(&text, grid(3, Cells::Mixed))?;
        let choice = Choice::<f32>::new(&problem, Wanted::default())?;
        assert!(matches!(choice.candidate().model, Model::Full(_)));
        assert!(choice.excluded.iter().any(|why| why.contains(reason)), "{:?}", choice.excluded);
        let wanted = Wanted::model(ModelKind::Condensed);
        assert!(Choice::<f32>::new(&problem, wanted).is_err());
    }
    Ok(())
}

#[test]
fn a_slab_in_moving_air() -> Result<()> {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/firmware/scenes");
    let scene = Scene::read(&scenes.join("slab-air.toml"))?;
    let problem = Problem::new(&scene, mesh::read(&scene.mesh.value)?)?;
    let choice = Choice::<f32>::new(&problem, Wanted { is_compared: true, ..Wanted::default() })?;
    let said = f32::explain(&problem, &choice);
    assert!(said.contains("86 of 86 modes of the coefficient's boundary kept"), "{said}");
    assert!(said.contains("Worst case, proved for all inputs"), "{said}");
    assert_eq!(choice.candidate().name, "condensed by modes, exact method");
    let ticks: Result<Vec<_>> = (0..12)
        .map(|tick| {
            let values = [5.0 * scatter(tick), 5.0 + 6.25 * ((7 * tick) % 13) as f64];
            let [a, b] = values.map(|x| f64::from(x as f32));
            Ok(([a, b], full_at(&problem, &[1.0, a, b])?))
        })
        .collect();
    let ticks = ticks?;
    for (scalar, allowed) in [(ScalarKind::F64, MODAL), (ScalarKind::F32, MODAL_NARROW)] {
        with_module(&problem, Some(scalar), |session, _| {
            for (values, (now, solution, expected)) in &ticks {
                session.tick(values)?;
                let answer = session.answer(now)?;
                assert!(answer.bound.is_some());
                for (found, expected) in answer.outputs.iter().zip(expected).take(3) {
                    let expected = expected.expect("a value");
                    let size = solution.largest_flux().max(expected.abs());
                    allowed.check_over(format_args!("{values:?}"), found - expected, size);
                }
            }
            Ok(())
        })?;
    }
    Ok(())
}

/// Points see nothing of this peak: the bound is what they miss of it, which grows with the root of the coefficient.
#[test]
fn what_points_miss_of_the_air_counts_at_every_coefficient() -> Result<()> {
    let peak = "10*max(0, 1 - abs(y - 0.51)/0.002)";
    let text = AIR
        .replace("ambient = \"y\"", &format!("ambient = \"{peak}\""))
        .replace("input.ambient = ", "input.unused = ");
    let problem = with(&text, Cells::Triangles, Setting::default())?;
    with_module(&problem, Some(ScalarKind::F64), |session, module| {
        assert!(module.name.starts_with("condensed by modes"), "{}", module.name);
        for h in [-1.0, 10.0, 58.0] {
            let inputs = [-0.3, 0.0, h];
            session.tick(&inputs)?;
            let at = problem.with_inputs(&inputs)?;
            let found = session.answer(&at)?.bound.expect("a bound");
            let expected = solve(&at, &Options::default())?.bound.expect("a bound");
            assert!(
                found.oscillation >= 0.99 * expected.oscillation,
                "{h}: {found:?} {expected:?}"
            );
        }
        Ok(())
    })
}
