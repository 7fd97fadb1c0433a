//! The change of the solution where a function of micromath replaces libm's.
//!
//! A function is used in two places: in the load data that a controller evaluates itself (`loads`), and,
//! the square root alone, by the kernel (`roots`): in the search for ω and in the lengths of edges. Each
//! is replaced by itself, everything else stays, and `change` says how far the answer moves.

mod change;
mod loads;
mod roots;
#[cfg(test)]
mod tests;

use super::record::FunctionCost;
use signorini_problem::Problem;
use signorini_scene::error::Result;

/// A row for every function that the loads of `problem` call, one for f32 alone where they call any, and
/// those of the kernel's square root; at its time.
///
/// # Errors
/// A scene that has no solution as it stands, or none in f32.
pub fn of_scene(problem: &Problem) -> Result<Vec<FunctionCost>> {
    let mut rows = loads::rows(problem)?;
    rows.extend(roots::rows(problem)?);
    Ok(rows)
}
