//! What a step in time hands on to the next, as the target has it.

use signorini_contact::Condensed;
use signorini_contact::steps::Stepped;

use super::evolution::{Evolving, ROUNDINGS};
use crate::narrow::narrow;
use signorini_condense::SteppedModel;
use signorini_problem::scalar::Scalar;

/// States of a condensed scene in the scalar `R`: the arrays of [`Stepped`].
#[derive(Debug, Clone)]
pub struct Steps<R> {
    /// How many states the full model has.
    pub modes: usize,
    pub(super) fading: Vec<R>,
    pub(super) of_inputs: Vec<R>,
    pub(super) begin: Vec<R>,
    pub(super) reach: [R; 2],
    pub(super) evolution: Option<Evolving<R>>,
}

/// The start, and for each of its terms the size of the numbers that it is rounded with. At a contact vertex s − ψ = l + r + d has
/// three of them, each rounded by itself. It is 0 where it is so but for rounding, and stays on its side elsewhere: the last digit of
/// a sum that touches would stand on a side that does not exist, where the first step has no bound over time.
fn rounded_start<R: Scalar>(of: &SteppedModel) -> (Vec<R>, Vec<f64>) {
    let mut begin: Vec<R> = narrow(of.start());
    let mut sizes: Vec<f64> = of.start().iter().map(|term| term.abs()).collect();
    let x = of.inputs - 1..of.inputs - 1 + of.model.contact;
    let first = x.end + of.fading.len();
    // What moves s is what a step makes of a change, and all of it that the states take before they fade.
    for (k, fading) in of.fading.iter().enumerate() {
        let taken = |row: &[f64], from: usize| -> f64 {
            row.iter().zip(&of.start()[from..]).map(|(c, term)| (c * term).abs()).sum()
        };
        let taken = taken(&of.of_inputs[k], 0) + taken(&of.of_contact()[k], x.start);
        sizes[x.end + k] = (sizes[x.end + k] + taken) / (1.0 - fading).max(f64::EPSILON);
    }
    let vertices = of.model.certificate.iter().flat_map(|form| &form.vertices);
    for (at, of_vertex) in (first..begin.len()).zip(vertices) {
        let term = |k: usize| of_vertex.weights[k] * of.start()[x.start + of_vertex.edges[k]];
        let narrowed =
            |k: usize| R::narrow(of_vertex.weights[k]) * begin[x.start + of_vertex.edges[k]];
        let ([left, right], d) = ([0, 1].map(term), of.start()[at]);
        let size = left.abs() + right.abs() + d.abs();
        let (sum, opening) = (narrowed(0) + narrowed(1), left + right + d);
        let is_zero = opening.abs() <= ROUNDINGS * R::EPSILON.wide() * size;
        if is_zero || opening * (sum + begin[at]).wide() < 0.0 {
            begin[at] = R::ZERO - sum;
        }
        // What is moved to 0, beside what is rounded.
        sizes[at] = 2.0 * size;
    }
    (begin, sizes)
}

impl<R: Scalar> Steps<R> {
    /// Narrows what `of` hands on.
    pub fn new(of: &SteppedModel) -> Self {
        let largest = |rows: &[Vec<f64>]| {
            let sums = rows.iter().map(|row| row.iter().map(|entry| entry.abs()).sum());
            R::narrow(sums.fold(0.0, f64::max))
        };
        let (begin, sizes) = rounded_start(of);
        let evolution = of.evolution.as_ref().map(|forms| Evolving::new(forms, of, &sizes));
        let carried = evolution.iter().flat_map(|of| of.begin);
        Self {
            modes: of.modes,
            fading: narrow(&of.fading),
            of_inputs: of.of_inputs.iter().flat_map(|row| narrow(row)).collect(),
            begin: begin.into_iter().chain(carried).collect(),
            reach: [largest(of.of_contact()), largest(&of.of_inputs)],
            evolution,
        }
    }

    /// How many states there are.
    pub fn count(&self) -> usize {
        self.fading.len()
    }

    /// Columns of the forms of what a step changes; 0 without a bound of the evolution.
    pub(super) fn changes(&self) -> usize {
        self.evolution.as_ref().map_or(0, |of| of.motion.norms.len())
    }

    /// Leaves the bound of the evolution out, with what it carries.
    pub(super) fn forget_evolution(&mut self) {
        if let Some(of) = self.evolution.take() {
            self.begin.truncate(self.begin.len() - of.begin.len());
        }
    }

    /// All arrays.
    pub(super) fn numbers(&self) -> impl Iterator<Item = &[R]> {
        let forms = self.evolution.iter().flat_map(|of| [&of.residual, &of.motion]);
        let own: [&[R]; 4] = [&self.fading, &self.of_inputs, &self.begin, &self.reach];
        own.into_iter().chain(forms.map(|form| &form.columns[..]))
    }

    /// How the kernel has them, with their model.
    pub fn view<'a>(&'a self, model: &Condensed<'a, R>) -> Stepped<'a, R> {
        let Self { fading, of_inputs, begin, reach, evolution, .. } = self;
        let evolution = evolution.as_ref().map(Evolving::view);
        Stepped { model: *model, fading, of_inputs, begin, reach: *reach, evolution }
    }
}
