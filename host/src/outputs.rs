//! The quantities that a scene declares in `[output.…]`: what a controller reads.

use std::collections::BTreeMap;

use crate::error::Result;
use crate::field::CellField;
use crate::problem::{EdgeKind, Problem};
use crate::quadrature::Point;
use crate::scene::{Output, Quantity, Scene};
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
        let value = evaluate(scene, problem, reading, output)?;
        Ok(value.filter(|value| value.is_finite()))
    });
    evaluated.collect()
}

fn evaluate(
    scene: &Scene,
    problem: &Problem,
    reading: Reading,
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
        Quantity::Flux => Some(edges.fold(0.0, |sum, edge| sum + reading.flux[edge])),
        Quantity::Force => {
            let force = |edge| reading.flux[edge] - problem.loads.contact_flux[edge - free];
            Some(edges.filter(contact).map(force).fold(0.0, |sum, force| sum + force))
        }
        Quantity::Length => {
            let gap = |edge: usize| reading.scalar.round(problem.loads.gap[edge - free]);
            let active = |edge: &usize| reading.u[*edge] == gap(*edge);
            let touching = edges.filter(contact).filter(active);
            Some(touching.fold(0.0, |sum, edge| sum + problem.lengths[edge]))
        }
        Quantity::Probe { at } => Some(probe(scene, problem, reading, output, at)?),
        Quantity::Bound => reading.bound,
    })
}

/// u_h at a point: in the first cell that holds it.
fn probe(
    scene: &Scene,
    problem: &Problem,
    reading: Reading,
    output: &Output,
    at: [f64; 2],
) -> Result<f64> {
    let cells = problem.mesh.triangles.len() + problem.mesh.quads.len();
    let found = (0..cells).find_map(|cell| {
        let field = CellField::new(problem, cell, reading.u, reading.flux);
        let reference = field.locate(at)?;
        Some(field.sample(&Point { x: at, reference, weight: 0.0 }).u)
    });
    found.ok_or_else(|| {
        let message = format!("the probe at ({}, {}) lies outside the mesh", at[0], at[1]);
        scene.error(&output.name, message).hint("move `at` into the domain").into()
    })
}
