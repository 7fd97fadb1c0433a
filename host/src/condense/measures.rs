//! Outputs as functions of (p, x): the full model's functionals applied to every column.

use super::Measure;
use super::elimination::Field;
use super::patterns::Pattern;
use crate::error::Result;
use crate::functional::{Functional, Linear, functionals};
use crate::problem::{Loads, Problem};
use crate::scene::Scene;

/// Every declared output; without any, contact force and length.
///
/// # Errors
/// A probe outside the mesh.
pub(super) fn measures(
    scene: &Scene,
    problem: &Problem,
    edges: &[usize],
    patterns: &[Pattern],
    fields: &[Field],
) -> Result<Vec<Measure>> {
    let measure = |functional: &Functional| match functional {
        Functional::Linear(functional) => linear(problem, patterns, fields, functional),
        Functional::Length(lengths) => length(problem, edges, lengths),
        Functional::Bound => Measure::Bound,
    };
    Ok(functionals(scene, problem)?.iter().map(measure).collect())
}

fn length(problem: &Problem, edges: &[usize], lengths: &[(usize, f64)]) -> Measure {
    let counts = problem.topology.counts;
    let mut by_edge = vec![0.0; counts.contact];
    for &(edge, length) in lengths {
        by_edge[edge - counts.free] = length;
    }
    Measure::Length { of_contact: edges.iter().map(|&edge| by_edge[edge]).collect() }
}

fn linear(
    problem: &Problem,
    patterns: &[Pattern],
    fields: &[Field],
    functional: &Linear,
) -> Measure {
    let silent =
        Loads { contact_flux: vec![0.0; problem.topology.counts.contact], ..Loads::default() };
    let loads = patterns.iter().map(|pattern| &pattern.loads).chain(std::iter::repeat(&silent));
    let values = fields.iter().zip(loads);
    let mut of_inputs: Vec<f64> =
        values.map(|(field, loads)| functional.at(problem, loads, &field.u, &field.flux)).collect();
    let of_contact = of_inputs.split_off(patterns.len());
    Measure::Linear { of_inputs, of_contact }
}
