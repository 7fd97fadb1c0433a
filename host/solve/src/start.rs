//! The start of steps in time: the steady state at the inputs' own defaults, or a stated u.

use super::decay::decay_rate;
use super::{Ending, Options, ScalarKind, Solution, read_off, solve, unfit};
use signorini_certify::evolution::Evolution;
use signorini_certify::stated::distance;
use signorini_certify::{Certified, Data, NoBound};
use signorini_kernel::solver::{Outcome, Status};
use signorini_kernel::system::Residual;
use signorini_problem::{Assembled, EdgeKind, Parts, Problem, State, Sum};
use signorini_scene::error::{Error, InputError, Result};
use signorini_scene::scene::{Datum, Scene};

/// A stated u that is moved by no more than this part of itself is not.
const ROUNDED: f64 = 1e-9;

/// dtλ below which f32 keeps few digits of u: what a step rounds adds up to ε/(dtλ).
const LEAST_PART: f64 = 1e-5;

/// A problem at the start of its steps, and u there.
#[derive(Debug)]
pub struct Start {
    /// The steady problem at the time of the start.
    pub problem: Problem,
    /// The answer that the first step begins from.
    pub solution: Solution,
    /// dt
    pub step: f64,
    /// The start of the bound of the evolution; nothing where it has none.
    pub evolution: Option<Evolution>,
}

/// The length of a step of `scene`.
///
/// # Errors
/// A scene that does not say it.
pub fn step_of(scene: &Scene) -> Result<f64> {
    match &scene.time {
        Some(time) => Ok(time.step),
        None => {
            let error = InputError::new(
                "time.step: missing; a material has a capacity, so that ticks are steps in time",
            );
            let hint = "add [time] with `step`, in the unit of time of the data, or give --step DT";
            Err(error.file(&scene.path).hint(hint).into())
        }
    }
}

impl Start {
    /// Of steps whose first one ends at `first`; nothing where no material stores anything.
    ///
    /// # Errors
    /// A scene that does not say how long a step is; no steady solution, where the start is one; data that are not admissible.
    pub fn of(problem: &Problem, first: f64) -> Result<Option<Self>> {
        if problem.capacities.is_empty() {
            return Ok(None);
        }
        let step = step_of(&problem.scene)?;
        let at_start = at_start(problem, first - step)?;
        let stated = stated(problem);
        let solution = match stated {
            Some(initial) => stated_start(&at_start, step, initial)?,
            None => steady(&at_start)?,
        };
        let solution = Solution { status: Ending::Start, sweeps: 0, ..solution };
        let rate = decay_rate(&at_start)?;
        let evolution = match stated {
            Some(initial) => {
                Evolution::begin(rate, None, stated_error(&at_start, &solution, initial)?)
            }
            None => {
                // In steps s follows curved data everywhere.
                let total = solution.bound.map(|bound| bound.total);
                let total = total.map(|total| total + solution.certified.lifts.energy);
                total.and_then(|total| Evolution::begin(rate, Some(total), 0.0))
            }
        };
        Ok(Some(Self { problem: at_start, solution, step, evolution }))
    }

    /// `problem` as the step that begins here.
    ///
    /// # Errors
    /// Masses that are not finite.
    pub fn stepping(&self, problem: &Problem) -> Result<Problem> {
        problem.stepping(self.step, self.solution.state())
    }
}

fn steady(problem: &Problem) -> Result<Solution> {
    let refused = |why: &str| -> Error {
        let error =
            InputError::new(format!("time.initial: there is no steady state to start from: {why}"));
        error.file(&problem.scene.path).hint("state one, as in `initial = \"20\"`").into()
    };
    let parts = Parts::examine(problem).map_err(|error| refused(&error.reason()))?;
    if parts.counts.floating > 0 {
        return Err(refused("nothing holds a part of the domain"));
    }
    solve(problem, &Options::default())
}

/// The means of the stated u over the edges, and these where u_D and gaps move them.
fn stated_means(problem: &Problem, initial: &Datum) -> Result<[Vec<f64>; 2]> {
    let stated = Sum::alone(&problem.scene, initial, 0.0);
    let counts = problem.topology.counts;
    let means = (0..problem.ends.len()).map(|edge| stated.mean(problem.segment(edge)));
    let means: Vec<f64> = means.collect::<Result<_>>()?;
    let moved = |(edge, &mean): (usize, &f64)| match problem.kinds[edge] {
        EdgeKind::Dirichlet => problem.loads.dirichlet[edge - counts.unknowns()],
        EdgeKind::Contact => {
            let at = edge - counts.free;
            let (range, gap) = (problem.loads.flux_range(at), problem.loads.gap[at]);
            let [least, _] = range.ends();
            match range.span().length().is_finite() {
                true => mean,
                false if least.is_finite() => mean.max(gap),
                // u ≤ ψ
                false => mean.min(gap),
            }
        }
        _ => mean,
    };
    let moved = means.iter().enumerate().map(moved).collect();
    Ok([means, moved])
}

