//! Sides and worst cases of controllers that step in time, against their ticks.

use super::own::{ROUNDINGS, narrowed};
use super::section;
use crate::Bakes;
use crate::choice::{Choice, Wanted};
use crate::condensed::Controller;
use crate::emit::emit;
use crate::state;
use crate::tests::of_file;
use signorini_condense::SteppedModel;
use signorini_condense::ranges::lasting::lasting;
use signorini_condense::ranges::sides::EdgeSide;
use signorini_kernel::report::Ended;
use signorini_problem::Problem;
use signorini_problem::fixtures::{on_grid, scatter};
use signorini_problem::inputs::{InputSpace, drawn};
use signorini_problem::scalar::Scalar;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::setting::ModelKind;
use signorini_tolerances::some;

const AIR: &str = "
[input.airspeed]
of = \"outside\"
field = \"coefficient\"
pattern = \"1\"
default = 60.0
range = [5.0, 80.0]
unit = \"W/m2K\"
";

fn levee(step: &str) -> Problem {
    of_file("scenes/levee-warm", ("", &[("step = 60", step)]), |_| ())
}

/// A slab in air that keeps its speed.
fn slab(more: &[(&str, &str)]) -> Problem {
    let still = [(AIR, ""), ("coefficient = \"0\"", "coefficient = \"60\"")];
    of_file("scenes/antiicing-warm", ("", &[&still, more].concat()), |_| ())
}

