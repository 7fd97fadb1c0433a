//! The solver that one would choose for the size of a problem, by an estimate of the work.
//!
//! With N unknowns, rows of w entries and n contact edges, in multiply-adds:
//! ```text
//!   sweeps    10 √N · w N                  an ω near the best: 9 to 60 √N sweeps on the standard scenes
//!   a factor  2500 N + 10 N^1.5 + n³       order and pattern, columns of L, exchanges on the dense S
//! ```
//! The number of sweeps is that of the easiest scenes: on those the two cross at about 4000 unknowns (triangles,
//! 1700 on quads), on the others the factor is ahead from some 1000 on, by milliseconds, as even the 10 000 sweeps
//! after which the kernel takes its factor are a tenth of a second there. Beyond, sweeps fall behind quickly: by 5
//! to 10 times at 20 000 unknowns, in either scalar. The estimate counts work, not time: the same problem is solved
//! in the same way on every machine.
//!
//! The factor is the kernel's, in the scalar asked for: it takes as long as the direct solver at 40 000 unknowns, half
//! of that at 6000, its answers have a low part in f32, and parts that contact alone holds are no exception.
//! The direct solver takes over where it has no answer, in f64: where nothing holds a part. One factor may serve many problems
//! on the same matrix.

use signorini_kernel::rows;
use signorini_kernel::solver::Status;

use super::{
    Attempt, Ending, Ldlt, Options, Ran, Result, ScalarKind, Solution, Solved, SolverKind,
    by_kernel, direct, factored, unfit, went_well,
};
use signorini_problem::scalar::Scalar;
use signorini_problem::{Approach, Assembled, Parts, Problem};

/// Sweeps per √N, from below: a problem that needs more is only solved sooner by the factor.
const SWEEPS: f64 = 10.0;
/// Order and pattern of the factor, per unknown.
const ORDERING: f64 = 2500.0;
/// Columns of L, per N^1.5.
const COLUMNS: f64 = 10.0;

/// Whether a factor is estimated to take less work than sweeps.
pub fn prefers_factor(problem: &Problem) -> bool {
    let counts = problem.topology.counts;
    let width = if problem.mesh.quads.is_empty() { rows::TRIANGLES } else { rows::QUADS };
    let (unknowns, contact) = (counts.unknowns() as f64, counts.contact as f64);
    let swept = SWEEPS * unknowns.powf(1.5) * (1.0 + width as f64);
    let factored = ORDERING * unknowns + COLUMNS * unknowns.powf(1.5) + contact.powi(3);
    factored < swept
}

/// The kernel's factor or the direct solver (which works in f64) where a factor is less work, and sweeps where it is not
/// or where neither has an answer.
pub(super) fn chosen<R: Scalar>(
    problem: &Problem,
    parts: &Parts,
    options: &Options,
    start: &[f64],
) -> Result<Solution> {
    if options.solver == SolverKind::Factor || prefers_factor(problem) {
        if let Some(found) = by_factor::<R>(problem, parts, options, start, None)? {
            return Ok(found);
        }
        // Who has no answer leaves it to the kernel to say why.
        if ScalarKind::of::<R>() == ScalarKind::F64
            && let Ok(found) = direct::directly(problem, parts, options)
            && found.status == Ending::Solve(Status::Converged)
        {
            return Ok(found);
        }
    }
    by_kernel::<R>(problem, parts, options, start)
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

/// The factor of a matrix, for many problems: all loads and laws of contact.
#[derive(Debug)]
pub struct SharedFactor(Ldlt<f64>);

impl SharedFactor {
    /// Factor of `problem`; `None` where it is singular, or would take too much memory.
    ///
    /// # Errors
    /// Numbers that f64 cannot hold.
    pub fn of(problem: &Problem) -> Result<Option<Self>> {
        let unfit = unfit::<f64>(&problem.scene);
        let assembled = Assembled::<f64>::new(problem).map_err(&unfit)?;
        let system = assembled.system().map_err(&unfit)?;
        Ok(Ldlt::new(&system).map_err(&unfit)?.map(Self))
    }

    /// Solves a problem with this matrix, in the units that it has; nothing where it has no solution.
    ///
    /// # Errors
    /// Numbers that f64 cannot hold.
    pub fn solve(&self, problem: &Problem) -> Result<Option<Solution>> {
        let parts = Parts::examine(problem)?;
        by_factor(problem, &parts, &Options::default(), &[], Some(&self.0))
    }
}
