//! One contact problem solved: by the kernel in either scalar, or by the faer reference.
//!
//! ```text
//!   problem ─► units ─► auto ─┬─► factored, direct    a factor of the free unknowns
//!                             ├─► multigrid           conjugate gradients
//!                             └─► the kernel          sweeps
//!                                     └─► conclude ─► Solution, certified ─► outputs, norms
//!   adaptive: solve, bound, mark, refine
//! ```

pub mod adaptive;
mod auto;
pub mod by_factor;
mod carried;
mod conclude;
pub mod cost;
pub mod decay;
mod direct;
mod ending;
pub mod energy_norm;
mod factored;
pub mod fixtures;
mod ldlt;
mod level;
mod minimised;
mod mixed;
mod multigrid;
mod nested;
pub mod norms;
mod options;
pub mod outputs;
pub mod prolongation;
mod shared;
mod solution;
mod start;
#[cfg(test)]
mod tests;
mod tuned;
pub mod units;

pub use cost::is_long_to_sweep;
pub use ending::{Ending, Ran, status_name, went_well};
pub use level::{FreeLevel, free_levels};
pub use mixed::{Corrected, Mixed};
pub use multigrid::Multigrid;
pub use options::{MOST_SWEEPS, Options, ScalarKind, SolverKind};
pub use shared::{MOST_FACTORED, SharedSolver};
pub use solution::{Factored, Seconds, Solution};
pub use start::{Start, at_start, check_stated, own_defaults, step_of, warnings};
pub use tuned::{Trials, tuned_omega};
pub use units::{Scaled, choose as choose_units, choose_for_inputs, in_scene, times};

use signorini_kernel::refinement;
use signorini_kernel::rows::{self, Row, Rows};
use signorini_kernel::solver::{Outcome, Settings, Status};
use signorini_kernel::{Error as KernelError, Libm};

pub use conclude::read_off;
use conclude::{Attempt, Solved, Task};
pub use direct::Reduced;
pub use ldlt::{Exchanges, Ldlt, exchanges};
use signorini_problem::progress::stage;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Approach, Parts, Problem};
use signorini_scene::error::{Error, InputError, Result};
use signorini_scene::scene::Scene;
pub use solution::centre_floating;

/// Solves `problem`; where its numbers are far from 1, in units in which
/// they are not ([`Solution::units`]).
///
/// # Errors
/// No solution, numbers that the scalar type cannot hold, a singular matrix.
pub fn solve(problem: &Problem, options: &Options) -> Result<Solution> {
    solve_from(problem, options, &[])
}

/// Solves from a start: the mean of u over each unknown edge, such as a coarser mesh or other data give it. Entries of Dirichlet
/// edges are ignored: there the problem's own data hold. Empty, it is a cold start, or one that multigrid has from a coarser
/// mesh. The direct solver takes none.
///
/// # Errors
/// As for [`solve`].
pub fn solve_from(problem: &Problem, options: &Options, start: &[f64]) -> Result<Solution> {
    let scaled = Scaled::new(problem, choose_units(problem)?)?;
    let (units, inverse) = (scaled.units, scaled.units.inverse());
    let start: Vec<f64> = start.iter().map(|&u| inverse.value(u)).collect();
    let solution = solve_in_its_units(scaled.problem(), options, &start)?;
    let Some(other) = scaled.other() else { return Ok(solution) };
    Ok(in_scene(&other, &units, solution))
}

fn solve_in_its_units(problem: &Problem, options: &Options, start: &[f64]) -> Result<Solution> {
    let parts = &Parts::examine(problem)?;
    let task = &Task { problem, parts, options, start, is_posed: true };
    match (options.solver, options.scalar) {
        (SolverKind::Direct, ScalarKind::F64) => direct::directly(task),
        (SolverKind::Direct, ScalarKind::F32) => {
            let message = "--solver direct works in f64, --scalar f32 was asked for";
            Err(InputError::new(message).hint("leave out --scalar, or use --solver auto").into())
        }
        (_, ScalarKind::F64) => in_scalar::<f64>(task),
        (_, ScalarKind::F32) => in_scalar::<f32>(task),
    }
}

fn in_scalar<R: Scalar>(task: &Task) -> Result<Solution> {
    match task.options.solver {
        SolverKind::Kernel => by_kernel::<R>(task),
        SolverKind::Multigrid => multigrid::by_multigrid::<R>(task),
        _ => auto::chosen::<R>(task),
    }
}

