//! Runs, reasons and reach on the standard scenes.

use super::{constants, found, reach::Reach, runs::runs, section};
use crate::Bakes;
use crate::choice::{Choice, Wanted};
use crate::condensed::Controller;
use crate::tests::standard as problem;
use signorini_condense::ranges::outputs::intervals;
use signorini_kernel::report::Ended;
use signorini_problem::Problem;
use signorini_problem::fixtures::on_grid;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::setting::{ModelKind, Setting};

fn choice(problem: &Problem, has_all_edges: bool) -> Choice<f32> {
    let wanted = Wanted { has_all_edges, ..Wanted::model(ModelKind::Condensed) };
    Choice::new(problem, wanted).expect("a model")
}

#[test]
fn runs_follow_each_other_and_have_all_edges() {
    for (name, breaks) in [("levee", 0), ("strip", 0), ("slab", 1)] {
        let problem = problem(name, |_| ());
        let choice = choice(&problem, false);
        let (baked, origin) = choice.condensed().expect("condensed");
        let runs = runs(&problem, origin);
        let counts = found(baked, origin);
        let of = |side| runs.iter().filter(|run| run.side == side).map(|run| run.edges).sum();
        let along: [usize; 3] = ["open", "touching", "may change"].map(of);
        let expected = [counts.always_open, counts.always_touching, counts.may_change];
        assert_eq!(along, expected, "{name}");
        assert_eq!(along.iter().sum::<usize>(), counts.contact);
        assert!(along.iter().all(|&count| count > 0), "{name}: {along:?}");
        assert_eq!(runs.iter().map(|run| run.kept).sum::<usize>(), baked.contact);
        let parted = runs.windows(2).filter(|pair| pair[0].to != pair[1].from);
        assert_eq!(parted.count(), breaks, "{name}: {runs:?}");
    }
}

#[test]
fn the_levee_touches_below_and_is_open_above() {
    let problem = problem("levee", |_| ());
    let choice = choice(&problem, false);
    let runs = runs(&problem, choice.condensed().expect("condensed").1);
    let (first, last) = (&runs[0], &runs[runs.len() - 1]);
    let seepage = ("touching", [30.0, 0.0], "\"seepage face\"");
    assert_eq!((first.side, first.from, &*first.boundary), seepage);
    assert_eq!((last.side, last.to, &*last.boundary), ("open", [12.0, 6.0], "\"crest\""));
}

#[test]
fn outputs_reach_no_further_than_is_proved() {
    for name in ["levee", "slab", "strip", "antiicing"] {
        let problem = problem(name, |_| ());
        let choice = choice(&problem, false);
        let (baked, origin) = choice.condensed().expect("condensed");
        let reach = Reach::new(&problem, baked, origin);
        assert!(reach.inputs > 1000 && reach.bound.is_some_and(|bound| bound > 0.0), "{reach:?}");
        let proved = match &origin.followed {
            Some(followed) => Some(followed.outputs.clone()),
            None => intervals(&origin.whole, &origin.sides).expect("finite loads"),
        };
        let proved = proved.expect("an enclosure");
        assert_eq!(proved.len(), reach.outputs.len());
        for (proved, seen) in proved.into_iter().zip(&reach.outputs) {
            let (proved, seen) = (proved.expect("a value"), seen.expect("a value"));
            assert!(proved.lo <= seen.lo && seen.hi <= proved.hi, "{name}: {proved:?}, {seen:?}");
            assert!(proved.width() < 1.6 * seen.width(), "{name}: {proved:?}, {seen:?}");
        }
    }
}

