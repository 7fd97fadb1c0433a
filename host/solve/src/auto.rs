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
    Attempt, Ending, Ldlt, Options, Ran, Result, ScalarKind, Solution, Solved, SolverKind,
    by_kernel, direct, factored, unfit, went_well,
};
use signorini_problem::scalar::Scalar;
use signorini_problem::{Approach, Parts, Problem};

/// The answer of the solver that is quickest by estimate, or of another where that has none.
pub(super) fn chosen<R: Scalar>(
    problem: &Problem,
    parts: &Parts,
    options: &Options,
    start: &[f64],
) -> Result<Solution> {
    let is_double = ScalarKind::of::<R>() == ScalarKind::F64;
    let quickest = match options.solver {
        SolverKind::Factor => Ran::Factor,
        _ => Size::of(problem).quickest(is_double),
    };
    let order: &[Ran] = match quickest {
        Ran::Multigrid => &[Ran::Multigrid, Ran::Direct, Ran::Factor],
        Ran::Direct => &[Ran::Direct, Ran::Factor],
        Ran::Factor => &[Ran::Factor, Ran::Direct],
        _ => &[],
    };
    for solver in order {
        let found = match solver {
            Ran::Multigrid => multigrid::attempted::<R>(problem, parts, options, start)?.ok(),
            Ran::Direct if is_double => {
                let found = direct::attempted(problem, parts, options);
                found.ok().and_then(|found| found.ok()).filter(is_converged)
            }
            Ran::Factor => by_factor::<R>(problem, parts, options, start, None)?,
            _ => None,
        };
        if let Some(found) = found {
            return Ok(found);
        }
    }
    // Who has no answer leaves it to the kernel to say why.
    by_kernel::<R>(problem, parts, options, start)
}

fn is_converged(found: &Solution) -> bool {
    found.status == Ending::Solve(Status::Converged)
}

/// The answer of the kernel's factor alone, of the one that is known or else of a new one. Nothing where it cannot treat the
/// problem, where a part is held by nothing, which leaves the matrix singular, where the factor would be too large, or where
/// it leaves digits open.
pub(super) fn by_factor<R: Scalar>(
    problem: &Problem,
    parts: &Parts,
    options: &Options,
    start: &[f64],
    known: Option<&Ldlt<R>>,
) -> Result<Option<Solution>> {
    if parts.counts.floating > 0 || Approach::Factor.lack_with(problem, parts.counts).is_some() {
        return Ok(None);
    }
    let unfit = unfit::<R>(&problem.scene);
    let mut attempt = Attempt::<R>::new(problem, parts, options)?;
    attempt.assembled.set_parts(parts);
    let system = attempt.assembled.system().map_err(&unfit)?;
    let diagonal = attempt.assembled.diagonal().map_err(&unfit)?;
    let mut u = attempt.started(start);
    let mut low = vec![R::ZERO; u.len()];
    let settings = options.settings::<R>();
    let found = factored::solve(&system, diagonal, &settings, &mut u, &mut low, known);
    let Some((outcome, factored)) = found.map_err(&unfit)? else { return Ok(None) };
    if !went_well(outcome.status) {
        return Ok(None);
    }
    let factored = Some(factored);
    attempt.conclude(Solved { outcome, ran: Ran::Factor, factored, u, low }).map(Some)
}
