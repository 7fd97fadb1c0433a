//! Outputs as functionals: which edges or which point they are read off, and how.

use std::borrow::Cow;

use crate::cell::Cell;
use crate::field::CellField;
use crate::quadrature::Point;
use crate::{EdgeKind, Problem};
use signorini_scene::error::Result;
use signorini_scene::scene::{Located, Output, Quantity, Scene};

/// Parts of an output; edges are counted as [`Problem`] has them.
#[derive(Debug, Clone)]
pub enum Functional {
    /// ∫τ·n over edges: within the law of contact where they are in contact, elsewhere the flux (15).
    Flux(Vec<usize>),
    /// ∫(τ·n − q) ≥ 0 over contact edges, τ within the law of contact.
    Force(Vec<usize>),
    /// u_h at a point of a cell (triangles first).
    Probe(usize, Point),
    /// Σ w_E u_E over edges: a mean over them, each with its part of their length, or over cells, or what cells store.
    Linear(Vec<(usize, f64)>),
    /// The lengths of those of these contact edges that are active.
    Length(Vec<(usize, f64)>),
    /// The lengths of those of these contact edges whose flux is at its limit.
    Saturated(Vec<(usize, f64)>),
    /// The error bound.
    Bound,
    /// The bound over time, which no single answer has.
    Window,
}

/// The declared outputs; without any, contact force and length.
pub fn wanted(scene: &Scene) -> Cow<'_, [Output]> {
    if !scene.outputs.is_empty() {
        return Cow::Borrowed(&scene.outputs);
    }
    let output = |(name, quantity): (&str, Quantity)| {
        let name = Located { value: name.to_owned(), key: "output".to_owned(), span: 0..0 };
        Output { name, quantity, of: Vec::new(), unit: None }
    };
    let defaults =
        [("contact_force", Quantity::Force), ("contact_length", Quantity::Length)].map(output);
    Cow::Owned(defaults.into())
}

/// Which of the outputs [`wanted`] are the bound over time.
pub fn windows(scene: &Scene) -> Vec<usize> {
    let outputs = scene.outputs.iter().enumerate();
    outputs.filter(|(_, of)| of.quantity == Quantity::Window).map(|(at, _)| at).collect()
}

/// Functionals of the outputs [`wanted`], in that order.
///
/// # Errors
/// A probe outside the mesh.
pub fn functionals(problem: &Problem) -> Result<Vec<Functional>> {
    wanted(&problem.scene).iter().map(|output| Functional::of(problem, output)).collect()
}

impl Functional {
    /// The functional of one output.
    ///
    /// # Errors
    /// A probe outside the mesh.
    pub fn of(problem: &Problem, output: &Output) -> Result<Self> {
        let edges = boundary_edges(problem, output);
        let contact = |edge: &usize| problem.kinds[*edge] == EdgeKind::Contact;
        let length = |edge: usize| (edge, problem.lengths[edge]);
        Ok(match output.quantity {
            Quantity::Flux => Self::Flux(edges.collect()),
            Quantity::Force => Self::Force(edges.filter(contact).collect()),
            Quantity::Probe { at } => probe(problem, output, at)?,
            Quantity::Mean => Self::Linear(parts(edges.map(length).collect())),
            Quantity::MeanInside | Quantity::Content => Self::Linear(by_edges(problem, output)),
            Quantity::Length => Self::Length(edges.filter(contact).map(length).collect()),
            Quantity::Saturated => Self::Saturated(edges.filter(contact).map(length).collect()),
            Quantity::Bound => Self::Bound,
            Quantity::Window => Self::Window,
        })
    }
}