/// Of the controller's own ticks: its bound has the rounding of f32 too, which is small next to it.
#[test]
fn no_tick_has_a_larger_bound_than_is_proved() {
    for name in ["levee", "slab", "strip"] {
        let problem = problem(name, |_| ());
        for all_edges in [false, true] {
            let choice = choice(&problem, all_edges);
            let (baked, origin) = choice.condensed().expect("condensed");
            let limit = found(baked, origin).largest_error_bound.expect("a limit");
            let seen = Reach::new(&problem, baked, origin).bound.expect("a bound");
            assert!(seen <= limit && limit < 1.3 * seen, "{name}: {seen} of {limit}");
        }
    }
    let without = problem("levee", |scene| {
        scene.setting.get_or_insert_default().certificate = false;
    });
    let choice = choice(&without, false);
    let (baked, origin) = choice.condensed().expect("condensed");
    assert_eq!(found(baked, origin).largest_error_bound, None);
}

#[test]
fn what_is_not_proved_has_a_reason() {
    let text = |problem: &Problem, all| section(problem, &choice(problem, all));
    let levee = problem("levee", |_| ());
    let said = text(&levee, true);
    assert!(said.contains("--full-edges keeps all of them"), "{said}");
    assert!(said.contains("proved for"), "{said}");
    let without = problem("levee", |scene| scene.inputs[1].range = None);
    let said = text(&without, false);
    assert!(said.contains("Nothing is proved: \"river\" has no range"), "{said}");
    assert!(said.contains("50 may change"), "{said}");
    let neither = problem("levee", |scene| scene.inputs.iter_mut().for_each(|of| of.range = None));
    assert!(text(&neither, false).contains("\"rain\", \"river\" have no range"));
    let said = text(&problem("membrane", |scene| scene.inputs.clear()), false);
    assert!(said.contains("contact alone holds a part"), "{said}");
}

#[test]
fn a_matrix_that_follows_a_coefficient_is_told_of() {
    let problem = problem("antiicing", |_| ());
    let said = section(&problem, &choice(&problem, false));
    let parts = ["keeps all, since its matrix follows \"airspeed\"", "64 pieces", "nose_skin"];
    assert!(parts.iter().all(|part| said.contains(part)), "{said}");
}

#[test]
fn programs_are_told_of_ranges_where_there_are_any() {
    let levee = problem("levee", |_| ());
    let choice_of = |problem: &Problem| choice(problem, false);
    let full = Choice::<f32>::new(&levee, Wanted::model(ModelKind::Full)).expect("a model");
    assert!(full.condensed().is_none() && section(&levee, &full).is_empty());
    assert_eq!(crate::emit::emit(&levee, &full).chosen.ranges, None);
    let chosen = choice_of(&levee);
    let emitted = crate::emit::emit(&levee, &chosen);
    let ranges = emitted.chosen.ranges.expect("ranges");
    assert_eq!(ranges.contact, ranges.always_open + ranges.always_touching + ranges.may_change);
    let constant = format!("pub const MAY_CHANGE: usize = {};", ranges.may_change);
    assert!(emitted.source.contains(&constant) && ranges.may_change < ranges.contact);
    let without = problem("levee", |scene| scene.inputs.iter_mut().for_each(|of| of.range = None));
    let chosen = choice_of(&without);
    assert_eq!(crate::emit::emit(&without, &chosen).chosen.ranges, None);
    let (baked, origin) = chosen.condensed().expect("condensed");
    let all = constants(found(baked, origin), None);
    assert!(
        all.contains("MAY_CHANGE: usize = 50") && all.contains("ALWAYS_OPEN: usize = 0"),
        "{all}"
    );
    assert!(all.contains("LARGEST_ERROR_BOUND: Option<f64> = None;"), "{all}");
}

