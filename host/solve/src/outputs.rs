//! The quantities that a scene declares in `[output.…]`: what a controller reads.

use std::collections::BTreeMap;

use signorini_kernel::law::EdgeLaw;

use crate::{ScalarKind, Solution};
use signorini_problem::field::CellField;
use signorini_problem::functional::{Functional, of_one};
use signorini_problem::{EdgeKind, Problem};
use signorini_scene::error::Result;

/// Answer that outputs are read off.
#[derive(Debug, Clone, Copy)]
pub struct Reading<'a> {
    /// The scalar type it was computed in.
    pub scalar: ScalarKind,
    /// Mean of u_h over each edge.
    pub u: &'a [f64],
    /// ∫_E σ·n of each edge, by (15) or balanced.
    pub flux: &'a [f64],
    /// The bound on its error, where there is one.
    pub bound: Option<f64>,
}

/// Every declared output; without any, contact force and length. `None` where a quantity has no value.
///
/// # Errors
/// A probe outside the mesh.
pub fn outputs(problem: &Problem, solution: &Solution) -> Result<BTreeMap<String, Option<f64>>> {
    if problem.scene.outputs.is_empty() {
        let force = ("contact_force".to_owned(), Some(solution.contact_force));
        let length = ("contact_length".to_owned(), Some(solution.contact_length));
        return Ok([force, length].into());
    }
    if let Some((problem, own)) = solution.in_its_units() {
        let mut all = outputs(problem, own)?;
        for output in &problem.scene.outputs {
            if let Some(Some(value)) = all.get_mut(&output.name.value) {
                let both = [*value, of_one(problem, output)];
                *value = solution.units.output(output.quantity, both);
            }
        }
        return Ok(all);
    }
    let Solution { scalar, ran, u, flux, bound, .. } = solution;
    let bound = bound.map(|bound| bound.total);
    let reading = Reading { scalar: ran.scalar_of_u(*scalar), u, flux, bound };
    let values = declared(problem, reading)?;
    let names = problem.scene.outputs.iter().map(|output| output.name.value.clone());
    Ok(names.zip(values).collect())
}

/// The values of the declared outputs, in the order of the scene.
///
/// # Errors
/// A probe outside the mesh.
pub fn declared(problem: &Problem, reading: Reading) -> Result<Vec<Option<f64>>> {
    let evaluated = problem.scene.outputs.iter().map(|output| {
        let value = evaluate(problem, reading, &Functional::of(problem, output)?);
        Ok(value.filter(|value| value.is_finite()))
    });
    evaluated.collect()
}

fn evaluate(problem: &Problem, reading: Reading, functional: &Functional) -> Option<f64> {
    let free = problem.topology.counts.free;
    match functional {
        Functional::Flux(edges) => {
            Some(edges.iter().fold(0.0, |sum, &edge| sum + reading.flux(problem, edge)))
        }
        Functional::Force(edges) => Some(edges.iter().fold(0.0, |sum, &edge| {
            sum + problem.loads.flux_range(edge - free).multiplier(reading.flux(problem, edge))
        })),
        Functional::Probe(cell, point) => {
            Some(CellField::new(problem, *cell, reading.u, reading.flux).sample(point).u)
        }
        Functional::Linear(parts) => {
            Some(parts.iter().fold(0.0, |sum, &(edge, part)| sum + part * reading.u[edge]))
        }
        Functional::Length(lengths) => {
            let touches = |edge: usize| reading.law(problem, edge - free).touches(reading.u[edge]);
            Some(length_where(lengths, touches))
        }
        Functional::Saturated(lengths) => {
            let at_limit =
                |edge: usize| reading.law(problem, edge - free).is_saturated(reading.u[edge]);
            Some(length_where(lengths, at_limit))
        }
        Functional::Bound => reading.bound,
        Functional::Window => None,
    }
}

fn length_where(lengths: &[(usize, f64)], is_counted: impl Fn(usize) -> bool) -> f64 {
    let counted = lengths.iter().filter(|(edge, _)| is_counted(*edge));
    counted.fold(0.0, |sum, (_, length)| sum + length)
}

impl Reading<'_> {
    /// The law on a contact edge with ψ as the scalar holds it, so that u_E = ψ_E can be asked.
    fn law(&self, problem: &Problem, contact: usize) -> EdgeLaw<f64> {
        let gap = self.scalar.round(problem.loads.gap[contact]);
        EdgeLaw::above(gap).with_span(problem.loads.flux_range(contact).span())
    }

    /// ∫_E τ·n, within the law of contact on a contact edge.
    fn flux(&self, problem: &Problem, edge: usize) -> f64 {
        if problem.kinds[edge] != EdgeKind::Contact {
            return self.flux[edge];
        }
        let at = edge - problem.topology.counts.free;
        let range = problem.loads.flux_range(at);
        self.law(problem, at).flux(self.u[edge], self.flux[edge], range)
    }
}