/// What an output weighs the mean of u over each cell with: ∫_T c of a content, the part of the area of a mean over a material; 0
/// beside its materials, and of outputs that are about no cells nothing at all.
pub fn of_cells(problem: &Problem, output: &Output) -> Vec<f64> {
    let is_its = |cell: usize| {
        let material = problem.binding.materials[cell] as usize;
        output.of.is_empty() || output.is_of(&problem.scene.materials[material].name.value)
    };
    let weights = |weight: &dyn Fn(usize) -> f64| -> Vec<f64> {
        (0..problem.cells()).map(|at| if is_its(at) { weight(at) } else { 0.0 }).collect()
    };
    let sides = |cell: usize| problem.topology.edges_of(cell).len() as f64;
    match output.quantity {
        Quantity::Content => {
            weights(&|cell| sides(cell) * problem.capacities.get(cell).copied().unwrap_or(0.0))
        }
        Quantity::MeanInside => {
            let areas = weights(&|cell| Cell::of(problem, cell).area());
            let all: f64 = areas.iter().sum();
            areas.into_iter().map(|area| if all > 0.0 { area / all } else { 0.0 }).collect()
        }
        _ => Vec::new(),
    }
}

/// The value of an output for u = 1 everywhere, where it is linear in u: what a constant in all data of u adds to it.
pub fn of_one(problem: &Problem, output: &Output) -> f64 {
    match output.quantity {
        Quantity::Probe { .. } | Quantity::Mean | Quantity::MeanInside => 1.0,
        Quantity::Content => of_cells(problem, output).iter().sum(),
        Quantity::Flux
        | Quantity::Force
        | Quantity::Length
        | Quantity::Saturated
        | Quantity::Bound
        | Quantity::Window => 0.0,
    }
}

/// Weights of cells as such of their sides: the mean over a cell is that of its sides' means.
fn by_edges(problem: &Problem, output: &Output) -> Vec<(usize, f64)> {
    let mut weights = vec![0.0; problem.ends.len()];
    for (cell, weight) in of_cells(problem, output).into_iter().enumerate() {
        let sides = problem.topology.edges_of(cell);
        let each = weight / sides.len() as f64;
        sides.iter().for_each(|&edge| weights[edge as usize] += each);
    }
    weights.into_iter().enumerate().filter(|(_, weight)| *weight != 0.0).collect()
}

/// The sides of a cell, each with the value of its basis function at a point of that cell.
pub fn basis_at(problem: &Problem, cell: usize, point: &Point) -> Vec<(usize, f64)> {
    let weight = |(side, &edge): (usize, &u32)| {
        let unit = [0, 1, 2, 3].map(|k| f64::from(u8::from(k == side)));
        (edge as usize, CellField::of_sides(problem, cell, unit, [0.0; 4]).sample(point).u)
    };
    problem.topology.edges_of(cell).iter().enumerate().map(weight).collect()
}

/// Lengths over their sum.
fn parts(lengths: Vec<(usize, f64)>) -> Vec<(usize, f64)> {
    let all: f64 = lengths.iter().map(|(_, length)| length).sum();
    lengths.into_iter().map(|(edge, length)| (edge, length / all)).collect()
}

/// The boundary edges that an output is about, each once.
fn boundary_edges(problem: &Problem, output: &Output) -> impl Iterator<Item = usize> {
    (0..problem.ends.len()).filter(move |&edge| {
        let boundary = problem.boundary_of(edge);
        let wanted =
            output.of.is_empty() || boundary.is_some_and(|of| output.is_of(&of.name.value));
        problem.kinds[edge] != EdgeKind::Interior && wanted
    })
}

/// u_h at a point: in the first cell that holds it.
fn probe(problem: &Problem, output: &Output, at: [f64; 2]) -> Result<Functional> {
    let found = (0..problem.cells()).find_map(|cell| {
        let reference = CellField::of_sides(problem, cell, [0.0; 4], [0.0; 4]).locate(at)?;
        Some(Functional::Probe(cell, Point { x: at, reference, weight: 0.0 }))
    });
    found.ok_or_else(|| {
        let message = format!("the probe at ({}, {}) lies outside the mesh", at[0], at[1]);
        problem.scene.error(&output.name, message).hint("move `at` into the domain").into()
    })
}
