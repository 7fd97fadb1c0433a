//! Ticks by a factor, where sweeps do not end: against the direct solver, on this machine and as text.

use signorini_tolerances::Tolerance;
use signorini_tolerances::bake::{
    FACTORED, FACTORED_GAP, FACTORED_NARROW, FACTORED_OBLIQUE, TICK, TICK_NARROW,
};

use signorini_device::tick::{Ended, Report};

use super::compiled::same_bits_of;
use super::setting::{scene, unbounded};
use super::{BENT, Baked, Controller, STEPS, fixtures, source, ticks};
use crate::Bakes;
use crate::choice::{Candidate, Choice, Model, Wanted};
use crate::full::sizes;
use crate::tests::of_file;
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::scene::{Scene, Target};
use signorini_scene::setting::{Method, ModelKind, Setting, Start};
use signorini_solve::{Options, Solution, SolverKind, solve};

fn factor() -> Setting {
    Setting { solver: Some(Method::Factor), ..Setting::default() }
}

/// A gap that an input lifts.
const LIFT: &str = r#"
[input]
lift = { of = "contact", field = "gap", pattern = "0.1 - 0.1*x^2", default = 0.0 }
[output]
force = { kind = "force" }
bound = { kind = "bound" }
"#;

/// A scene of the catalogue with other text here and there, and with [`LIFT`].
fn catalogue(name: &str, changes: &[(&str, &str)]) -> Problem {
    let name = format!("catalogue/{name}");
    of_file(&name, (LIFT, changes), |scene| scene.setting = Some(factor()))
}

/// Conductivity 10⁶ beside 1, exact.
fn contrast() -> Problem {
    catalogue("j100-tri", &[("\"100\"", "\"1e6\""), ("(100)", "(1e6)")])
}

/// T(3, 10⁻³): condition 10⁸. The boundary data are those of another tensor.
fn anisotropy() -> Problem {
    catalogue("t-h-tri", &[("\"10.0\", \"3.0\", \"1.0\"", "\"9000.001\", \"3000\", \"1000\"")])
}

/// The answer of the host's own direct solver for this lift.
fn reference(problem: &Problem, lift: f64) -> Result<Solution> {
    let problem = problem.with_inputs(&[lift])?;
    let direct = Options { solver: SolverKind::Direct, averages: true, ..Options::default() };
    solve(&problem, &direct)
}

fn swept(problem: &Problem) -> Result<Report<f64>> {
    let baked = Baked::<f64>::new(&problem.with_setting(None))?;
    Ok(Controller::<f64>::new(&baked).tick(&[0.0]).expect("a tick").1)
}

/// Ticks as the direct solver has them, u to `allowed` and the bound to a thousandth.
fn as_directly_solved<R: Bakes>(problem: &Problem, allowed: Tolerance) -> Result<()> {
    let baked = Baked::<R>::new(problem)?;
    let mut controller = Controller::<R>::new(&baked);
    for lift in [0.0, 0.0, 1.0, -2.0, 0.5] {
        let (outputs, report) = controller.tick(&[R::narrow(lift)]).expect("a tick");
        let solved = controller.solved().expect("a factor");
        let what = format!("{} {lift}: {solved:?} {report:?}", R::NAME);
        assert!(report.ended == Ended::Exact && report.sweeps == 0 && solved.rounds <= 8, "{what}");
        let expected = reference(problem, lift)?;
        let size = expected.u.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
        let pairs = controller.u().iter().zip(&expected.u);
        let off = pairs.fold(0.0, |most: f64, (u, expected)| most.max((u.wide() - expected).abs()));
        allowed.check_over(&what, off, size);
        let counts = problem.topology.counts;
        let openings = controller.u()[counts.free..].iter().zip(controller.lower());
        assert!(openings.clone().all(|(u, lower)| u >= lower), "{what}");
        let touching = openings.filter(|(u, lower)| u == lower).count();
        assert_eq!(touching, expected.contact_active, "{what}");
        // Of the total, rounding may be most in f32: it knows no better than ε of the largest fluxes.
        let certificate = report.verdict.certificate().expect("a bound");
        let (gap, bound) = (certificate.duality_gap.wide(), expected.bound.expect("a bound"));
        FACTORED_GAP.check_relative(&what, gap, bound.duality_gap);
        assert!(certificate.algebraic.wide() <= 0.05 * gap, "{what}");
        assert!(outputs[1] == certificate.total && outputs[1].wide() >= gap, "{what}");
    }
    Ok(())
}

#[test]
fn a_contrast_of_a_million() -> Result<()> {
    let problem = contrast();
    as_directly_solved::<f64>(&problem, FACTORED)?;
    as_directly_solved::<f32>(&problem, FACTORED_NARROW)
}

#[test]
fn an_anisotropy_of_a_hundred_million() -> Result<()> {
    let problem = anisotropy();
    assert_eq!(swept(&problem)?.ended, Ended::OutOfSweeps);
    as_directly_solved::<f64>(&problem, FACTORED_OBLIQUE)?;
    // In f32 the element matrices are those of another problem.
    let error = Baked::<f32>::new(&problem).expect_err("refused").to_string();
    assert!(error.contains("too oblique"), "{error}");
    Ok(())
}

#[test]
fn every_kind_of_input_gives_what_sweeps_give() -> Result<()> {
    let text = format!("{BENT}[setting]\nsolver = \"factor\"\n");
    for cells in [Cells::Quads, Cells::Mixed] {
        let (_, problem) = fixtures::on_grid(&text, grid(5, cells))?;
        ticks::<f64>(&problem, &STEPS, TICK)?;
    }
    let (_, problem) = fixtures::on_grid(&text, grid(5, Cells::Triangles))?;
    ticks::<f64>(&problem, &STEPS, TICK)?;
    ticks::<f32>(&problem, &STEPS, TICK_NARROW)
}

