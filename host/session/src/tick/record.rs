//! One tick as `ticks.csv` has it.

use signorini_certify::ErrorBound;
use signorini_certify::evolution::Evolution;
use signorini_certify::exact::distance;
use signorini_intervals::zero_rounding;
use signorini_problem::Problem;
use signorini_problem::functional::of_one;
use signorini_scene::error::{Error, Result};
use signorini_scene::scene::units::Units;
use signorini_scene::scene::{Quantity, Scene};
use signorini_solve::outputs::{Reading, declared};
use signorini_solve::{Ending, Solution, Start};

use signorini_device::codes::Refusal;
use signorini_kernel::report::Ended;

/// Numbers of a tick; those that do not exist or are not finite are `None`.
#[derive(Debug, Clone)]
pub struct TickRecord {
    /// t
    pub time: f64,
    /// How it ended.
    pub status: Ending,
    /// Sweeps spent.
    pub sweeps: u32,
    /// ∫_C (τ·n − q) ≥ 0, τ within the law of contact.
    pub contact_force: Option<f64>,
    /// Σ|E| over the active contact edges.
    pub contact_length: Option<f64>,
    /// The bound on the error.
    pub bound: Option<ErrorBound>,
    /// The bound over time of steps: the root of the fading mean of the energy error's square, and how far back it reaches.
    pub window: Option<[f64; 2]>,
    /// The error that the bound over time is for, where the exact solution is that of the data as ticks hold them.
    pub window_error: Option<f64>,
    /// The error that `bound` is for, where the exact solution is known.
    pub combined: Option<f64>,
    /// The declared outputs, in the order of the scene.
    pub outputs: Vec<Option<f64>>,
    /// Intervals in which they lie for the exact solution, of a probe the mean over its cell, or why there is none; empty where
    /// no intervals were asked for.
    pub intervals: Vec<TickInterval>,
    /// Intervals in which outputs lie for the exact evolution in time; empty where there is none, or none were asked for.
    pub over_time: Vec<Option<[f64; 2]>>,
}

/// The ends of an interval, or why there is none.
pub type TickInterval = std::result::Result<[f64; 2], String>;

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

impl TickRecord {
    /// Reads `solution` off, the answer at the moment of `problem`, in its units; without intervals.
    pub(super) fn of(problem: &Problem, solution: &Solution) -> Result<Self> {
        let bound = solution.bound.filter(|bound| bound.total.is_finite());
        let combined = match (&problem.scene.exact, bound) {
            // The exact solution is that of the evolution, and the bound of a step that of the step.
            (Some(exact), Some(_)) if problem.loads.step.is_none() => {
                Some(distance(exact, problem, &solution.certified.admissible())?.combined)
            }
            _ => None,
        };
        let [force, length] = contact(&problem.scene, solution);
        Ok(Self {
            time: problem.time,
            status: solution.status,
            sweeps: solution.sweeps,
            contact_force: finite(force),
            contact_length: finite(length),
            bound,
            window: None,
            window_error: None,
            combined: combined.and_then(finite),
            outputs: outputs(problem, solution, bound)?,
            intervals: Vec::new(),
            over_time: Vec::new(),
        })
    }

    /// The row of a start.
    pub(super) fn of_start(start: &Start) -> Result<Self> {
        let record = Self::of(&start.problem, &start.solution)?;
        let window = start.evolution.as_ref().map(Evolution::window);
        Ok(record.with_window(&start.problem.scene, window))
    }

    /// With what is known of the evolution until then.
    pub(super) fn with_window(mut self, scene: &Scene, window: Option<[f64; 2]>) -> Self {
        self.window = window.filter(|[energy, _]| energy.is_finite());
        let windows = self.outputs.iter_mut().zip(&scene.outputs);
        for (output, _) in windows.filter(|(_, of)| of.quantity == Quantity::Window) {
            *output = self.window.map(|[energy, _]| energy);
        }
        self
    }

    /// A tick that was refused with this error.
    pub(super) fn refused(problem: &Problem, error: &Error) -> Self {
        let outputs = problem.scene.outputs.len();
        Self {
            time: problem.time,
            status: Ending::refused(error).unwrap_or(Ending::Tick(Ended::NotFinite)),
            sweeps: 0,
            contact_force: None,
            contact_length: None,
            bound: None,
            window: None,
            window_error: None,
            combined: None,
            outputs: vec![None; outputs],
            intervals: vec![Err("the tick was refused".to_owned()); outputs],
            over_time: Vec::new(),
        }
    }

    /// Whether the solve broke down; one that its budget cut off did not.
    pub fn failed(&self) -> bool {
        self.status.is_breakdown()
    }

    /// Whether its loads were such that contact cannot hold the domain, or at no one place.
    pub fn is_unsolvable(&self) -> bool {
        matches!(self.status, Ending::Refused(Refusal::NoSolution | Refusal::NotUnique))
    }

    /// Whether its data excluded each other where boundaries meet.
    pub fn is_excluded(&self) -> bool {
        self.status == Ending::Refused(Refusal::Excluded)
    }

    /// From `units` to those that the scene had before.
    pub(super) fn rescale(&mut self, problem: &Problem, units: &Units) {
        let times = |number: &mut Option<f64>, unit: f64| {
            *number = number.map(|x| x * unit).filter(|x| x.is_finite());
        };
        times(&mut self.contact_force, units.flux());
        times(&mut self.combined, units.energy());
        self.bound = self.bound.map(|bound| bound.times(units.energy()));
        self.window = self.window.map(|[energy, seconds]| [energy * units.energy(), seconds]);
        for (at, of) in problem.scene.outputs.iter().enumerate() {
            let of_one = of_one(problem, of);
            let scaled = |x: f64| units.output(of.quantity, [x, of_one]);
            if let Some(output) = self.outputs.get_mut(at) {
                *output = output.map(scaled).filter(|x| x.is_finite());
            }
            let rounding = zero_rounding(units, of.quantity);
            let interval = self.intervals.get_mut(at).and_then(|found| found.as_mut().ok());
            let over_time = self.over_time.get_mut(at).and_then(Option::as_mut);
            for ends in interval.into_iter().chain(over_time) {
                let [least, most] = ends.map(scaled);
                *ends = [least - rounding * least.abs(), most + rounding * most.abs()];
            }
        }
    }
}

/// Contact force and length: of a controller of a scene without declared outputs they are the outputs, with their bits.
fn contact(scene: &Scene, solution: &Solution) -> [f64; 2] {
    match (scene.outputs.is_empty(), &solution.outputs[..]) {
        (true, &[force, length]) => [force, length],
        _ => [solution.contact_force, solution.contact_length],
    }
}

/// The declared outputs: a controller's own, with their bits, else read off the fields.
fn outputs(
    problem: &Problem,
    solution: &Solution,
    bound: Option<ErrorBound>,
) -> Result<Vec<Option<f64>>> {
    let Solution { scalar, u, flux, outputs, .. } = solution;
    if outputs.is_empty() {
        let (scalar, bound) = (*scalar, bound.map(|bound| bound.total));
        return declared(problem, Reading { scalar, u, flux, bound });
    }
    let own = outputs.iter().take(problem.scene.outputs.len());
    Ok(own.map(|&value| finite(value)).collect())
}
