//! Outputs as forms: which edges they are read off, with which weights.

use super::text::code;
use crate::error::Result;
use crate::field::CellField;
use crate::problem::{EdgeKind, Problem};
use crate::quadrature::Point;
use crate::scene::{Output, Quantity, Scene};

/// What an output is made of; places are edges.
#[derive(Debug, Clone, PartialEq)]
pub enum Measure {
    /// Σ∫σ·n over these edges.
    Flux(Vec<usize>),
    /// Σ∫(σ·n − q) over these contact edges.
    Force(Vec<usize>),
    /// The lengths of those of these contact edges that are active.
    Length(Vec<(usize, f64)>),
    /// Σ weight · mean of u.
    Probe(Vec<(usize, f64)>),
    /// The error bound.
    Bound,
}

/// An output with its name, as the scene declares it or as it is without declarations.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// As the scene has it.
    pub name: String,
    /// What it means, in a few words.
    pub meaning: String,
    /// How it is computed.
    pub measure: Measure,
}

/// All outputs of a scene: the declared ones or, without any, contact force and length.
///
/// # Errors
/// A probe outside the mesh.
pub fn measures(scene: &Scene, problem: &Problem) -> Result<Vec<Measured>> {
    if scene.outputs.is_empty() {
        let of = |name: &str, quantity| {
            Ok(Measured {
                name: name.to_owned(),
                meaning: meaning(quantity, None),
                measure: along(scene, problem, quantity, None),
            })
        };
        return [("contact_force", Quantity::Force), ("contact_length", Quantity::Length)]
            .map(|(name, quantity)| of(name, quantity))
            .into_iter()
            .collect();
    }
    let outputs = scene.outputs.iter().map(|output| {
        let of = output.of.as_ref().map(|of| of.value.as_str());
        let measure = match output.quantity {
            Quantity::Probe { at } => Measure::Probe(probe(scene, problem, output, at)?),
            quantity => along(scene, problem, quantity, of),
        };
        let name = output.name.value.clone();
        Ok(Measured { name, meaning: meaning(output.quantity, of), measure })
    });
    outputs.collect()
}

fn meaning(quantity: Quantity, of: Option<&str>) -> String {
    let place = of.map_or("all contact".to_owned(), code);
    match quantity {
        Quantity::Flux => {
            format!("∫(A∇u)·n over {place}, outward; unit of a flux times a length.")
        }
        Quantity::Force => {
            format!("∫(σ·n − q) over {place}, σ = A∇u; unit of a flux times a length.")
        }
        Quantity::Length => format!("Length of {place} where u = ψ; unit of the mesh."),
        Quantity::Probe { at: [x, y] } => format!("u at ({x}, {y})."),
        Quantity::Bound => {
            "Bound on the error in the energy norm; infinite where there is none.".to_owned()
        }
    }
}

/// Quantities that are sums over the edges of a boundary.
fn along(scene: &Scene, problem: &Problem, quantity: Quantity, of: Option<&str>) -> Measure {
    let edges = (0..problem.ends.len()).filter(|&edge| {
        let boundary = problem.binding.boundary(problem.ends[edge]);
        let name = boundary.map(|at| scene.boundaries[at].name.value.as_str());
        problem.kinds[edge] != EdgeKind::Interior && of.is_none_or(|of| Some(of) == name)
    });
    let contact = |edge: &usize| problem.kinds[*edge] == EdgeKind::Contact;
    match quantity {
        Quantity::Flux => Measure::Flux(edges.collect()),
        Quantity::Force => Measure::Force(edges.filter(contact).collect()),
        Quantity::Length => Measure::Length(
            edges.filter(contact).map(|edge| (edge, problem.lengths[edge])).collect(),
        ),
        Quantity::Probe { .. } | Quantity::Bound => Measure::Bound,
    }
}

/// u_h at a point of the first cell that holds it: the basis functions there.
fn probe(
    scene: &Scene,
    problem: &Problem,
    output: &Output,
    at: [f64; 2],
) -> Result<Vec<(usize, f64)>> {
    let none = vec![0.0; problem.ends.len()];
    let triangles = problem.mesh.triangles.len();
    let found = (0..problem.cells()).find_map(|cell| {
        let reference = CellField::new(problem, cell, &none, &none).locate(at)?;
        Some((cell, Point { x: at, reference, weight: 0.0 }))
    });
    let Some((cell, point)) = found else {
        let message = format!("the probe at ({}, {}) lies outside the mesh", at[0], at[1]);
        return Err(scene.error(&output.name, message).hint("move `at` into the domain").into());
    };
    let sides: &[u32] = match cell.checked_sub(triangles) {
        None => &problem.topology.of_triangles[cell],
        Some(quad) => &problem.topology.of_quads[quad],
    };
    let weight = |&edge: &u32| {
        let mut unit = none.clone();
        unit[edge as usize] = 1.0;
        (edge as usize, CellField::new(problem, cell, &unit, &none).sample(&point).u)
    };
    Ok(sides.iter().map(weight).collect())
}
