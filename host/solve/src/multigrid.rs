//! The host's solver in linear cost: [`signorini_multigrid`] on the kernel's matrix, and the direct solver where it does not converge.

use std::time::Instant;

use serde::Serialize;
use signorini_kernel::solver::{Outcome, Status};
use signorini_kernel::system::Residual;
use signorini_multigrid::Settings;

use super::direct::directly;
use super::minimised::minimised;
use super::nested;
use super::{Attempt, Options, Ran, ScalarKind, Solution, Solved, Task, by_kernel, unfit};
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;

/// Iterations at most: where as many are not enough, a factor is quicker.
const MOST_ITERATIONS: usize = 1000;
/// Roundings of a row that count as none.
const ROUNDINGS: f64 = 8.0;

/// Work of multigrid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Multigrid {
    /// Iterations of conjugate gradients.
    pub iterations: usize,
    /// The most of them for one active set.
    pub longest: usize,
    /// Active sets.
    pub sets: usize,
}

/// Its answer, or that of a solver with a factor, the direct one in f64, which says why multigrid has none.
pub(super) fn by_multigrid<R: Scalar>(task: &Task) -> Result<Solution> {
    let why = match attempted::<R>(task)? {
        Ok(found) => return Ok(found),
        Err(why) => why,
    };
    let (solver, solution) = match ScalarKind::of::<R>() {
        ScalarKind::F64 => ("direct solver", directly(task)?),
        ScalarKind::F32 => ("kernel", by_kernel::<R>(task)?),
    };
    let after = solution.given_up.map(|next| format!("; {next}")).unwrap_or_default();
    let given_up = Some(format!("multigrid gave up, the {solver} took over: {why}{after}"));
    Ok(Solution { given_up, ..solution })
}

/// Its answer, or why it has none: from the start that is given or else from a coarser mesh, and where that fails from nothing.
pub(super) fn attempted<R: Scalar>(task: &Task) -> Result<std::result::Result<Solution, String>> {
    let is_free = task.start.is_empty() && task.is_posed;
    let clock = Instant::now();
    let Some(nested) = is_free.then(|| nested::start(task.problem)).flatten() else {
        return from_its_start::<R>(task);
    };
    let before = clock.elapsed().as_secs_f64();
    match from_its_start::<R>(&Task { start: &nested, ..*task })? {
        Ok(mut found) => {
            found.seconds.solve += before;
            Ok(Ok(found))
        }
        Err(_) => from_its_start::<R>(task),
    }
}

/// The answer from the task's start, or from nothing where that is empty. The matrix is that of the scalar; it is solved with in
/// f64, and u has a low part.
fn from_its_start<R: Scalar>(task: &Task) -> Result<std::result::Result<Solution, String>> {
    let Task { problem, options, .. } = *task;
    let attempt = Attempt::<R>::new(task)?;
    let found = match minimised(&attempt, &settings(options))? {
        Ok(found) => found,
        Err(failure) => return Ok(Err(failure.to_string())),
    };
    let system = attempt.assembled.system().map_err(unfit::<R>(&problem.scene))?;
    let mut u = attempt.started();
    u.iter_mut().zip(&found.u).for_each(|(u, &found)| *u = R::narrow(found));
    system.make_feasible(&mut u);
    let residual = system.residual(&u);
    let Some(status) = status(&residual, options) else {
        return Ok(Err(format!(
            "it stalls at a scaled residual of {:.1e}",
            residual.scaled().wide()
        )));
    };
    let low = low_part(&u, &found.u);
    let conjugate = u32::try_from(found.iterations).unwrap_or(u32::MAX);
    let outcome = Outcome { status, sweeps: 0, conjugate, residual, omega: R::ZERO };
    let solved = Solved { outcome, ran: Ran::Multigrid, factored: None, u, low };
    let (iterations, longest, sets) = (found.iterations, found.longest, found.sets);
    let work = Some(Multigrid { iterations, longest, sets });
    Ok(Ok(Solution { multigrid: work, ..attempt.conclude(solved)? }))
}

/// What the scalar rounds off the unknowns `found`, 0 on edges with given values; nothing where it rounds nothing.
fn low_part<R: Scalar>(u: &[R], found: &[f64]) -> Vec<R> {
    if ScalarKind::of::<R>() == ScalarKind::F64 {
        return Vec::new();
    }
    let mut low = vec![R::ZERO; u.len()];
    for (low, (u, found)) in low.iter_mut().zip(u.iter().zip(found)) {
        *low = R::narrow(found - u.wide());
    }
    low
}

fn settings(options: &Options) -> Settings {
    // What f32 rounds is no reason to leave digits of f64 open.
    let double = Options { scalar: ScalarKind::F64, ..*options };
    let kernel = double.settings::<f64>();
    Settings {
        tolerance: kernel.tolerance,
        accuracy: kernel.accuracy,
        most_iterations: MOST_ITERATIONS,
    }
}

/// How it ended, where that is an answer: at the tolerance, or where rounding leaves nothing to be gained.
fn status<R: Scalar>(residual: &Residual<R>, options: &Options) -> Option<Status> {
    let tolerance = options.settings::<R>().tolerance;
    match () {
        () if residual.scaled() <= tolerance => Some(Status::Converged),
        () if residual.largest.wide() <= ROUNDINGS * residual.rounding.wide() => {
            let is_wanted = options.tolerance.is_some();
            Some(if is_wanted { Status::RoundingLimit } else { Status::Converged })
        }
        () => None,
    }
}