/// The kernel's refusal, in the scene's words.
pub fn unfit<R: Scalar>(scene: &Scene) -> impl Fn(KernelError) -> Error + '_ {
    |error| {
        let refused = match error {
            KernelError::NoSolution { .. } | KernelError::NotUnique { .. } => {
                let hint = "without a Dirichlet or Robin boundary loads have to push every part onto its contact";
                InputError::new(error.to_string()).file(&scene.path).hint(hint)
            }
            KernelError::EmptyRange { input } if input < scene.inputs.len() => {
                let name = &scene.inputs[input].name.value;
                let message = format!("input.{name}: it brings a limit below its flux");
                InputError::new(message)
                    .file(&scene.path)
                    .hint("a flux lies between `flux` and `limit`, inputs included")
            }
            KernelError::Excluded { .. } => {
                let message = "with these inputs two boundaries that meet exclude each other's values of u: a gap and a Dirichlet \
                               value, or two gaps";
                InputError::new(message)
                    .file(&scene.path)
                    .hint("declare ranges of the inputs: `bake` then says where")
            }
            _ => beyond(scene, format!("the scene does not fit {}: {error}", R::NAME)),
        };
        refused.because(error).into()
    }
}

fn overflow<R: Scalar>(scene: &Scene) -> Error {
    beyond(scene, format!("not-finite: the solution overflows {}", R::NAME)).into()
}

fn beyond(scene: &Scene, message: String) -> InputError {
    let hint = "scale the data so that they are neither tiny nor huge, or use --scalar f64";
    InputError::new(message).file(&scene.path).hint(hint)
}

fn by_kernel<R: Scalar>(task: &Task) -> Result<Solution> {
    let mut attempt = Attempt::<R>::new(task)?;
    attempt.assembled.set_parts(task.parts);
    let mut u = attempt.started();
    let mut low = vec![R::ZERO; u.len()];
    let found = match task.problem.mesh.quads.is_empty() {
        true => attempt.iterate::<{ rows::TRIANGLES }>(&mut u, &mut low),
        false => attempt.iterate::<{ rows::QUADS }>(&mut u, &mut low),
    };
    let (outcome, factored) = found.map_err(unfit::<R>(&task.problem.scene))?;
    let ran = if factored.is_some() { Ran::Factor } else { Ran::Sweeps };
    attempt.conclude(Solved { outcome, ran, factored, u, low })
}

impl<R: Scalar> Attempt<'_, R> {
    /// Sweeps with rows of `WIDTH` entries and refines, and where that does not end, or is not expected to, takes the factor, if it
    /// may; `low` becomes the low part of `u`.
    fn iterate<const WIDTH: usize>(
        &self,
        u: &mut [R],
        low: &mut [R],
    ) -> std::result::Result<(Outcome<R>, Option<Factored>), KernelError> {
        let Task { problem, parts, options, .. } = self.task;
        let (system, diagonal) = (self.assembled.system()?, self.assembled.diagonal()?);
        let (edges, counts) = (self.assembled.edges(), problem.topology.counts);
        let (rounds, settings) = (options.rounds(), options.settings::<R>());
        let may_factor = Approach::Factor.lack_with(problem, parts.counts).is_none();
        let sweep = |settings, u: &mut [R], low: &mut [R]| {
            let mut rows = vec![Row::<R, u32, WIDTH>::EMPTY; counts.unknowns()];
            let rows = Rows::new(edges, &mut rows)?;
            let mut scratch = vec![R::ZERO; refinement::scratch(counts)];
            let u = [u, low];
            refinement::run::<R, u32, Libm, WIDTH>(
                &system,
                diagonal,
                settings,
                rounds,
                u,
                rows,
                &mut scratch,
            )
        };
        let is_long = cost::sweeps(counts.unknowns()) > f64::from(refinement::PLAIN);
        let at_once = may_factor && options.max_sweeps.is_none() && is_long;
        if at_once && let Some((found, factored)) = self.by_factor(u, low, None)? {
            return Ok((found, Some(factored)));
        }
        let most = settings.max_sweeps;
        let patience = Settings { max_sweeps: most.min(refinement::PLAIN), ..settings };
        stage(&format!("at most {} sweeps", patience.max_sweeps));
        let swept = sweep(patience, u, low)?;
        let ended = !matches!(swept.status, Status::OutOfSweeps | Status::Stalled);
        if ended || swept.sweeps >= most {
            return Ok((swept, None));
        }
        // What has no factor from one start has none from another.
        if may_factor
            && !at_once
            && let Some((found, factored)) = self.by_factor(u, low, None)?
        {
            return Ok((Outcome { sweeps: swept.sweeps, ..found }, Some(factored)));
        }
        let left = most - swept.sweeps;
        stage(&format!("at most {left} more sweeps, as no factor solves it"));
        let mut found = sweep(Settings { max_sweeps: left, ..settings }, u, low)?;
        found.sweeps = found.sweeps.saturating_add(swept.sweeps);
        Ok((found, None))
    }
}
