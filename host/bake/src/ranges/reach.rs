//! What outputs and error bound reach for inputs drawn from their ranges, corners included.

use crate::Bakes;
use crate::choice::Origin;
use crate::condensed::{Baked, Controller};
use crate::narrow::narrow;
use signorini_condense::ranges::interval::Interval;
use signorini_problem::Problem;
use signorini_problem::inputs::{InputSpace, corners, drawn};

/// Inputs drawn.
const DRAWN: usize = 1000;

/// The values seen.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Reach {
    /// How many inputs there were.
    pub inputs: usize,
    /// Each output at exact solutions in f64; none of the error bound.
    pub outputs: Vec<Option<Interval>>,
    /// The largest error bound of a tick of the controller.
    pub bound: Option<f64>,
    /// Why there is none.
    pub unbounded: String,
}

impl Reach {
    /// What the exact solution reaches, and the controller's bound: it is ticked with the same inputs.
    pub fn new<R: Bakes>(problem: &Problem, baked: &Baked<R>, origin: &Origin) -> Self {
        let spaces = InputSpace::of(&problem.scene);
        // Without inputs there is one tick.
        let drawn = drawn(&spaces, if spaces.is_empty() { 0 } else { DRAWN - 1 });
        let all: Vec<Vec<f64>> = corners(&spaces).into_iter().chain(drawn).collect();
        let nothing = Interval { lo: f64::INFINITY, hi: f64::NEG_INFINITY };
        let mut outputs = vec![None; origin.model().outputs.len()];
        for inputs in &all {
            for (range, value) in outputs.iter_mut().zip(exact(origin, inputs)) {
                let Interval { lo, hi } = range.unwrap_or(nothing);
                *range = value.map(|value| Interval { lo: lo.min(value), hi: hi.max(value) });
            }
        }
        let unbounded = baked.without_bound().unwrap_or("no tick had one").to_owned();
        Self { inputs: all.len(), outputs, bound: bound(baked, &all), unbounded }
    }
}

/// The outputs of the solution; none where there is no solution or for the bound.
fn exact(origin: &Origin, inputs: &[f64]) -> Vec<Option<f64>> {
    let p: Vec<f64> = std::iter::once(1.0).chain(inputs.iter().copied()).collect();
    let followed = origin.modes.as_ref().map(|modes| modes.in_own_scale(p[modes.input]));
    let model = followed.as_ref().unwrap_or(origin.model());
    match model.solve(&p) {
        Ok(x) => model.outputs(&p, &x),
        Err(_) => Vec::new(),
    }
}

/// The largest bound of a tick that had one.
fn bound<R: Bakes>(baked: &Baked<R>, all: &[Vec<f64>]) -> Option<f64> {
    let mut controller = Controller::new(baked);
    let bounds = all.iter().filter_map(|inputs| {
        let (_, report) = controller.tick(&narrow(inputs)).ok()?;
        report.certificate().map(|certificate| certificate.total.wide())
    });
    bounds.reduce(f64::max)
}
