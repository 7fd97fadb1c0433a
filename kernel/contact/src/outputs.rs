//! Outputs of a condensed model: forces, fluxes, lengths, probes.
//!
//! On a contact edge τ·n − q is its r where it touches and r > 0, and 0 elsewhere, wherever the solver was
//! stopped: forces are never negative. Where its flux has a limit, it is the nearest flux within the range, and the end of its
//! side where it does not touch.

use super::candidate::Candidate;
use signorini_kernel::error::{Array, Error, same_length, same_length_or_empty};
use signorini_kernel::verdict::Certificate;
use signorini_kernel::{Real, features};

/// One output as a function of the inputs p, whose first is the constant 1, of the openings x, and of r = Sx − b: its factors
/// in columns `C`, owned on the host that makes them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Output<C, R> {
    /// Σ Y_p p + Σ Y_x x: a value at a point, a flux where there is no contact.
    Linear {
        /// Y_p, one entry an input.
        of_inputs: C,
        /// Y_x, one entry a contact edge.
        of_contact: C,
    },
    /// Σ Y_p p + Σ Y_x x + Σ Y_r r, the last over the edges with x = 0 and r > 0, or with limits r as above: a force, and a
    /// flux through contact edges.
    Flux {
        /// Y_p, what q and other boundaries bring; empty for none.
        of_inputs: C,
        /// Y_x, what other boundaries bring; empty for none.
        of_contact: C,
        /// Y_r, the flux of a unit of r through an edge that counts, or 0; below 0 for forces that are counted down from a
        /// limit.
        of_reaction: C,
    },
    /// The length of the edges that touch, x = 0.
    Length {
        /// Sum over edges that touch whatever the inputs are, and have no x.
        always: R,
        /// |E|, or 0 of an edge that does not count.
        of_contact: C,
    },
    /// The length of the edges at their upper end, x < 0.
    Saturated {
        /// Sum over edges that are there whatever the inputs are, and have no x.
        always: R,
        /// |E|, or 0 of an edge that does not count.
        of_contact: C,
    },
    /// How wrong the answer can be: the certificate's total, ∞ where there is none.
    Bound,
}

/// An output whose columns are borrowed, as on the target.
pub type Measure<'a, R> = Output<&'a [R], R>;

impl<C, R: Copy> Output<C, R> {
    /// This output with other columns and numbers.
    pub fn map<'o, D, S>(
        &'o self,
        column: impl Fn(&'o C) -> D,
        number: impl Fn(R) -> S,
    ) -> Output<D, S> {
        match self {
            Self::Linear { of_inputs, of_contact } => {
                let [of_inputs, of_contact] = [of_inputs, of_contact].map(column);
                Output::Linear { of_inputs, of_contact }
            }
            Self::Flux { of_inputs, of_contact, of_reaction } => {
                let all = [of_inputs, of_contact, of_reaction].map(column);
                let [of_inputs, of_contact, of_reaction] = all;
                Output::Flux { of_inputs, of_contact, of_reaction }
            }
            Self::Length { always, of_contact } => {
                Output::Length { always: number(*always), of_contact: column(of_contact) }
            }
            Self::Saturated { always, of_contact } => {
                Output::Saturated { always: number(*always), of_contact: column(of_contact) }
            }
            Self::Bound => Output::Bound,
        }
    }

    /// The columns that it has.
    pub fn columns(&self) -> impl Iterator<Item = &C> {
        let all = match self {
            Self::Linear { of_inputs, of_contact } => [Some(of_inputs), Some(of_contact), None],
            Self::Flux { of_inputs, of_contact, of_reaction } => {
                [of_inputs, of_contact, of_reaction].map(Some)
            }
            Self::Length { of_contact, .. } | Self::Saturated { of_contact, .. } => {
                [Some(of_contact), None, None]
            }
            Self::Bound => [None; 3],
        };
        all.into_iter().flatten()
    }

    /// With its columns borrowed.
    pub fn view(&self) -> Measure<'_, R>
    where
        C: AsRef<[R]>,
    {
        self.map(|column| column.as_ref(), |number| number)
    }
}

impl<R: Real> Measure<'_, R> {
    /// Its value.
    ///
    /// # Errors
    /// Arrays of the wrong length.
    // Of a measure that is a constant of the controller's code its own kind is left, and none of the others.
    #[inline(always)]
    pub fn value(
        &self,
        answer: &Candidate<R>,
        certificate: Option<&Certificate<R>>,
    ) -> Result<R, Error> {
        let Candidate { inputs, x, residual, .. } = *answer;
        match *self {
            Self::Linear { of_inputs, of_contact } => {
                same_length(Array::Load, of_inputs.len(), inputs.len())?;
                same_length(Array::Contact, of_contact.len(), x.len())?;
                Ok(dot(of_inputs, inputs) + dot(of_contact, x))
            }
            Self::Flux { of_inputs, of_contact, of_reaction } => {
                same_length_or_empty(Array::Load, of_inputs.len(), inputs.len())?;
                same_length_or_empty(Array::Contact, of_contact.len(), x.len())?;
                same_length(Array::Contact, of_reaction.len(), x.len())?;
                same_length(Array::Contact, residual.len(), x.len())?;
                let elsewhere = dot(of_inputs, inputs) + dot(of_contact, x);
                Ok(elsewhere + pressed(of_reaction, answer))
            }
            Self::Length { always, of_contact } => {
                same_length(Array::Contact, of_contact.len(), x.len())?;
                let touching = of_contact.iter().zip(x).filter(|(_, x)| **x == R::ZERO);
                Ok(touching.fold(always, |sum, (&length, _)| sum + length))
            }
            Self::Saturated { always, .. } if !features::LIMITED => Ok(always),
            Self::Saturated { always, of_contact } => {
                same_length(Array::Contact, of_contact.len(), x.len())?;
                let saturated = of_contact.iter().zip(x).filter(|(_, x)| **x < R::ZERO);
                Ok(saturated.fold(always, |sum, (&length, _)| sum + length))
            }
            Self::Bound => {
                Ok(certificate.map_or(R::ONE / R::ZERO, |certificate| certificate.total))
            }
        }
    }
}

/// Σ weights · r over the edges with x = 0 and r > 0, or within the ranges of r. A number that is none stays one.
fn pressed<R: Real>(weights: &[R], answer: &Candidate<R>) -> R {
    let Candidate { x, residual, ranges, .. } = *answer;
    if ranges.are_limited() {
        let edges = weights.iter().zip(x).zip(residual).enumerate();
        return edges.fold(R::ZERO, |sum, (at, ((&weight, &x), &r))| {
            if weight == R::ZERO { sum } else { sum + weight * ranges.admissible(at, x, r) }
        });
    }
    let edges = weights.iter().zip(x).zip(residual);
    edges.fold(
        R::ZERO,
        |sum, ((&weight, &x), &r)| {
            if x > R::ZERO || r <= R::ZERO { sum } else { sum + weight * r }
        },
    )
}

// Once for all measures: each that is inlined would bring it again.
#[inline(never)]
pub(super) fn dot<R: Real>(a: &[R], b: &[R]) -> R {
    a.iter().zip(b).fold(R::ZERO, |sum, (&a, &b)| sum + a * b)
}
