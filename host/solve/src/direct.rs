//! The host's own solver: the faer reference on the kernel's matrix.

use std::collections::HashSet;

use signorini_kernel::Error as KernelError;
use signorini_kernel::mesh::components::Support;
use signorini_kernel::solver::{Outcome, Status};

use super::{Attempt, Factored, Ran, Solution, Solved, Task, by_kernel, unfit};
use signorini_problem::progress::stage;
use signorini_problem::scalar::{Scalar, widened};
use signorini_problem::{Assembled, Parts, Problem};
use signorini_reference::{Factor, ReferenceError};
use signorini_scene::error::{InputError, Result};

/// Its answer; where its active set goes round in circles that of the kernel, which says so.
pub(super) fn directly(task: &Task) -> Result<Solution> {
    match attempted(task)? {
        Ok(found) => Ok(found),
        Err(why) => {
            let solution = by_kernel::<f64>(&Task { start: &[], ..*task })?;
            let given_up = Some(format!("the direct solver gave up, the kernel took over: {why}"));
            Ok(Solution { given_up, ..solution })
        }
    }
}

/// Its answer, or why its active set does not settle.
pub(super) fn attempted(task: &Task) -> Result<std::result::Result<Solution, String>> {
    let Task { problem, parts, options, .. } = *task;
    let unfit = unfit::<f64>(&problem.scene);
    let attempt = Attempt::<f64>::new(task)?;
    let assembled = &attempt.assembled;
    let system = assembled.system().map_err(&unfit)?;
    let failed = |error: ReferenceError| {
        InputError::new(format!("the direct solver found no solution: {error}"))
            .file(&problem.scene.path)
    };
    let mut u = assembled.start();
    let reduced = Reduced::new(problem, parts, assembled, &u).map_err(&unfit)?;
    stage("a sparse Cholesky factor");
    let (lower, spans) = (system.law().lower(), system.law().spans().lengths());
    let factor = Factor::new(&reduced.problem(lower, spans)).map_err(failed)?;
    let found = match factor.solve_between(&reduced.load, lower, spans, None) {
        Err(why @ ReferenceError::Cycling { .. }) => return Ok(Err(why.to_string())),
        found => found.map_err(failed)?,
    };
    u[..found.u.len()].copy_from_slice(&found.u);
    system.make_feasible(&mut u);
    let residual = system.residual(&u);
    // It always goes on until rounding ends it: that may be short of a tolerance.
    let status = match options.tolerance {
        Some(tolerance) if residual.scaled() > tolerance => Status::RoundingLimit,
        _ => Status::Converged,
    };
    let outcome = Outcome { status, sweeps: 0, conjugate: 0, residual, omega: 0.0 };
    let (exchanges, rounds) = (found.steps as u32, found.passes as u32);
    let factored = Some(Factored { entries: factor.entries(), exchanges, rounds });
    attempt.conclude(Solved { outcome, ran: Ran::Direct, factored, u, low: Vec::new() }).map(Ok)
}

/// K and b with the Dirichlet columns moved to the right: what the reference takes.
pub struct Reduced {
    /// Where the rows of K start, and the last one ends.
    pub row_ptr: Vec<u32>,
    /// The column of each entry.
    pub col_idx: Vec<u32>,
    /// The entries.
    pub values: Vec<f64>,
    /// b
    pub load: Vec<f64>,
    /// For each contact edge, whether nothing but contact holds its part.
    pub floating: Vec<bool>,
}

impl Reduced {
    /// A part held by nothing gets a spring to 0 at one of its edges: in balance, that spring
    /// carries no force, and it only picks one of the solutions.
    pub fn new<R: Scalar>(
        problem: &Problem,
        parts: &Parts,
        assembled: &Assembled<R>,
        u: &[R],
    ) -> std::result::Result<Self, KernelError> {
        let (system, edges) = (assembled.system()?, assembled.edges());
        let counts = problem.topology.counts;
        let mut sprung = HashSet::new();
        let (rows, entries) = (system.matrix().rows(), system.matrix().values().len());
        let mut reduced = Self {
            row_ptr: Vec::with_capacity(rows + 1),
            col_idx: Vec::with_capacity(entries),
            values: Vec::with_capacity(entries),
            load: widened(system.load()),
            floating: Vec::new(),
        };
        reduced.row_ptr.push(0);
        for (i, row) in system.matrix().iter().enumerate() {
            let part = parts.of_edge(edges, i);
            let support = parts.support(part);
            let spring = support == Support::None && sprung.insert(part);
            for (column, value) in row.entries() {
                let value = value.wide();
                if column >= counts.unknowns() {
                    reduced.load[i] -= value * u[column].wide();
                    continue;
                }
                reduced.col_idx.push(column as u32);
                reduced.values.push(if spring && column == i { 2.0 * value } else { value });
            }
            reduced.row_ptr.push(reduced.values.len() as u32);
            if i >= counts.free {
                reduced.floating.push(support != Support::Held);
            }
        }
        Ok(reduced)
    }

    /// With the law of contact, as the reference takes it.
    pub(super) fn problem<'a>(
        &'a self,
        lower: &'a [f64],
        spans: &'a [f64],
    ) -> signorini_reference::Problem<'a> {
        signorini_reference::Problem {
            row_ptr: &self.row_ptr,
            col_idx: &self.col_idx,
            values: &self.values,
            load: &self.load,
            lower,
            spans,
            floating: &self.floating,
        }
    }
}
