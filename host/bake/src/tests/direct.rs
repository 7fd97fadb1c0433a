//! Ticks of full models beside the direct solver with the same inputs, and what both are made of.

use std::collections::BTreeMap;

use crate::Bakes;
use crate::full::{Baked, Controller};
use crate::narrow::narrow;
use signorini_certify::exact::distance;
use signorini_device::tick::{Limits, Report};
use signorini_problem::Problem;
use signorini_problem::fixtures::on_grid;
use signorini_scene::error::Result;
use signorini_scene::mesh::Mesh;
use signorini_scene::scene::units::Units;
use signorini_session::on_mesh::answer;
use signorini_session::tick::{Budget, ScheduledTick, TickRecord, play};
use signorini_solve::outputs::outputs;
use signorini_solve::{Options, ScalarKind, Solution, SolverKind, solve};
use signorini_tolerances::Tolerance;
use signorini_tolerances::bake::{GUARANTEE, OSCILLATION};

/// A heated face below keeps 2 with at most 6 per length, less towards its ends, and may cool by 1; u ≤ 3 on the right, air
/// on the left.
pub const HEATER: &str = r#"
mesh = "grid"
material.default.conductivity = ["2", "0.3", "1"]
boundary.dirichlet = { kind = "dirichlet", value = "2 - x/4" }
boundary.left = { kind = "robin", coefficient = "3", ambient = "0" }
boundary.right = { kind = "contact", gap = "3", flux = "-inf", limit = "0.5*y" }
boundary.contact = { kind = "contact", gap = "2", flux = "-1", limit = "6 - 3*x^2" }
input.air = { of = "left", field = "ambient", pattern = "1", default = -3.0 }
input.sun = { of = "source", field = "f", pattern = "1 - x" }
input.wanted = { of = "contact", field = "gap", pattern = "1" }
output.power = { kind = "flux", of = "contact" }
output.short = { kind = "saturated", of = "contact" }
output.kept = { kind = "length", of = "contact" }
output.held = { kind = "force", of = "right" }
output.skin = { kind = "mean", of = "contact" }
"#;

/// Limits of a tick that goes on until sweeps change nothing that counts.
pub fn to_the_end<R: Bakes>() -> Limits<R> {
    Limits { share: R::narrow(1e-9), sweeps: 200_000, ..Limits::default() }
}

/// Why there is no full model of a scene.
pub fn refusal(text: &str, mesh: Mesh) -> Result<String> {
    let (_, problem) = on_grid(text, mesh)?;
    Ok(Baked::<f64>::new(&problem).expect_err("no full model").to_string())
}

/// The problem at these inputs, its direct solution, and the outputs of that.
pub fn directly(
    problem: &Problem,
    inputs: &[f64],
) -> Result<(Problem, Solution, BTreeMap<String, Option<f64>>)> {
    let now = problem.with_inputs(inputs)?;
    let options = Options { solver: SolverKind::Direct, averages: true, ..Options::default() };
    let solution = solve(&now, &options)?;
    let values = outputs(&now, &solution)?;
    Ok((now, solution, values))
}

/// A problem whose ticks are solves.
pub struct Beside<'p> {
    pub problem: &'p Problem,
    /// A kernel feature of the module.
    pub feature: &'static str,
    pub steps: Vec<Vec<f64>>,
    /// The size that outputs are compared over at least.
    pub least: fn(&Solution) -> f64,
    /// Whether an output is nothing but rounding at some inputs.
    pub is_undefined: fn(&[f64], &str) -> bool,
}

impl Beside<'_> {
    /// Compares outputs and duality gap of each warm tick; `see` is shown outputs, report and solution.
    pub fn ticks<R: Bakes>(
        &self,
        allowed: Tolerance,
        mut see: impl FnMut(&[R], &Report<R>, &Solution),
    ) -> Result<()> {
        let baked = Baked::<R>::new(self.problem)?;
        assert!(baked.has_bound() && baked.features().contains(&self.feature));
        let mut controller = Controller::<R>::new(&baked);
        for values in &self.steps {
            let tick = controller.tick_within(&narrow(values), to_the_end());
            let (found, report) = tick.expect("a tick");
            let (now, solution, expected) = directly(self.problem, values)?;
            let least = (self.least)(&solution);
            for (output, found) in now.scene.outputs.iter().zip(&found) {
                let name = &output.name.value;
                if !(self.is_undefined)(values, name) {
                    let expected = expected[name].expect("a value");
                    let (what, off) = (format!("{name} {values:?}"), found.wide() - expected);
                    allowed.check_over(what, off, expected.abs().max(least));
                }
            }
            let gap = report.verdict.certificate().expect("a bound").duality_gap.wide();
            let bound = solution.bound.as_ref().expect("a bound").duality_gap;
            allowed.check_relative(format_args!("gap {values:?}"), gap, bound);
            see(&found, &report, &solution);
        }
        Ok(())
    }
}

/// A tick leaves out of its data at least what a solve does: the oscillation of a sum is at most the sum of oscillations.
pub fn leaves_out_more<R: Bakes>(_: &[R], report: &Report<R>, solution: &Solution) {
    let of_tick = report.verdict.certificate().expect("a bound").oscillation.wide();
    let bound = solution.bound.as_ref().expect("a bound");
    OSCILLATION.check_at_most("oscillation", bound.oscillation, of_tick);
}

/// Ticks of one controller on these problems, each cut off after so many sweeps: a bound holds of any iterate, and is at most so many
/// times the error.
pub fn bounded<R: Bakes>(
    problem: &Problem,
    at: impl IntoIterator<Item = Result<Problem>>,
    cut_offs: &[(u32, f64)],
) -> Result<()> {
    let baked = Baked::<R>::new(problem)?;
    let mut controller = Controller::<R>::new(&baked);
    for now in at {
        let now = now?;
        let inputs: Vec<f64> = now.scene.inputs.iter().map(|input| input.default).collect();
        let exact = now.scene.exact.as_ref().expect("an exact solution");
        for &(sweeps, most) in cut_offs {
            let limits = Limits { sweeps, ..to_the_end() };
            let (_, report) = controller.tick_within(&narrow(&inputs), limits).expect("a tick");
            let bound = report.verdict.certificate().expect("a bound").total.wide();
            let certified = answer(&report, &controller.numbers(), &Units::default()).certified;
            let error = distance(exact, &now, &certified.admissible())?.combined;
            let what = format!("{inputs:?}, {sweeps} sweeps");
            GUARANTEE.check_at_most(&what, error, bound);
            assert!(bound < most * error, "{what}: {bound} for {error}");
        }
    }
    Ok(())
}

/// Ticks on the desk, in f64 and to the end.
pub fn played(problem: &Problem, steps: &[Vec<f64>]) -> Result<Vec<TickRecord>> {
    let inputs = |values: &Vec<f64>| values.iter().copied().enumerate().collect();
    let moment = |(at, values)| ScheduledTick { time: at as f64, inputs: inputs(values) };
    let moments: Vec<_> = steps.iter().enumerate().map(moment).collect();
    let scalar = ScalarKind::F64;
    let budget = Budget { scalar, intervals: false, ..Budget::of(&problem.scene) };
    play(problem, None, &moments, &budget, |_, _| Ok(()))
}