/// A tensor that makes entries push on triangles, in a short step.
fn oblique() -> Problem {
    let text = "
mesh = \"grid\"
material.default = { conductivity = [\"1\", \"-0.9\", \"1\"], capacity = \"1\" }
boundary.dirichlet = { kind = \"dirichlet\", value = \"0\" }
boundary.contact = { kind = \"contact\", gap = \"-0.1\" }
time.step = 0.03
input.heat = { of = \"source\", field = \"f\", pattern = \"1\", range = [-1.0, 1.0] }
";
    on_grid(text, grid(4, Cells::Triangles)).expect("a sound scene").1
}

fn choice<R: Bakes>(problem: &Problem) -> Choice<R> {
    Choice::new(problem, Wanted::model(ModelKind::Condensed)).expect("a model")
}

#[test]
fn sides_are_told_for_all_times() {
    let problem = levee("step = 60");
    let choice = choice::<f32>(&problem);
    let said = section(&problem, &choice);
    let first = "Ranges of the inputs for all times, at a step of 60 s: of 50 contact edges 26 are always open, 18 always touch, 6 may change sides.";
    assert!(said.contains(first) && said.contains("largest opening"), "{said}");
    let kept = "The model keeps 8: those that may change, and 2 that its error bound needs.";
    assert!(said.contains(kept) && said.contains("The 42 edges that it leaves out"), "{said}");
    let emitted = emit(&problem, &choice);
    let ranges = emitted.chosen.ranges.expect("ranges");
    assert_eq!([ranges.always_open, ranges.always_touching, ranges.may_change], [26, 18, 6]);
    for part in ["pub const ALWAYS_OPEN: usize = 26;", "in every step.", "has 8 of them"] {
        assert!(emitted.source.contains(part), "{part}: {}", emitted.source);
    }
}

#[test]
fn what_is_not_proved_of_steps_has_a_reason() {
    let said = |problem: &Problem| section(problem, &choice::<f32>(problem));
    let text = said(&oblique());
    assert!(text.contains("Nothing is proved") && text.contains("a longer step"), "{text}");
    let text = said(&slab(&[]));
    // Dropped states may push, in answers of the model alone.
    assert!(
        text.contains("32 may change sides")
            && text.contains("roundings of f32, nothing is proved"),
        "{text}"
    );
}

/// The largest part of the terms of a row or a state that a tick was off by, in roundings of the scalar.
fn roundings<R: Scalar>(of: &SteppedModel, terms: &[f64], x: &[f64], after: &[f64]) -> f64 {
    let (m, n, r) = (of.inputs, of.model.contact, of.fading.len());
    let [old, new] = [&terms[m + m - 1..], &after[m - 1..]];
    let mut most = 0.0_f64;
    let mut look = |off: f64, size: f64| most = most.max(off.abs() / (R::EPSILON.wide() * size));
    for (at, ends) in of.model.ends_of(&terms[..of.model.inputs]).into_iter().enumerate() {
        let matrix = of.model.matrix[at * n..][..n].iter().zip(x).map(|(s, x)| s * x);
        let load = of.model.load.iter().zip(terms).map(|(b, p)| -b[at] * p);
        let all: Vec<f64> = matrix.chain(load).collect();
        let (residual, size) = (all.iter().sum::<f64>(), all.iter().map(|x| x.abs()).sum::<f64>());
        let off = match x[at] {
            x if x > 0.0 => residual - ends[0],
            x if x < 0.0 => residual - ends[1],
            _ => residual - residual.clamp(ends[0], ends[1]),
        };
        look(off, size);
    }
    for (at, of_contact) in of.of_contact().iter().enumerate() {
        let changes = (0..n).map(|i| -of_contact[i] * (x[i] - old[i]));
        let inputs = (0..m - 1).map(|i| -of.of_inputs[at][i] * (terms[1 + i] - terms[m + i]));
        let kept = of.fading[at] * old[n + at];
        let all: Vec<f64> = changes.chain(inputs).chain([kept]).collect();
        look(new[n + at] - all.iter().sum::<f64>(), all.iter().map(|x| x.abs()).sum());
    }
    let carried = if of.evolution.is_some() { 2 } else { 0 };
    assert_eq!(new.len(), n + r + of.corrections + carried);
    most
}

/// 300 ticks of a controller: its answers stay on their sides, and rows and states are not off by more than is taken for granted.
fn stays<R: Bakes>(problem: &Problem) -> [usize; 4] {
    let choice = choice::<R>(problem);
    let (baked, origin) = choice.condensed().expect("condensed");
    let of = narrowed::<R>(origin.steps.as_ref().expect("steps"));
    let sides = lasting(&of, &of.memory(), ROUNDINGS * R::EPSILON.wide());
    let sides = sides.expect("finite loads").expect("a box");
    let mut controller = Controller::new(baked);
    let spaces = InputSpace::of(&problem.scene);
    let wide = |of: &[R]| of.iter().map(|x| x.wide()).collect::<Vec<f64>>();
    let mut most = 0.0_f64;
    for inputs in drawn::<R>(&spaces, 300) {
        let past = wide(controller.past());
        controller.tick(&inputs).expect("a tick");
        let x = wide(controller.x());
        let terms = [&[1.0][..], &wide(&inputs), &past].concat();
        most = most.max(roundings::<R>(&of, &terms, &x, &wide(controller.past())));
        let known = sides.enclosure.as_ref().expect("an enclosure");
        for (at, x) in x.iter().enumerate() {
            assert!(known.lo[at] <= *x && *x <= known.hi[at], "{at}: {x} in {known:?}");
            match sides.of[at] {
                EdgeSide::Open => assert!(*x > 0.0, "{at}: {x}"),
                EdgeSide::Touching => assert!(*x == 0.0, "{at}: {x}"),
                EdgeSide::Saturated => assert!(*x < 0.0, "{at}: {x}"),
                EdgeSide::MayChange => (),
            }
        }
    }
    assert!(most < ROUNDINGS, "{most}");
    [EdgeSide::Open, EdgeSide::Touching, EdgeSide::Saturated, EdgeSide::MayChange]
        .map(|of| sides.count(of))
}

#[test]
fn answers_stay_where_they_are_proved_to_be() {
    // Two of the edges that never change are left.
    assert_eq!(stays::<f32>(&levee("step = 60")), [1, 1, 0, 6]);
    let warm = [("step = 1", "step = 10")];
    assert_eq!(stays::<f32>(&slab(&warm)), [0, 0, 0, 32]);
}

/// Any state after any tableau: no tick takes more exchanges than are proved, and all end with the solution.
fn exchanges<R: Bakes>(problem: &Problem) -> [u32; 2] {
    let choice = choice::<R>(problem);
    let (baked, _) = choice.condensed().expect("condensed");
    let worst = baked.worst_case();
    assert!(worst.proven, "{worst:?}");
    let limit = worst.exchanges.expect("a number");
    let mut controller = Controller::new(baked);
    let spaces = InputSpace::of(&problem.scene);
    let (mut most, mut seed) = (0, 0);
    for (tick, inputs) in drawn::<R>(&spaces, 1000).enumerate() {
        let bytes = controller.state(1).expect("a state");
        let mut numbers: Vec<R> = state::numbers(1, &bytes).expect("sound bytes");
        // From a hundredth of what steps leave to a hundred times as much.
        let size = [0.01, 1.0, 100.0][tick % 3];
        for number in &mut numbers[1 + baked.inputs..1 + baked.terms()] {
            seed += 1;
            *number = R::narrow(size * scatter(seed));
        }
        controller.restore(1, &state::bytes(1, &numbers)).expect("a sound state");
        let (_, report) = controller.tick(&inputs).expect("a tick");
        assert_eq!(report.ended, Ended::Exact, "{tick}");
        assert!(report.exchanges <= limit, "{tick}: {} of {limit}", report.exchanges);
        most = most.max(report.exchanges);
    }
    [most, limit]
}

#[test]
fn no_state_takes_more_exchanges_than_are_proved() {
    for problem in some(2, [levee("step = 600"), slab(&[])]) {
        let found = exchanges::<f32>(&problem);
        assert!(6 * found[0] > found[1], "{found:?}");
    }
}