/// Held by a weak transfer law beside contact: openings are hundreds of times as large as their loads.
fn weakly_held(coefficient: f64, most: f64) -> Problem {
    let text = format!(
        "
mesh = \"grid\"
material.default.conductivity = \"60\"
boundary.dirichlet = {{ kind = \"robin\", coefficient = \"{coefficient}\", ambient = \"-1\" }}
boundary.left = {{ kind = \"neumann\", flux = \"0\" }}
boundary.right = {{ kind = \"neumann\", flux = \"0\" }}
boundary.contact = {{ kind = \"contact\", gap = \"-0.8\" }}
input.load = {{ of = \"left\", field = \"flux\", pattern = \"1\", range = [-{most}, {most}] }}
"
    );
    on_grid(&text, grid(6, Cells::Triangles)).expect("a sound scene").1
}

fn solves_every_tick<R: Bakes>(coefficient: f64, most: f64) {
    let problem = weakly_held(coefficient, most);
    let choice = Choice::<R>::new(&problem, Wanted::model(ModelKind::Condensed)).expect("a model");
    let (baked, origin) = choice.condensed().expect("condensed");
    let worst = baked.worst_case();
    assert!(worst.proven, "{worst:?}");
    let mut controller = Controller::new(baked);
    let mut changed = 0;
    for part in [-1.0, 1.0, 0.0, -1.0, 0.5, -0.3, 1.0, -1.0, 0.01] {
        let input = part * most;
        let (_, report) = controller.tick(&[R::narrow(input)]).expect("a tick");
        let exchanges: u32 = report.exchanges;
        assert_eq!(report.ended, Ended::Exact, "{coefficient}, load {input}");
        assert!(Some(exchanges) <= worst.exchanges, "{exchanges}");
        let p = [1.0, input];
        let x = origin.model().solve(&p).expect("a solution");
        let size = x.iter().fold(1e-9, |most: f64, x| most.max(*x));
        let off = controller.x().iter().zip(&x).map(|(own, x)| (own.wide() - x).abs());
        let off = off.fold(0.0, f64::max) / size;
        // Rounding times the condition of the matrix.
        assert!(off < 1e4 * R::EPSILON.wide() * 60.0 / coefficient, "load {input}: {off:e}");
        changed += exchanges;
    }
    assert!(changed > 0);
}

#[test]
fn weakly_held_domains_are_solved_in_every_tick() {
    solves_every_tick::<f64>(0.15, 0.1);
    solves_every_tick::<f32>(5.0, 5.0);
}

#[test]
fn ranges_that_a_scalar_cannot_hold_or_solve_for_are_refused() {
    let refused = |most: f64| {
        let problem = problem("levee", |scene| {
            scene.target = None;
            scene.inputs[0].range.as_mut().expect("a range").value[1] = most;
        });
        let wanted = || Wanted::model(ModelKind::Condensed);
        let narrow = Choice::<f32>::new(&problem, wanted()).err().map(|error| error.to_string());
        let wide = Choice::<f64>::new(&problem, wanted()).err().map(|error| error.to_string());
        (narrow.unwrap_or_default(), wide.unwrap_or_default())
    };
    for (most, expected) in [
        (1e39, "input.rain.range: f32 cannot hold its ends"),
        (1e36, "input.rain.range: its loads are too large for f32"),
    ] {
        let (narrow, wide) = refused(most);
        assert!(narrow.contains(expected) && wide.is_empty(), "{most:e}: {narrow} {wide}");
    }
    assert!(refused(1e306).1.contains("its loads are too large for f64"));
    assert_eq!(refused(1e20), (String::new(), String::new()));
}

/// Without a bound, too: rounding of f32 would move the solution by percents.
#[test]
fn what_a_scalar_cannot_tell_from_singular_is_refused() {
    for certificate in [true, false] {
        let problem = weakly_held(0.002, 0.002);
        let setting = Setting { certificate, ..Setting::default() };
        let problem = problem.with_setting(Some(setting));
        let wanted = || Wanted::model(ModelKind::Condensed);
        let refused = Choice::<f32>::new(&problem, wanted()).map(|_| ()).map_err(|e| e.to_string());
        let refusal = refused.expect_err("nearly singular");
        assert!(refusal.contains("nearly singular"), "{refusal}");
        assert!(Choice::<f64>::new(&problem, wanted()).is_ok());
    }
}
