//! Outputs as functions of (p, x, r): the full model's functionals applied to every column, and on contact
//! edges the reactions.

use super::elimination::Field;
use super::{Columns, Measure, Pieces};
use signorini_problem::EdgeKind;
use signorini_problem::field::CellField;
use signorini_problem::functional::{Functional, functionals};
use signorini_scene::error::Result;

impl Columns<'_> {
    /// Every declared output; without any, contact force and length.
    ///
    /// # Errors
    /// A probe outside the mesh.
    pub(super) fn measures(&self) -> Result<Vec<Measure>> {
        let problem = self.pieces.problem;
        let measure = |functional: &Functional| match functional {
            Functional::Flux(edges) => self.flux(edges),
            Functional::Force(edges) => self.force(edges),
            Functional::Probe(cell, point) => self.linear(|Field { u, flux }| {
                CellField::new(problem, *cell, u, flux).sample(point).u
            }),
            Functional::Linear(parts) => self.linear(|Field { u, .. }| {
                parts.iter().fold(0.0, |sum, &(edge, part)| sum + part * u[edge])
            }),
            Functional::Length(lengths) => {
                let always = lengths.iter().filter(|(edge, _)| self.is_touching(*edge));
                let always = always.map(|(_, length)| length).sum();
                Measure::Length { always, of_contact: self.by_unknown(lengths) }
            }
            // Nothing is at its limit where there is none.
            Functional::Saturated(_) if self.pieces.spans.is_empty() => self.linear(|_| 0.0),
            Functional::Saturated(lengths) => {
                Measure::Saturated { always: 0.0, of_contact: self.by_unknown(lengths) }
            }
            // The controller puts the window in its place.
            Functional::Bound | Functional::Window => Measure::Bound,
        };
        Ok(functionals(problem)?.iter().map(measure).collect())
    }

    /// The flux (15) through edges that are not in contact, q and the reactions through those that are.
    fn flux(&self, edges: &[usize]) -> Measure {
        let Pieces { problem, patterns, .. } = self.pieces;
        let is_contact =
            |edge: &usize| problem.kinds[*edge] == EdgeKind::Contact && !self.is_touching(*edge);
        let (contact, rest): (Vec<usize>, Vec<usize>) = edges.iter().partition(|e| is_contact(e));
        let recovered = |field: &Field| rest.iter().fold(0.0, |sum, &edge| sum + field.flux[edge]);
        let (mut of_inputs, of_contact) = self.factors(recovered);
        if contact.is_empty() {
            return Measure::Linear { of_inputs, of_contact };
        }
        let of_contact = if rest.is_empty() { Vec::new() } else { of_contact };
        let free = problem.topology.counts.free;
        for (sum, pattern) in of_inputs.iter_mut().zip(patterns) {
            *sum +=
                contact.iter().map(|edge| pattern.loads().contact_flux[edge - free]).sum::<f64>();
        }
        let brings = of_inputs.iter().any(|&factor| factor != 0.0);
        let of_inputs = if brings { of_inputs } else { Vec::new() };
        let ones: Vec<_> = contact.into_iter().map(|edge| (edge, 1.0)).collect();
        Measure::Flux { of_inputs, of_contact, of_reaction: self.reactions(&ones) }
    }

    /// ∫(τ·n − lo) over contact edges, and ∫(hi − τ·n) where lo is infinite. Where the base is hi, the way from lo to it is
    /// constant.
    fn force(&self, edges: &[usize]) -> Measure {
        let Pieces { problem, patterns, spans, .. } = self.pieces;
        let free = problem.topology.counts.free;
        let span =
            |edge: usize| spans.first().map_or(f64::INFINITY, |constant| constant[edge - free]);
        let from_above: f64 = edges
            .iter()
            .map(|&edge| span(edge))
            .filter(|span| *span < 0.0 && span.is_finite())
            .sum();
        let mut of_inputs = Vec::new();
        if from_above < 0.0 {
            of_inputs = vec![0.0; patterns.len()];
            of_inputs[0] = -from_above;
        }
        let sign = |edge: usize| if span(edge) == f64::NEG_INFINITY { -1.0 } else { 1.0 };
        let signs: Vec<_> = edges.iter().map(|&edge| (edge, sign(edge))).collect();
        let of_reaction = self.reactions(&signs);
        let touching: Vec<usize> =
            edges.iter().copied().filter(|&edge| self.is_touching(edge)).collect();
        if touching.is_empty() {
            return Measure::Flux { of_inputs, of_contact: Vec::new(), of_reaction };
        }
        // Settled edges have no limits.
        let pressing = |field: &Field| touching.iter().map(|&edge| field.flux[edge]).sum::<f64>();
        let (mut of_inputs, of_contact) = self.factors(pressing);
        for (factor, pattern) in of_inputs.iter_mut().zip(patterns) {
            let q = |edge: &usize| pattern.loads().contact_flux[edge - free];
            *factor -= touching.iter().map(q).sum::<f64>();
        }
        Measure::Flux { of_inputs, of_contact, of_reaction }
    }

    /// Σ Y_p p + Σ Y_x x
    fn linear(&self, value: impl Fn(&Field) -> f64) -> Measure {
        let (of_inputs, of_contact) = self.factors(value);
        Measure::Linear { of_inputs, of_contact }
    }

    /// Y_p and Y_x
    fn factors(&self, value: impl Fn(&Field) -> f64) -> (Vec<f64>, Vec<f64>) {
        let mut of_inputs: Vec<f64> = self.fields.iter().map(value).collect();
        let of_contact = of_inputs.split_off(self.pieces.patterns.len());
        (of_inputs, of_contact)
    }

    /// Whether an edge touches whatever happens.
    fn is_touching(&self, edge: usize) -> bool {
        let Pieces { problem, settled, .. } = self.pieces;
        settled.touching.iter().any(|at| problem.topology.counts.free + at == edge)
    }

    /// ∫_E (τ·n − q) for r̂ = 1 on each of these contact edges, times the number beside it.
    fn reactions(&self, edges: &[(usize, f64)]) -> Vec<f64> {
        let counts = self.by_unknown(edges).into_iter();
        counts.zip(self.openings).map(|(counts, opening)| counts / opening).collect()
    }

    /// Values of contact edges, in the order of the unknowns.
    fn by_unknown(&self, numbers: &[(usize, f64)]) -> Vec<f64> {
        let counts = self.pieces.problem.topology.counts;
        let mut by_edge = vec![0.0; counts.contact];
        numbers.iter().for_each(|&(edge, number)| by_edge[edge - counts.free] = number);
        self.pieces.edges.iter().map(|&edge| by_edge[edge]).collect()
    }
}
