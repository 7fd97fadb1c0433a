//! The start of steps in time: the steady state at the inputs' own defaults, or a stated u.

use signorini_certify::{Certified, Data, NoBound};
use signorini_kernel::solver::{Outcome, Status};
use signorini_kernel::system::Residual;
use signorini_problem::{Assembled, EdgeKind, Parts, Problem, Sum};
use signorini_scene::error::{Error, InputError, Result};
use signorini_scene::scene::{Datum, Scene};
use signorini_solve::{Ending, Options, Solution, read_off, solve, unfit};

/// A problem at the start of its steps, and u there.
pub(super) struct Start {
    /// The steady problem at the time of the start.
    pub problem: Problem,
    /// The answer that the first step begins from.
    pub solution: Solution,
}

/// The length of a step of `scene`.
///
/// # Errors
/// A scene that does not say it.
pub(super) fn step_of(scene: &Scene) -> Result<f64> {
    match &scene.time {
        Some(time) => Ok(time.step),
        None => {
            let error = InputError::new(
                "time.step: missing; a material has a capacity, so that ticks are steps in time",
            );
            let hint = "add [time] with `step`, in the unit of time of the data";
            Err(error.file(&scene.path).hint(hint).into())
        }
    }
}

impl Start {
    /// Of steps whose first one ends at `first`; nothing where no material stores anything.
    ///
    /// # Errors
    /// A scene that does not say how long a step is; no steady solution, where the start is one; data that are not admissible.
    pub fn of(problem: &Problem, first: f64) -> Result<Option<(f64, Self)>> {
        if problem.capacities.is_empty() {
            return Ok(None);
        }
        let dt = step_of(&problem.scene)?;
        // What the command line and a log say of inputs acts from the first step on.
        let own = Scene::parse(&problem.scene.text, &problem.scene.path)?;
        let inputs: Vec<_> = own.inputs.iter().map(|input| input.default).enumerate().collect();
        let mut at_start = problem.clone();
        at_start.set(&inputs, first - dt)?;
        let stated = problem.scene.time.as_ref().and_then(|time| time.initial.as_ref());
        let solution = match stated {
            Some(initial) => stated_start(&at_start, dt, initial)?,
            None => steady(&at_start)?,
        };
        let solution = Solution { status: Ending::Start, sweeps: 0, ..solution };
        Ok(Some((dt, Self { problem: at_start, solution })))
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

/// The means of the stated u, moved to where u_D and gaps have it.
fn stated_start(problem: &Problem, dt: f64, initial: &Datum) -> Result<Solution> {
    let stated = Sum::alone(&problem.scene, initial, 0.0);
    let counts = problem.topology.counts;
    let mean = |edge: usize| {
        let mean = stated.mean(problem.segment(edge))?;
        Ok(match problem.kinds[edge] {
            EdgeKind::Dirichlet => problem.loads.dirichlet[edge - counts.unknowns()],
            EdgeKind::Contact => {
                let at = edge - counts.free;
                let may_pass = problem.loads.flux_range(at).span().length().is_finite();
                if may_pass { mean } else { mean.max(problem.loads.gap[at]) }
            }
            _ => mean,
        })
    };
    let u: Vec<f64> = (0..problem.ends.len()).map(mean).collect::<Result<_>>()?;
    // Its fluxes are those that no storage balances.
    let unfit = unfit::<f64>(&problem.scene);
    let assembled = Assembled::<f64>::new(problem).map_err(&unfit)?;
    let parts = Parts::examine(&problem.stepping(dt, &u, [&[], &[]])?)?;
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
