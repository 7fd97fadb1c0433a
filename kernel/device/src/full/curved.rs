//! Edges on which inputs bend ψ or u_D: w = Σ p_j w_j, p₀ = 1 for the base.
//!
//! Mean and coupling of a [`Curved`] record are linear in p, its peak in |p|. Its energy is a quadratic form, whose
//! coefficients stand here for every pair of inputs that bend this edge or an earlier one of its cell.

use signorini_bound::certificate::Curved;
use signorini_kernel::Real;
use signorini_kernel::index::{Index, read};

/// What one input, or the base, adds to a record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvedPart<R> {
    /// 0 for the base, else 1 more than the number of the input.
    pub input: u16,
    /// To the mean.
    pub mean: R,
    /// To the peak, with the magnitude of the input.
    pub peak: R,
    /// To the coupling.
    pub coupling: [R; 8],
}

/// A term of the energy: weight · p_i p_j.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Product<R> {
    /// i and j, counted as in [`CurvedPart`].
    pub inputs: [u16; 2],
    /// The coefficient.
    pub weight: R,
}

/// A curved edge as a function of the inputs (borrowed).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvedSum<'a, R, I> {
    /// The edge.
    pub edge: I,
    /// The linear part.
    pub parts: &'a [CurvedPart<R>],
    /// The energy.
    pub energy: &'a [Product<R>],
}

impl<R: Real, I: Index> CurvedSum<'_, R, I> {
    /// The record for these inputs. The energy is rounded up: it may be a small difference of large terms.
    pub(super) fn at(&self, inputs: &[R]) -> Curved<R, I> {
        let value = |input: u16| match usize::from(input).checked_sub(1) {
            None => R::ONE,
            Some(at) => read(inputs, at),
        };
        let none = [R::ZERO; 8];
        let (edge, zero) = (self.edge, R::ZERO);
        let mut record = Curved { edge, mean: zero, peak: zero, energy: zero, coupling: none };
        for part in self.parts {
            let p = value(part.input);
            record.mean += p * part.mean;
            record.peak += p.magnitude() * part.peak;
            let sums = record.coupling.iter_mut().zip(part.coupling);
            sums.for_each(|(sum, coupling)| *sum += p * coupling);
        }
        // Rounded up, as the energy.
        record.peak += R::from_count(8) * R::EPSILON * record.peak;
        let mut size = R::ZERO;
        for Product { inputs: [i, j], weight } in self.energy {
            let term = *weight * (value(*i) * value(*j));
            record.energy += term;
            size += term.magnitude();
        }
        record.energy += R::from_count(8) * R::EPSILON * size;
        record
    }
}
