//! Inputs without a range that make boundaries exclude each other: every model refuses them, and goes on as if it had not seen them.

use crate::choice::{Choice, Wanted};
use crate::emit::emit;
use crate::{Bakes, condensed, full};
use signorini_kernel::Error;
use signorini_problem::Problem;
use signorini_problem::fixtures::on_grid;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::setting::ModelKind;

/// u_D = 0.3 + level beside a gap of lift: both sides end there.
fn text(more: &str) -> String {
    format!(
        "
mesh = \"grid\"
material.default.conductivity = \"1\"
boundary.dirichlet = {{ kind = \"dirichlet\", value = \"0.3\" }}
boundary.contact = {{ kind = \"contact\", gap = \"-0.1\", flux = \"-1\" }}
input.lift = {{ of = \"contact\", field = \"gap\", pattern = \"1\"{more} }}
input.level = {{ of = \"dirichlet\", field = \"value\", pattern = \"0.5\"{more} }}
output.force = {{ kind = \"force\" }}
output.bound = {{ kind = \"bound\" }}
"
    )
}

/// Inputs, and whether u_D ≥ ψ with them: 0.3 + level/2 ≥ lift − 0.1.
const TICKS: [([f64; 2], bool); 7] = [
    ([0.0, 0.0], true),
    ([0.41, 0.0], false),
    ([0.39, 0.0], true),
    ([0.0, -0.81], false),
    ([1e3, 1e3], false),
    ([1.0, 1.3], true),
    ([f64::NAN, 0.0], false),
];

/// Plays them all, and on another controller those alone that have an answer.
fn check<R: Bakes, A: PartialEq + std::fmt::Debug>(
    mut one: impl FnMut(&[R]) -> Result<A, Error>,
    mut other: impl FnMut(&[R]) -> Result<A, Error>,
) {
    for (inputs, is_answered) in TICKS {
        let narrow = inputs.map(R::narrow);
        match is_answered {
            true => assert_eq!(one(&narrow), other(&narrow), "{inputs:?}"),
            false if inputs[0].is_nan() => assert!(one(&narrow).is_err()),
            false => assert_eq!(one(&narrow), Err(Error::Excluded { at: 0 }), "{inputs:?}"),
        }
    }
}

fn by_both_models<R: Bakes>(problem: &Problem) {
    let choice = Choice::<R>::new(problem, Wanted::model(ModelKind::Condensed)).expect("a model");
    let small = choice.condensed().expect("condensed").0;
    let [mut one, mut other] = [(); 2].map(|()| condensed::Controller::new(small));
    check::<R, _>(|p| one.tick(p), |p| other.tick(p));
    let large = full::Baked::<R>::new(problem).expect("a full model");
    let [mut one, mut other] = [(); 2].map(|()| full::Controller::<R>::new(&large));
    check::<R, _>(|p| one.tick(p), |p| other.tick(p));
}

#[test]
fn both_models_refuse_what_excludes_itself_and_keep_their_state() {
    let (_, problem) = on_grid(&text(""), grid(4, Cells::Triangles)).expect("a scene");
    by_both_models::<f64>(&problem);
    by_both_models::<f32>(&problem);
}

#[test]
fn modules_look_where_no_range_proves_it_alone() {
    for model in [ModelKind::Condensed, ModelKind::Full] {
        let module = |more: &str| {
            let (_, problem) = on_grid(&text(more), grid(2, Cells::Triangles)).expect("a scene");
            let choice = Choice::<f32>::new(&problem, Wanted::model(model)).expect("a model");
            emit(&problem, &choice).source
        };
        let looks = "fn exclusions(&self) -> &[Scalar] {\n        &[4e-10, -0.4, 1.0, -0.5";
        assert!(module("").contains(looks));
        assert!(!module(", range = [-0.1, 0.1]").contains("exclusions"));
    }
}

#[test]
fn ranges_within_which_boundaries_exclude_each_other_are_refused() {
    let error =
        on_grid(&text(", range = [-0.5, 0.5]"), grid(2, Cells::Quads)).expect_err("0.05 < 0.4");
    let said = error.to_string();
    let expected = "input.lift.range: with lift = 0.5 and level = -0.5 u_D = 0.04999999999999999 of boundary.dirichlet";
    assert!(said.contains(expected) && error.exit_status() == 2, "{said}");
}
