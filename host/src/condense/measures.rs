//! Outputs as functions of (p, x): the full model's functionals applied to every column.

use super::Measure;
use super::elimination::Field;
use super::patterns::Pattern;
use crate::error::Result;
use crate::outputs::{Functional, contact_edges};
use crate::problem::{Loads, Problem};
use crate::scene::{Located, Output, Quantity, Scene};

/// Every declared output; without any, contact force and length.
///
/// # Errors
/// A probe outside the mesh.
pub(super) fn measures(
    scene: &Scene,
    problem: &Problem,
    patterns: &[Pattern],
    fields: &[Field],
) -> Result<Vec<Measure>> {
    let undeclared = [Quantity::Force, Quantity::Length].map(|quantity| Output {
        name: Located { value: String::new(), key: "output".to_owned(), span: 0..0 },
        quantity,
        of: None,
    });
    let outputs = if scene.outputs.is_empty() { &undeclared[..] } else { &scene.outputs };
    outputs.iter().map(|output| measure(scene, problem, patterns, fields, output)).collect()
}

fn measure(
    scene: &Scene,
    problem: &Problem,
    patterns: &[Pattern],
    fields: &[Field],
    output: &Output,
) -> Result<Measure> {
    let free = problem.topology.counts.free;
    let Some(functional) = Functional::of(scene, problem, output)? else {
        if output.quantity == Quantity::Bound {
            return Ok(Measure::Bound);
        }
        let mut of_contact = vec![0.0; problem.topology.counts.contact];
        for edge in contact_edges(scene, problem, output) {
            of_contact[edge - free] = problem.lengths[edge];
        }
        return Ok(Measure::Length { of_contact });
    };
    let silent =
        Loads { contact_flux: vec![0.0; problem.topology.counts.contact], ..Loads::default() };
    let loads = patterns.iter().map(|pattern| &pattern.loads).chain(std::iter::repeat(&silent));
    let values = fields.iter().zip(loads);
    let mut of_inputs: Vec<f64> =
        values.map(|(field, loads)| functional.at(problem, loads, &field.u, &field.flux)).collect();
    let of_contact = of_inputs.split_off(patterns.len());
    Ok(Measure::Linear { of_inputs, of_contact })
}
