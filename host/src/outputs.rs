//! The quantities that a scene declares in `[output.…]`: what a controller reads.

use std::collections::BTreeMap;

use crate::error::Result;
use crate::field::CellField;
use crate::problem::{EdgeKind, Problem};
use crate::quadrature::Point;
use crate::scene::{Output, Quantity, Scene};
use crate::solve::Solution;

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
    let evaluated = scene.outputs.iter().map(|output| {
        let value = evaluate(scene, problem, solution, output)?;
        Ok((output.name.value.clone(), value.filter(|value| value.is_finite())))
    });
    evaluated.collect()
}

fn evaluate(
    scene: &Scene,
    problem: &Problem,
    solution: &Solution,
    output: &Output,
) -> Result<Option<f64>> {
    let free = problem.topology.counts.free;
    let edges = (0..problem.ends.len()).filter(|&edge| {
        let boundary = problem.binding.boundary(problem.ends[edge]);
        let name = boundary.map(|at| &scene.boundaries[at].name.value);
        let wanted = output.of.as_ref().is_none_or(|of| Some(&of.value) == name);
        problem.kinds[edge] != EdgeKind::Interior && wanted
    });
    let contact = |edge: &usize| problem.kinds[*edge] == EdgeKind::Contact;
    Ok(match output.quantity {
        Quantity::Flux => Some(edges.fold(0.0, |sum, edge| sum + solution.flux[edge])),
        Quantity::Force => {
            let force = |edge| solution.flux[edge] - problem.loads.contact_flux[edge - free];
            Some(edges.filter(contact).map(force).fold(0.0, |sum, force| sum + force))
        }
        Quantity::Length => {
            let active = |edge: &usize| solution.u[*edge] == solution.gap(problem, *edge - free);
            let touching = edges.filter(contact).filter(active);
            Some(touching.fold(0.0, |sum, edge| sum + problem.lengths[edge]))
        }
        Quantity::Probe { at } => Some(probe(scene, problem, solution, output, at)?),
        Quantity::Bound => None,
    })
}

/// u_h at a point: in the first cell that holds it.
fn probe(
    scene: &Scene,
    problem: &Problem,
    solution: &Solution,
    output: &Output,
    at: [f64; 2],
) -> Result<f64> {
    let cells = problem.mesh.triangles.len() + problem.mesh.quads.len();
    let found = (0..cells).find_map(|cell| {
        let field = CellField::new(problem, cell, &solution.u, &solution.flux);
        let reference = field.locate(at)?;
        Some(field.sample(&Point { x: at, reference, weight: 0.0 }).u)
    });
    found.ok_or_else(|| {
        let message = format!("the probe at ({}, {}) lies outside the mesh", at[0], at[1]);
        scene.error(&output.name, message).hint("move `at` into the domain").into()
    })
}
