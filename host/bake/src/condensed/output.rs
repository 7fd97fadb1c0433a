//! Outputs of a condensed scene as the target has them.

use signorini_contact::outputs::Measure;

use crate::narrow::narrow;
use signorini_problem::scalar::Scalar;

/// An output with its arrays.
#[derive(Debug, Clone)]
pub(super) enum Output<R> {
    Linear { of_inputs: Vec<R>, of_contact: Vec<R> },
    Flux { of_inputs: Vec<R>, of_contact: Vec<R>, of_reaction: Vec<R> },
    Length { always: R, of_contact: Vec<R> },
    Saturated { always: R, of_contact: Vec<R> },
    Bound,
}

impl<R: Scalar> Output<R> {
    pub fn new(measure: &signorini_condense::Measure) -> Self {
        match measure {
            signorini_condense::Measure::Linear { of_inputs, of_contact } => {
                Self::Linear { of_inputs: narrow(of_inputs), of_contact: narrow(of_contact) }
            }
            signorini_condense::Measure::Flux { of_inputs, of_contact, of_reaction } => {
                Self::Flux {
                    of_inputs: narrow(of_inputs),
                    of_contact: narrow(of_contact),
                    of_reaction: narrow(of_reaction),
                }
            }
            signorini_condense::Measure::Length { always, of_contact } => {
                Self::Length { always: R::narrow(*always), of_contact: narrow(of_contact) }
            }
            signorini_condense::Measure::Saturated { always, of_contact } => {
                Self::Saturated { always: R::narrow(*always), of_contact: narrow(of_contact) }
            }
            signorini_condense::Measure::Bound => Self::Bound,
        }
    }

    /// Its arrays in flash.
    pub fn arrays(&self) -> [&[R]; 3] {
        match self {
            Self::Linear { of_inputs, of_contact } => [of_inputs, of_contact, &[]],
            Self::Flux { of_inputs, of_contact, of_reaction } => {
                [of_inputs, of_contact, of_reaction]
            }
            Self::Length { of_contact, .. } | Self::Saturated { of_contact, .. } => {
                [&[], of_contact, &[]]
            }
            Self::Bound => [&[]; 3],
        }
    }

    pub fn measure(&self) -> Measure<'_, R> {
        match self {
            Self::Linear { of_inputs, of_contact } => Measure::Linear { of_inputs, of_contact },
            Self::Flux { of_inputs, of_contact, of_reaction } => {
                Measure::Flux { of_inputs, of_contact, of_reaction }
            }
            Self::Length { always, of_contact } => Measure::Length { always: *always, of_contact },
            Self::Saturated { always, of_contact } => {
                Measure::Saturated { always: *always, of_contact }
            }
            Self::Bound => Measure::Bound,
        }
    }
}
