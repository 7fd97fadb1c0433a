//! What half the step would change: the same inputs played in steps of half the length, compared where both end.
//!
//! The implicit Euler method is of first order: where u is smooth in time the step's own error is about twice that change. Nothing here is
//! guaranteed.

use std::sync::Arc;

use super::{Budget, ScheduledTick, TickRecord, play};
use signorini_problem::Problem;
use signorini_problem::inputs::{InputSpace, drawn};
use signorini_scene::error::Result;
use signorini_scene::scene::{Output, Quantity, Scene};
use signorini_solve::ScalarKind;

/// Unknowns times ticks that are played, on meshes on which that is more than [`LEAST`] ticks: about a second.
const MOST: usize = 8_000;

/// Ticks that are played at least, and unknowns from which on there are none: at most twenty times as much.
const LEAST: usize = 4;
const TOO_MANY: usize = 40_000;

/// The residual that ends these ticks: what sweeps leave is far below what the step does.
const TOLERANCE: f64 = 1e-9;

/// How many times inputs change in a [`trial`], and how many ticks they then stay.
const CHANGES: usize = 4;
const HELD: u32 = 4;

/// The changes.
#[derive(Debug, Clone, PartialEq)]
pub struct Halved {
    /// Ticks of the whole step that were played, the first ones.
    pub ticks: usize,
    /// The largest change of each output, and when; none of a bound, or of what has no value.
    pub changes: Vec<Option<[f64; 2]>>,
}

impl Halved {
    /// Plays the first of `moments` twice; nothing of ticks that are no steps in time, or on a very large mesh.
    ///
    /// # Errors
    /// Those of a play.
    pub fn of(problem: &Problem, moments: &[ScheduledTick]) -> Result<Option<Self>> {
        let Some(step) = problem.scene.step() else { return Ok(None) };
        let unknowns = problem.topology.counts.unknowns();
        if unknowns > TOO_MANY {
            return Ok(None);
        }
        let most = (MOST / unknowns.max(1)).max(LEAST);
        let moments = &moments[..moments.len().min(most)];
        let mut finer = problem.clone();
        Arc::make_mut(&mut finer.scene).set_step(0.5 * step);
        let early = |of: &ScheduledTick| ScheduledTick { time: of.time - 0.5 * step, ..of.clone() };
        let half: Vec<_> = moments.iter().flat_map(|of| [early(of), of.clone()]).collect();
        let whole = played(problem, moments)?;
        let half = played(&finer, &half)?;
        let ends = || whole.iter().zip(half.iter().skip(1).step_by(2));
        let change = |at: usize| {
            let off = ends().filter_map(|(one, two)| {
                Some([(one.outputs[at]? - two.outputs[at]?).abs(), one.time])
            });
            off.reduce(|most, next| if next[0] > most[0] { next } else { most })
        };
        let is_bound = |of: Quantity| matches!(of, Quantity::Bound | Quantity::Window);
        let outputs = problem.scene.outputs.iter().enumerate();
        let changes = outputs.map(|(at, of)| (!is_bound(of.quantity)).then(|| change(at))?);
        Ok(Some(Self { ticks: moments.len(), changes: changes.collect() }))
    }

    /// The changes in a sentence, where there are some.
    pub fn sentence(&self, scene: &Scene) -> Option<String> {
        let told = |(output, change): (&Output, &Option<[f64; 2]>)| {
            let (Output { name, unit, .. }, [by, time]) = (output, (*change)?);
            let unit = unit.as_ref().map_or(String::new(), |unit| format!(" {unit}"));
            (by > 0.0).then(|| format!("{} by {by:.1e}{unit} (t = {time})", name.value))
        };
        let all: Vec<_> = scene.outputs.iter().zip(&self.changes).filter_map(told).collect();
        (!all.is_empty()).then(|| {
            let all = all.join(", ");
            format!("half the step would change, in {} ticks and not guaranteed: {all}", self.ticks)
        })
    }
}

fn played(problem: &Problem, moments: &[ScheduledTick]) -> Result<Vec<TickRecord>> {
    let budget = Budget {
        scalar: ScalarKind::F64,
        tolerance: Some(TOLERANCE),
        intervals: false,
        shows_start: false,
        ..Budget::of(&problem.scene)
    };
    play(problem, None, moments, &budget, |_, _| Ok(()))
}

/// Ticks from the start in which inputs go through their ranges, for scenes that are played nowhere else.
pub fn trial(problem: &Problem) -> Vec<ScheduledTick> {
    let step = problem.scene.step().unwrap_or(1.0);
    let spaces = InputSpace::of(&problem.scene);
    // The first ones are the defaults, at which a steady start stays.
    let values = drawn::<f64>(&spaces, CHANGES).skip(1).flat_map(|inputs| {
        std::iter::repeat_n(inputs.into_iter().enumerate().collect::<Vec<_>>(), HELD as usize)
    });
    let times = (1..).map(|at: u32| f64::from(at) * step);
    times.zip(values).map(|(time, inputs)| ScheduledTick { time, inputs }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_problem::fixtures::on_grid;
    use signorini_scene::mesh::structured::{Cells, grid};

    /// A plate that is nearly as warm everywhere and cools through a weak transfer: u' = −u, which a step divides by 1 + dt.
    #[test]
    fn half_the_step_changes_a_decay_as_the_method_says() -> Result<()> {
        let scene = r#"
mesh = "grid"
material.default = { conductivity = "1", capacity = "1e-5" }
boundary.dirichlet = { kind = "robin", coefficient = "5e-6", ambient = "0" }
boundary.contact = { kind = "contact", gap = "-9" }
output.face = { kind = "mean", of = "contact" }
output.bound = { kind = "bound" }
time = { step = 0.05, initial = "1" }
"#;
        let problem = on_grid(scene, grid(8, Cells::Triangles))?.1;
        let moments: Vec<_> = (1..=30)
            .map(|at| ScheduledTick { time: 0.05 * f64::from(at), inputs: Vec::new() })
            .collect();
        let found = Halved::of(&problem, &moments)?.expect("steps in time");
        let change = |at: i32| 1.05_f64.powi(-at) - 1.025_f64.powi(-2 * at);
        let [by, time] = found.changes[0].expect("a change");
        assert!(found.ticks >= LEAST && found.ticks < 30, "{}", found.ticks);
        let expected = (1..=found.ticks as i32).map(change).fold(0.0, f64::max);
        assert!((0.99..1.01).contains(&(by / expected)), "{by} {expected} at {time}");
        assert_eq!(found.changes[1], None, "a bound is no quantity of the solution");
        let said = found.sentence(&problem.scene).expect("a sentence");
        assert!(said.contains("face by ") && said.contains("not guaranteed"), "{said}");
        Ok(())
    }
}
