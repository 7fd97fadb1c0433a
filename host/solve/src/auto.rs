//! The solver that one would choose for the size of a problem, by an estimate of the time ([`super::cost`]).
//!
//! The factor is the kernel's, in the scalar asked for: its answers have a low part in f32, and parts that contact alone holds are
//! no exception. In f64 the host's own solvers are ahead of it on large meshes. Where one has no answer the next is asked:
//! after multigrid the direct solver, which takes what nothing holds; then the factor, and after a factor the direct solver. At
//! last sweeps say why there is none.

use signorini_kernel::solver::Status;

use super::cost::Size;
use super::multigrid;
use super::{
    Attempt, Ending, Ldlt, Ran, Result, ScalarKind, Solution, Solved, SolverKind, Task, by_kernel,
    direct, unfit, went_well,
};
use signorini_problem::Approach;
use signorini_problem::scalar::Scalar;

/// The answer of the solver that is quickest by estimate, or of another where that has none.
pub(super) fn chosen<R: Scalar>(task: &Task) -> Result<Solution> {
    let is_double = ScalarKind::of::<R>() == ScalarKind::F64;
    let quickest = match task.options.solver {
        SolverKind::Factor => Ran::Factor,
        _ => Size::of(task.problem).quickest(is_double),
    };
    let order: &[Ran] = match quickest {
        Ran::Multigrid => &[Ran::Multigrid, Ran::Direct, Ran::Factor],
        Ran::Direct => &[Ran::Direct, Ran::Factor],
        Ran::Factor => &[Ran::Factor, Ran::Direct],
        _ => &[],
    };
    for solver in order {
        let found = match solver {
            Ran::Multigrid => multigrid::attempted::<R>(task)?.ok(),
            Ran::Direct if is_double => {
                let found = direct::attempted(task);
                found.ok().and_then(|found| found.ok()).filter(is_converged)
            }
            Ran::Factor => by_factor::<R>(task, None)?,
            _ => None,
        };
        if let Some(found) = found {
            return Ok(found);
        }
    }
    // Who has no answer leaves it to the kernel to say why.
    by_kernel::<R>(task)
}

fn is_converged(found: &Solution) -> bool {
    found.status == Ending::Solve(Status::Converged)
}

/// The answer of the kernel's factor alone, of the one that is known or else of a new one. Nothing where it cannot treat the
/// problem, where a part is held by nothing, which leaves the matrix singular, where the factor would be too large, or where
/// it leaves digits open.
pub(super) fn by_factor<R: Scalar>(
    task: &Task,
    known: Option<&Ldlt<R>>,
) -> Result<Option<Solution>> {
    let Task { problem, parts, .. } = *task;
    if parts.counts.floating > 0 || Approach::Factor.lack_with(problem, parts.counts).is_some() {
        return Ok(None);
    }
    let mut attempt = Attempt::<R>::new(task)?;
    attempt.assembled.set_parts(parts);
    let mut u = attempt.started();
    let mut low = vec![R::ZERO; u.len()];
    let found = attempt.by_factor(&mut u, &mut low, known).map_err(unfit::<R>(&problem.scene))?;
    let Some((outcome, factored)) = found else { return Ok(None) };
    if !went_well(outcome.status) {
        return Ok(None);
    }
    let factored = Some(factored);
    attempt.conclude(Solved { outcome, ran: Ran::Factor, factored, u, low }).map(Some)
}