#[test]
fn the_module_has_the_bits_of_the_same_arrays() -> Result<()> {
    let problem = scene(BENT, Cells::Mixed, factor())?;
    same_bits_of::<f32>(&problem)?;
    let plain = Setting { certificate: false, start: Start::Cold, ..factor() };
    let problem = scene(unbounded(), Cells::Triangles, plain)?;
    same_bits_of::<f64>(&problem)
}

#[test]
fn a_module_without_contact() -> Result<()> {
    let contact = "kind = \"contact\", gap = \"x^3 - 0.3\", flux = \"-0.5*x^2\"";
    let rain = "input.rain = { of = \"contact\", field = \"flux\", pattern = \"-1 - x\" }\n";
    let force = "output.force = { kind = \"force\" }\noutput.length = { kind = \"length\" }\n";
    let given = (contact, "kind = \"dirichlet\", value = \"x\"");
    let changes = [given, ("field = \"gap\"", "field = \"value\""), (rain, ""), (force, "")];
    let text = fixtures::changed(unbounded(), &changes);
    let setting = Setting { certificate: false, ..factor() };
    let problem = scene(&text, Cells::Triangles, setting)?;
    same_bits_of::<f32>(&problem)
}

#[test]
fn the_factor_is_counted() -> Result<()> {
    let problem = scene(BENT, Cells::Triangles, factor())?;
    let swept = scene(BENT, Cells::Triangles, Setting { solver: None, ..factor() })?;
    let (with, without) = (Baked::<f32>::new(&problem)?, Baked::<f32>::new(&swept)?);
    let (counts, entries) = (problem.topology.counts, with.entries().expect("a factor"));
    // Every free unknown but the last few is coupled with another one.
    assert!(entries > counts.free && without.entries().is_none());
    // Eight contact edges: one block, S and tableau.
    assert_eq!(counts.contact, 8);
    let flash = entries * 6 + counts.free * (2 + 4) + (counts.free + 1) * 4 + 256 + 8 * 4 + 8;
    assert_eq!(sizes(&with).flash - sizes(&without).flash, flash);
    assert_eq!(sizes(&with).ram - sizes(&without).ram, 256 + 8 * (6 * 4 + 2));
    assert!(source(&with).contains("static ENTRIES") && !source(&without).contains("Factor"));
    Ok(())
}

/// Entries of the factor of a candidate.
fn entries<R: Bakes>(candidate: &Candidate<R>) -> Option<usize> {
    match &candidate.model {
        Model::Full(baked) => baked.entries(),
        Model::Condensed(_) => None,
    }
}

#[test]
fn bake_takes_the_factor_where_sweeps_do_not_end() -> Result<()> {
    let asked = anisotropy();
    let with = |solver| asked.with_setting(Some(Setting { solver, ..Setting::default() }));
    let choose = |problem: &Problem| Choice::<f64>::new(problem, Wanted::model(ModelKind::Full));
    let choice = choose(&with(None))?;
    let [factored, swept] = &choice.candidates[..] else { panic!("two models") };
    assert!(choice.chosen == 0 && entries(factored).is_some() && entries(swept).is_none());
    assert!(factored.trial.settled && !swept.trial.settled);
    assert!(factored.trial.rounds[0] > 0 && factored.trial.sweeps == [0, 0]);
    assert!(factored.needs.flash > swept.needs.flash && factored.needs.ram > swept.needs.ram);
    for (solver, expected) in [(Method::Sweeps, false), (Method::Factor, true)] {
        let choice = choose(&with(Some(solver)))?;
        let [only] = &choice.candidates[..] else { panic!("one model") };
        assert_eq!(entries(only).is_some(), expected, "{solver:?}");
    }
    // Where there is no room for the factor.
    let flash = Some(factored.needs.flash - 1);
    let target = Target { flash, ram: None, tick: None, clock: None };
    let open = with(None);
    let small = Scene { target: Some(target), ..Scene::clone(&open.scene) };
    let choice = choose(&open.restated(small))?;
    assert!(entries(choice.candidate()).is_none());
    Ok(())
}

#[test]
fn bake_takes_the_one_that_costs_less() -> Result<()> {
    let (_, coarse) = fixtures::on_grid(BENT, grid(2, Cells::Triangles))?;
    for problem in [coarse, super::standard("strip", |_| ())] {
        let choice = Choice::<f32>::new(&problem, Wanted::model(ModelKind::Full))?;
        let costs: Vec<_> = choice.candidates.iter().map(|of| of.needs.instructions()).collect();
        let [Some(first), Some(second)] = costs[..] else { panic!("{costs:?}") };
        let all_settled = choice.candidates.iter().all(|of| of.trial.settled);
        assert!(first <= second && all_settled, "{costs:?}");
        assert!(entries(choice.candidate()).is_some(), "{costs:?}");
    }
    Ok(())
}

/// `cargo xtask firmware meshes/scenes/slab.toml --board m4-192k --full` played 6.26 million instructions in the median once. Most
/// of its quads are no parallelograms, and their certificates take twelve times as long as those of others.
#[test]
fn cells_in_which_a_varies_have_their_own_price() -> Result<()> {
    let problem = super::standard("slab", |_| ());
    let choice = Choice::<f32>::new(&problem, Wanted::model(ModelKind::Full))?;
    let factored = choice.candidates.iter().find(|of| entries(of).is_some());
    let needs = factored.expect("a factor").needs.instructions().expect("a price");
    let seen = 6.26e6;
    assert!((0.9 * seen..1.1 * seen).contains(&needs), "{needs} for {seen}");
    Ok(())
}
