//! The quantities that a scene declares in `[output.…]`: what a controller reads.

use std::collections::BTreeMap;

use crate::error::Result;
use crate::functional::Functional;
use crate::problem::Problem;
use crate::scene::Scene;
use crate::solve::{ScalarKind, Solution};

/// What outputs are read off.
#[derive(Debug, Clone, Copy)]
pub struct Reading<'a> {
    /// The scalar type it was computed in.
    pub scalar: ScalarKind,
    /// Mean of u_h over each edge.
    pub u: &'a [f64],
    /// ∫_E σ·n of each edge.
    pub flux: &'a [f64],
    /// The bound on its error, where there is one.
    pub bound: Option<f64>,
}

/// Every declared output; without any, contact force and length. `None` where a quantity has no value.
///
/// # Errors
/// A probe outside the mesh.
pub fn outputs(
    scene: &Scene,
    problem: &Problem,
    solution: &Solution,
) -> Result<BTreeMap<String, Option<f64>>> {
    if scene.outputs.is_empty() {
        let force = ("contact_force".to_owned(), Some(solution.contact_force));
        let length = ("contact_length".to_owned(), Some(solution.contact_length));
        return Ok([force, length].into());
    }
    let Solution { scalar, u, flux, bound, .. } = solution;
    let bound = bound.map(|bound| bound.total);
    let values = declared(scene, problem, Reading { scalar: *scalar, u, flux, bound })?;
    let names = scene.outputs.iter().map(|output| output.name.value.clone());
    Ok(names.zip(values).collect())
}

/// The values of the declared outputs, in the order of the scene.
///
/// # Errors
/// A probe outside the mesh.
pub fn declared(scene: &Scene, problem: &Problem, reading: Reading) -> Result<Vec<Option<f64>>> {
    let evaluated = scene.outputs.iter().map(|output| {
        let value = evaluate(problem, reading, &Functional::of(scene, problem, output)?);
        Ok(value.filter(|value| value.is_finite()))
    });
    evaluated.collect()
}

fn evaluate(problem: &Problem, reading: Reading, functional: &Functional) -> Option<f64> {
    let free = problem.topology.counts.free;
    match functional {
        Functional::Linear(linear) => {
            Some(linear.at(problem, &problem.loads, reading.u, reading.flux))
        }
        Functional::Length(lengths) => {
            let gap = |edge: usize| reading.scalar.round(problem.loads.gap[edge - free]);
            let active = lengths.iter().filter(|(edge, _)| reading.u[*edge] == gap(*edge));
            Some(active.fold(0.0, |sum, (_, length)| sum + length))
        }
        Functional::Bound => reading.bound,
    }
}
