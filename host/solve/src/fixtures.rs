//! A solve that tests of several crates compare with.

use crate::outputs::outputs;
use crate::{Options, Solution, SolverKind, solve};
use signorini_problem::Problem;
use signorini_scene::error::Result;

/// The full problem at the inputs `p`, solved directly, with the s that models on a device have.
pub fn full_at(problem: &Problem, p: &[f64]) -> Result<(Problem, Solution, Vec<Option<f64>>)> {
    let problem = problem.with_inputs(&p[1..])?;
    let direct = Options { solver: SolverKind::Direct, averages: true, ..Options::default() };
    let solution = solve(&problem, &direct)?;
    let values = outputs(&problem, &solution)?;
    let declared = &problem.scene.outputs;
    let names: Vec<String> = match declared.is_empty() {
        true => vec!["contact_force".to_owned(), "contact_length".to_owned()],
        false => declared.iter().map(|output| output.name.value.clone()).collect(),
    };
    let values = names.iter().map(|name| values[name]).collect();
    Ok((problem, solution, values))
}
