//! Honest baselines: other solvers on the same matrices, cold and warm, at equal error.
//!
//! ```text
//!   scene, moments (t, inputs) ─► full ───────► kernel PSOR · active set · Clarabel · OSQP ─┐
//!                                  └► condensed ► kernel pivoting · Clarabel · OSQP ────────┴─► Baseline
//! ```
//! What is counted and when errors count as equal stands in `contest`. Condensing happens once a scene and
//! is outside of every count; the notes say how long it takes. Two products: [`of_scene`] and [`sizes()`].

mod active_set;
mod benchmark;
mod cascade;
mod clarabel;
mod condensed;
mod contest;
mod load_case;
mod osqp;
mod pivots;
mod psor;
mod quadratic;
mod series;
mod sizes;
mod table;
#[cfg(test)]
mod tests;

use std::fmt::Display;

use crate::mesh_solution::solve_directly;
use benchmark::Benchmark;
use load_case::load_cases;
pub use series::Baseline;
use signorini_problem::{Approach, Problem};
use signorini_scene::{Error, InputError, Result};
use signorini_solve::norms;
pub use sizes::{Sizes, sizes};
pub use table::{findings, table};

/// Warm ticks of a scene.
const TICKS: usize = 20;

/// All solvers on the problem of a scene and on its condensed problem, with remarks: solvers that could not run and
/// why, and how long condensing takes.
///
/// Warm ticks have inputs within a tenth of their defaults; a scene without inputs has its loads multiplied
/// by 1 ± 0.1 and tilted by ± 0.4 across the domain, and what contact asks for (ψ, q, limits) by another 1 ± 0.1.
/// In most scenes the contact set moves by that.
///
/// # Errors
/// A problem without a solution. A problem that the others cannot treat, or a solver that fails, is a remark.
pub fn of_scene(problem: &Problem) -> Result<(Vec<Baseline>, Vec<String>)> {
    if let Some(lack) = Approach::Baselines.lack(problem)? {
        return Ok((Vec::new(), vec![lack.to_string()]));
    }
    let mut notes = Vec::new();
    let program = osqp::program();
    notes.extend(program.err().map(str::to_owned));
    let moments = load_cases(problem, TICKS)?;
    let error = discretisation_error(problem, &mut notes)?;
    let ring = Benchmark { osqp: program.ok(), ..Benchmark::new(problem, &moments, error) };
    Ok((ring.hold(&mut notes)?, notes))
}

/// ‖A^½∇_h(u − u_h)‖ of the discrete solution; where u is not known, the gap of the error bound stands for
/// it, and where there is no bound a hundredth of the energy.
fn discretisation_error(problem: &Problem, notes: &mut Vec<String>) -> Result<f64> {
    let solution = solve_directly(problem)?;
    if let Some(exact) = &problem.scene.exact {
        return Ok(norms::errors(exact, problem, &solution.u, &solution.flux)?.energy);
    }
    if let Some(bound) = solution.bound {
        return Ok(bound.duality_gap);
    }
    notes.push("no error bound: a hundredth of the energy stands for the error".to_owned());
    Ok(0.01 * solution.energy(problem))
}

fn failed(why: impl Display) -> Error {
    InputError::new(format!("a baseline failed: {why}")).into()
}
