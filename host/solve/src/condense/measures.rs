//! Outputs as functions of (p, x, r): the full model's functionals applied to every column, and on contact
//! edges the reactions.

use super::Measure;
use super::elimination::Field;
use super::patterns::Pattern;
use crate::field::CellField;
use crate::functional::{Functional, functionals};
use crate::problem::{EdgeKind, Problem};
use signorini_scene::error::Result;

/// Every declared output; without any, contact force and length. `openings` are the d of U = 1.
///
/// # Errors
/// A probe outside the mesh.
pub(super) fn measures(
    problem: &Problem,
    edges: &[usize],
    openings: &[f64],
    patterns: &[Pattern],
    fields: &[Field],
) -> Result<Vec<Measure>> {
    let columns = Columns { problem, edges, openings, patterns, fields };
    let measure = |functional: &Functional| match functional {
        Functional::Flux(edges) => columns.flux(edges),
        Functional::Force(edges) => Measure::Flux {
            of_inputs: Vec::new(),
            of_contact: Vec::new(),
            of_reaction: columns.reactions(edges),
        },
        Functional::Probe(cell, point) => columns
            .linear(|Field { u, flux }| CellField::new(problem, *cell, u, flux).sample(point).u),
        Functional::Mean(parts) => columns.linear(|Field { u, .. }| {
            parts.iter().fold(0.0, |sum, &(edge, part)| sum + part * u[edge])
        }),
        Functional::Length(lengths) => {
            Measure::Length { always: 0.0, of_contact: columns.by_unknown(lengths) }
        }
        // Only problems without limits are condensed.
        Functional::Saturated(_) => columns.linear(|_| 0.0),
        Functional::Bound => Measure::Bound,
    };
    Ok(functionals(problem)?.iter().map(measure).collect())
}

/// What outputs are made of.
struct Columns<'a> {
    problem: &'a Problem,
    /// The contact edge of each unknown.
    edges: &'a [usize],
    openings: &'a [f64],
    patterns: &'a [Pattern],
    fields: &'a [Field],
}

impl Columns<'_> {
    /// The flux (15) through edges that are not in contact, q and the reactions through those that are.
    fn flux(&self, edges: &[usize]) -> Measure {
        let is_contact = |edge: &usize| self.problem.kinds[*edge] == EdgeKind::Contact;
        let (contact, rest): (Vec<usize>, Vec<usize>) = edges.iter().partition(|e| is_contact(e));
        let recovered = |field: &Field| rest.iter().fold(0.0, |sum, &edge| sum + field.flux[edge]);
        let elsewhere = self.linear(recovered);
        if contact.is_empty() {
            return elsewhere;
        }
        let (mut of_inputs, of_contact) = match elsewhere {
            Measure::Linear { of_inputs, of_contact } if !rest.is_empty() => {
                (of_inputs, of_contact)
            }
            _ => (vec![0.0; self.patterns.len()], Vec::new()),
        };
        let free = self.problem.topology.counts.free;
        for (sum, pattern) in of_inputs.iter_mut().zip(self.patterns) {
            *sum +=
                contact.iter().map(|edge| pattern.loads().contact_flux[edge - free]).sum::<f64>();
        }
        let brings = of_inputs.iter().any(|&factor| factor != 0.0);
        let of_inputs = if brings { of_inputs } else { Vec::new() };
        Measure::Flux { of_inputs, of_contact, of_reaction: self.reactions(&contact) }
    }

    /// Σ Y_p p + Σ Y_x x
    fn linear(&self, value: impl Fn(&Field) -> f64) -> Measure {
        let mut of_inputs: Vec<f64> = self.fields.iter().map(value).collect();
        let of_contact = of_inputs.split_off(self.patterns.len());
        Measure::Linear { of_inputs, of_contact }
    }

    /// ∫_E (τ·n − q) for r̂ = 1 on each of these contact edges.
    fn reactions(&self, edges: &[usize]) -> Vec<f64> {
        let ones: Vec<_> = edges.iter().map(|&edge| (edge, 1.0)).collect();
        let counts = self.by_unknown(&ones).into_iter();
        counts.zip(self.openings).map(|(counts, opening)| counts / opening).collect()
    }

    /// What belongs to contact edges, in the order of the unknowns.
    fn by_unknown(&self, numbers: &[(usize, f64)]) -> Vec<f64> {
        let counts = self.problem.topology.counts;
        let mut by_edge = vec![0.0; counts.contact];
        numbers.iter().for_each(|&(edge, number)| by_edge[edge - counts.free] = number);
        self.edges.iter().map(|&edge| by_edge[edge]).collect()
    }
}
