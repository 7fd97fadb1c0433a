//! Outputs of a condensed scene as the target has them.

use signorini_contact::outputs::Measure;

use crate::narrow::narrow;
use signorini_condense::Measure as Given;
use signorini_problem::scalar::Scalar;

/// The numbers of a [`Measure`], owned.
#[derive(Debug, Clone)]
pub(super) struct Output<R> {
    /// A length that always counts.
    always: R,
    /// By the inputs, by the openings, by the reactions.
    pub arrays: [Vec<R>; 3],
    of: for<'a> fn(R, [&'a [R]; 3]) -> Measure<'a, R>,
}

impl<R: Scalar> Output<R> {
    pub fn new(measure: &Given) -> Self {
        match measure {
            Given::Linear { of_inputs, of_contact } => {
                Self::of(0.0, [of_inputs, of_contact, &[]], |_, [of_inputs, of_contact, _]| {
                    Measure::Linear { of_inputs, of_contact }
                })
            }
            Given::Flux { of_inputs, of_contact, of_reaction } => Self::of(
                0.0,
                [of_inputs, of_contact, of_reaction],
                |_, [of_inputs, of_contact, of_reaction]| Measure::Flux {
                    of_inputs,
                    of_contact,
                    of_reaction,
                },
            ),
            Given::Length { always, of_contact } => {
                Self::of(*always, [&[], of_contact, &[]], |always, [_, of_contact, _]| {
                    Measure::Length { always, of_contact }
                })
            }
            Given::Saturated { always, of_contact } => {
                Self::of(*always, [&[], of_contact, &[]], |always, [_, of_contact, _]| {
                    Measure::Saturated { always, of_contact }
                })
            }
            Given::Bound => Self::of(0.0, [&[]; 3], |_, _| Measure::Bound),
        }
    }

    fn of(
        always: f64,
        arrays: [&[f64]; 3],
        of: for<'a> fn(R, [&'a [R]; 3]) -> Measure<'a, R>,
    ) -> Self {
        Self { always: R::narrow(always), arrays: arrays.map(narrow), of }
    }

    pub fn measure(&self) -> Measure<'_, R> {
        (self.of)(self.always, self.arrays.each_ref().map(Vec::as_slice))
    }
}
