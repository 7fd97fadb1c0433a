//! Intervals of outputs: where a force, a flux or a mean of the exact solution lies, in its own unit.
//!
//! ```text
//!   output ─► its edges ─► a linear dual problem on the same mesh ─► ‖its weight‖ · (error bound + oscillation) ─► interval
//! ```
//! The product of one error norm with the norm of a weight is safe on any mesh and with any iterate. The error of an output is of second
//! order, so that the interval is wider than that the finer the mesh. Lengths, points and the bound itself have none.

mod dual;
mod flux;
mod mean;
mod part;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use serde::Serialize;

use crate::functional::wanted;
use crate::problem::Problem;
use crate::solve::Solution;
use part::Part;
use signorini_scene::error::Result;
use signorini_scene::scene::{Output, Quantity};

/// Beyond so many unknowns no intervals are worked out: each takes a factor of its own.
pub const MOST_UNKNOWNS: usize = 200_000;

/// Where the value of an output lies for the exact solution.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OutputBound {
    /// Its middle, in the unit of the output.
    pub center: f64,
    /// Half of its width: the exact value is not farther from the middle.
    pub plus_minus: f64,
    /// What it is the value of.
    pub of: String,
    /// The same by an estimate from two meshes, without a guarantee; none where there is a single mesh.
    pub estimate: Option<f64>,
}

impl OutputBound {
    /// From `least` to `most`, which may be off by rounding of sums of `terms`.
    fn between(least: f64, most: f64, terms: f64, of: String) -> Self {
        /// What sums of the host round, next to their terms.
        const ROUNDING: f64 = 1e-13;
        let plus_minus = 0.5 * (most - least) + ROUNDING * terms;
        Self { center: 0.5 * (least + most), plus_minus, of, estimate: None }
    }
}

/// An interval, or why there is none.
pub type Found = std::result::Result<OutputBound, String>;

/// That of every output, with those that a scene without any has.
///
/// # Errors
/// Data that are not finite.
pub fn of_outputs(problem: &Problem, solution: &Solution) -> Result<BTreeMap<String, Found>> {
    let all = wanted(&problem.scene);
    let found = all
        .iter()
        .map(|output| Ok((output.name.value.clone(), of_output(problem, solution, output)?)));
    found.collect()
}

fn of_output(problem: &Problem, solution: &Solution, output: &Output) -> Result<Found> {
    let part = || Part::new(problem, output);
    let reach = match (solution.bound, problem.topology.counts.unknowns()) {
        (None, _) => return none("the solution has no error bound"),
        (_, unknowns) if unknowns > MOST_UNKNOWNS => {
            return none(&format!("the mesh has more than {MOST_UNKNOWNS} unknowns"));
        }
        (Some(bound), _) => bound.total + bound.oscillation,
    };
    match output.quantity {
        Quantity::Flux | Quantity::Force => {
            flux::interval(problem, solution, &part(), output.quantity, reach)
        }
        Quantity::Mean => mean::interval(problem, solution, &part(), reach),
        Quantity::Length | Quantity::Saturated => none("the length of a contact set has none"),
        Quantity::Probe { .. } => none("u at a point has none; a mean over a boundary has one"),
        Quantity::Bound => none("it is a bound itself"),
    }
}

fn none(why: &str) -> Result<Found> {
    Ok(Err(why.to_owned()))
}
