//! A controller keeps a promised error in its own scalar, or is refused with the inputs at which it does not.

use crate::choice::{Choice, Wanted};
use crate::promise::check;
use crate::tests::standard;
use signorini_problem::Problem;
use signorini_scene::goal::Goal;
use signorini_scene::setting::ModelKind;
use signorini_solve::adaptive::{Allowed, Promise};
use signorini_solve::{Options, solve};

/// That the bound of the levee is at most `times` what a solve in f64 finds, with these inputs and the average that a controller has.
fn promise(problem: &Problem, times: f64) -> Promise {
    let allowed = [[0.0, 0.0], [5.0, -1.0], [2.0, 0.5]].map(|inputs| {
        let at = problem.with_inputs(&inputs).expect("inputs of its ranges");
        let options = Options { averages: true, ..Options::default() };
        let found = solve(&at, &options).expect("a solution");
        Allowed { inputs: inputs.to_vec(), bound: times * found.bound.expect("a bound").total }
    });
    let unknowns = problem.topology.counts.unknowns();
    Promise { goal: Goal::Part(0.3), largest: 1.0, unknowns, allowed: allowed.to_vec() }
}

#[test]
fn every_model_keeps_it_or_is_refused() {
    let problem = standard("levee", |scene| scene.target = None);
    for model in [ModelKind::Condensed, ModelKind::Full] {
        let choice = Choice::<f32>::new(&problem, Wanted::model(model)).expect("a model");
        // The bound in f32 is a little above that in f64; a share of sweeps is not cut off here. That of a condensed model is below
        // the mesh's, since its s is the best there is.
        check(&problem.scene, &choice, &promise(&problem, 1.05)).expect("kept");
        let refused =
            check(&problem.scene, &choice, &promise(&problem, 0.5)).expect_err("not kept");
        let text = refused.to_string();
        assert!(text.contains("setting.error = \"30%\", rain = "), "{text}");
        assert!(text.contains("a tick in f32"), "{text}");
    }
}
