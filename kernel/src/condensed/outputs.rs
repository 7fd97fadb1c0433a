//! What a controller reads off a condensed model.

use crate::certificate::Certificate;
use crate::error::{Array, Error, same_length};
use crate::real::Real;

/// One output as a function of the inputs p, whose first is the constant 1, and of the openings x.
#[derive(Debug, Clone, Copy)]
pub enum Measure<'a, R> {
    /// Σ Y_p p + Σ Y_x x: a flux, a force, a value at a point.
    Linear {
        /// Y_p, one entry an input.
        of_inputs: &'a [R],
        /// Y_x, one entry a contact edge.
        of_contact: &'a [R],
    },
    /// The length of the edges that touch, x = 0.
    Length {
        /// |E|, or 0 of an edge that does not count.
        of_contact: &'a [R],
    },
    /// How wrong the answer can be: the certificate's total, ∞ where there is none.
    Bound,
}

impl<R: Real> Measure<'_, R> {
    /// Its value.
    ///
    /// # Errors
    /// Arrays of the wrong length.
    pub fn value(
        &self,
        inputs: &[R],
        x: &[R],
        certificate: Option<&Certificate<R>>,
    ) -> Result<R, Error> {
        match *self {
            Self::Linear { of_inputs, of_contact } => {
                same_length(Array::Load, of_inputs.len(), inputs.len())?;
                same_length(Array::Contact, of_contact.len(), x.len())?;
                Ok(dot(of_inputs, inputs) + dot(of_contact, x))
            }
            Self::Length { of_contact } => {
                same_length(Array::Contact, of_contact.len(), x.len())?;
                let touching = of_contact.iter().zip(x).filter(|(_, x)| **x == R::ZERO);
                Ok(touching.fold(R::ZERO, |sum, (&length, _)| sum + length))
            }
            Self::Bound => {
                Ok(certificate.map_or(R::ONE / R::ZERO, |certificate| certificate.total))
            }
        }
    }
}

pub(super) fn dot<R: Real>(a: &[R], b: &[R]) -> R {
    a.iter().zip(b).fold(R::ZERO, |sum, (&a, &b)| sum + a * b)
}
