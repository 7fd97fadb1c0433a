//! What a step in time hands on to the next, as the target has it.

use signorini_contact::Condensed;
use signorini_contact::steps::Stepped;

use super::evolution::Evolving;
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

impl<R: Scalar> Steps<R> {
    /// Narrows what `of` hands on.
    pub fn new(of: &SteppedModel) -> Self {
        let largest = |rows: &[Vec<f64>]| {
            let sums = rows.iter().map(|row| row.iter().map(|entry| entry.abs()).sum());
            R::narrow(sums.fold(0.0, f64::max))
        };
        let evolution = of.evolution.as_ref().map(|forms| Evolving::new(forms, of));
        let carried = evolution.iter().flat_map(|of| of.begin);
        Self {
            modes: of.modes,
            fading: narrow(&of.fading),
            of_inputs: of.of_inputs.iter().flat_map(|row| narrow(row)).collect(),
            begin: narrow(of.start()).into_iter().chain(carried).collect(),
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
