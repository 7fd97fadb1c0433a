//! The quantities that a scene declares in `[output.…]`: what a controller reads.

use std::collections::BTreeMap;

use crate::error::Result;
use crate::field::CellField;
use crate::problem::{EdgeKind, Loads, Problem};
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
    if let Some(functional) = Functional::of(scene, problem, output)? {
        return Ok(Some(functional.at(problem, &problem.loads, reading.u, reading.flux)));
    }
    if output.quantity == Quantity::Bound {
        return Ok(reading.bound);
    }
    let free = problem.topology.counts.free;
    let gap = |edge: usize| reading.scalar.round(problem.loads.gap[edge - free]);
    let active = |edge: &usize| reading.u[*edge] == gap(*edge);
    let touching = contact_edges(scene, problem, output).filter(active);
    Ok(Some(touching.fold(0.0, |sum, edge| sum + problem.lengths[edge])))
}

/// A quantity that is linear in the solution and its loads.
#[derive(Debug, Clone)]
pub enum Functional {
    /// ∫σ·n over edges.
    Flux(Vec<usize>),
    /// ∫(σ·n − q) over contact edges.
    Force(Vec<usize>),
    /// u_h at a point of a cell (triangles first).
    Probe(usize, Point),
}

impl Functional {
    /// That of an output; `None` where it is not linear.
    ///
    /// # Errors
    /// A probe outside the mesh.
    pub fn of(scene: &Scene, problem: &Problem, output: &Output) -> Result<Option<Self>> {
        Ok(match output.quantity {
            Quantity::Flux => Some(Self::Flux(boundary_edges(scene, problem, output).collect())),
            Quantity::Force => Some(Self::Force(contact_edges(scene, problem, output).collect())),
            Quantity::Probe { at } => Some(probe(scene, problem, output, at)?),
            Quantity::Length | Quantity::Bound => None,
        })
    }

    /// Its value, from edge means, edge fluxes and the loads they belong to.
    pub fn at(&self, problem: &Problem, loads: &Loads, u: &[f64], flux: &[f64]) -> f64 {
        let free = problem.topology.counts.free;
        match self {
            Self::Flux(edges) => edges.iter().fold(0.0, |sum, &edge| sum + flux[edge]),
            Self::Force(edges) => {
                let force = |&edge: &usize| flux[edge] - loads.contact_flux[edge - free];
                edges.iter().map(force).fold(0.0, |sum, force| sum + force)
            }
            Self::Probe(cell, point) => CellField::new(problem, *cell, u, flux).sample(point).u,
        }
    }
}

/// The boundary edges that an output is about.
fn boundary_edges(
    scene: &Scene,
    problem: &Problem,
    output: &Output,
) -> impl Iterator<Item = usize> {
    (0..problem.ends.len()).filter(move |&edge| {
        let boundary = problem.binding.boundary(problem.ends[edge]);
        let name = boundary.map(|at| &scene.boundaries[at].name.value);
        let wanted = output.of.as_ref().is_none_or(|of| Some(&of.value) == name);
        problem.kinds[edge] != EdgeKind::Interior && wanted
    })
}

/// The contact edges among them.
pub(crate) fn contact_edges(
    scene: &Scene,
    problem: &Problem,
    output: &Output,
) -> impl Iterator<Item = usize> {
    let edges = boundary_edges(scene, problem, output);
    edges.filter(|&edge| problem.kinds[edge] == EdgeKind::Contact)
}

/// u_h at a point: in the first cell that holds it.
fn probe(scene: &Scene, problem: &Problem, output: &Output, at: [f64; 2]) -> Result<Functional> {
    let nothing = vec![0.0; problem.ends.len()];
    let found = (0..problem.cells()).find_map(|cell| {
        let reference = CellField::new(problem, cell, &nothing, &nothing).locate(at)?;
        Some(Functional::Probe(cell, Point { x: at, reference, weight: 0.0 }))
    });
    found.ok_or_else(|| {
        let message = format!("the probe at ({}, {}) lies outside the mesh", at[0], at[1]);
        scene.error(&output.name, message).hint("move `at` into the domain").into()
    })
}