/// Looks at the stated u, where steps in time begin from one.
///
/// # Errors
/// An expression without a value somewhere.
pub fn check_stated(problem: &Problem) -> Result<()> {
    match stated(problem).filter(|_| problem.scene.stores()) {
        Some(initial) => stated_means(problem, initial).map(drop),
        None => Ok(()),
    }
}

/// How many edges a stated start is moved on, and by how much at most, where it is.
fn moved_warning(problem: &Problem, initial: &Datum) -> Result<Option<String>> {
    let [means, moved] = stated_means(problem, initial)?;
    let size = moved.iter().chain(&means).fold(0.0, |most: f64, u| most.max(u.abs()));
    let apart = means.iter().zip(&moved).map(|(mean, moved)| (moved - mean).abs());
    let off: Vec<f64> = apart.filter(|off| *off > ROUNDED * size).collect();
    let most = off.iter().copied().fold(0.0, f64::max);
    Ok((!off.is_empty()).then(|| {
        format!(
            "{} is moved to the gap or the given u on {} edges, by {most:.2e} at most",
            initial.key,
            off.len()
        )
    }))
}

/// Sentences on the start of steps whose first one ends at `first`, and on their scalar.
///
/// # Errors
/// Those of playing them.
pub fn warnings(problem: &Problem, first: f64, scalar: ScalarKind) -> Result<Vec<String>> {
    if problem.capacities.is_empty() {
        return Ok(Vec::new());
    }
    let step = step_of(&problem.scene)?;
    let at_start = at_start(problem, first - step)?;
    let mut all = Vec::new();
    if let Some(initial) = stated(problem) {
        all.extend(moved_warning(&at_start, initial)?);
    }
    all.extend(no_window(&at_start, step)?.map(|why| format!("no bound over time: {why}")));
    if scalar == ScalarKind::F32 {
        let part = step * decay_rate(&at_start)?;
        all.extend((0.0 < part && part < LEAST_PART).then(|| {
            format!(
                "a step of {step} is {part:.1e} of the time in which u decays: in f32 what each step rounds adds up to {:.1e} \
                 of u; take f64 or a longer step",
                f64::from(f32::EPSILON) / part
            )
        }));
    }
    Ok(all)
}

/// Why the evolution has no bound, as far as its start tells.
fn no_window(at_start: &Problem, step: f64) -> Result<Option<String>> {
    let is_held = |parts: Parts| parts.counts.contact == 0 && parts.counts.floating == 0;
    if !Parts::whatever_inputs(at_start).is_ok_and(is_held) {
        let why = "neither a given u nor a transfer law holds some part of the domain, so that what is stored there need not decay";
        return Ok(Some(why.to_owned()));
    }
    let Some(initial) = stated(at_start) else { return Ok(None) };
    let start = stated_start(at_start, step, initial)?;
    let is_near = stated_error(at_start, &start, initial)?.is_finite();
    Ok((!is_near).then(|| format!("{} may be unbounded somewhere", initial.key)))
}

/// ‖c^½(u − s)‖ for the stated u, at most.
fn stated_error(problem: &Problem, start: &Solution, initial: &Datum) -> Result<f64> {
    let stated = Sum::alone(&problem.scene, initial, 0.0);
    distance(problem, &start.certified.admissible(), &stated)
}

fn stated(problem: &Problem) -> Option<&Datum> {
    problem.scene.time.as_ref().and_then(|time| time.initial.as_ref())
}

/// `problem` at `time`, with the inputs at the scene's own defaults: what the command line and a log say of them acts from the first
/// step on.
pub fn at_start(problem: &Problem, time: f64) -> Result<Problem> {
    let inputs: Vec<_> = own_defaults(&problem.scene)?.into_iter().enumerate().collect();
    let mut at_start = problem.clone();
    at_start.set(&inputs, time)?;
    Ok(at_start)
}

/// The inputs' defaults in the text of the scene, whatever has set them since.
///
/// # Errors
/// A text that is no scene.
pub fn own_defaults(scene: &Scene) -> Result<Vec<f64>> {
    let own = Scene::parse(&scene.text, &scene.path)?;
    Ok(own.inputs.iter().map(|input| input.default).collect())
}

/// The stated u, moved to where u_D and gaps have it.
fn stated_start(problem: &Problem, dt: f64, initial: &Datum) -> Result<Solution> {
    let [_, u] = stated_means(problem, initial)?;
    // Its fluxes are those that no storage balances.
    let unfit = unfit::<f64>(&problem.scene);
    let assembled = Assembled::<f64>::new(problem).map_err(&unfit)?;
    let parts = Parts::examine(&problem.stepping(dt, State { u: u.clone(), ..State::default() })?)?;
    let outcome = Outcome {
        status: Status::Converged,
        sweeps: 0,
        conjugate: 0,
        residual: Residual::default(),
        omega: 1.0,
    };
    let data = Data::new(problem)?;
    let s = Certified::new(problem, &parts, &assembled, (&data, true), &u).map_err(&unfit)?;
    let no_bound = Some(NoBound::new("a stated start has no error bound"));
    let stated = Certified { bound: None, no_bound, ..s };
    read_off(problem, &parts, &assembled, &outcome, [&u, &[]], stated).map_err(unfit)
}
