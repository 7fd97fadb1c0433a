//! Transfer coefficients that inputs change: h = h₀ + Σ p_c π_c stands in the matrix, and in the load beside u_ext.
//!
//! ```text
//!   ∫h       = ∫h₀ + Σ_c p_c ∫π_c
//!   ∫h u_ext = ∫h₀ (u₀ + Σ_a p_a w_a) + Σ_c p_c (∫π_c u₀ + Σ_a p_a ∫π_c w_a)
//! ```
//! with w_a what input a adds to u_ext. The integrals of products stand here: patterns of any shape are as exact as with
//! one number for h. A tick lays its rows out anew in any case, and the new diagonal comes with them.

use super::pattern::{Contribution, DataMemory, Pattern, Points, each};
use crate::index::{Index, read};
use crate::real::Real;

/// What one unit of an input adds to h and, with it, to ∫h u_ext.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TransferPattern<'a, R, I> {
    /// ∫π, by number of the transfer law.
    pub integrals: &'a [Contribution<R, I>],
    /// ∫π u_ext, in parts.
    pub ambient: &'a [AmbientShare<'a, R, I>],
    /// |E|π at points, where h and u_ext are not constant along every edge.
    pub points: &'a [Points<R, I>],
}

/// The part of ∫π u_ext that the base, or one unit of an input, makes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AmbientShare<'a, R, I> {
    /// 0 for the base, else 1 more than the number of the input.
    pub input: u16,
    /// ∫π u₀ or ∫π w, by number of the transfer law.
    pub integrals: &'a [Contribution<R, I>],
}

impl<R: Real, I: Index> DataMemory<'_, R, I> {
    /// Adds what coefficients change, once u_ext has its own inputs.
    pub(super) fn transfer(&mut self, patterns: &[Pattern<R, I>], inputs: &[R]) {
        for (pattern, &p) in patterns.iter().zip(inputs) {
            if let Pattern::Coefficient(of) = pattern {
                of.add(p, inputs, self);
            }
        }
        self.insulate();
    }

    /// At the end of a range where nothing passes rounding may leave less than nothing, or a load that has no coefficient.
    fn insulate(&mut self) {
        for law in self.robin.iter_mut().filter(|law| law.coefficient <= R::ZERO) {
            (law.coefficient, law.ambient) = (R::ZERO, R::ZERO);
        }
        let points = self.transfer.as_flattened_mut().iter_mut();
        points.filter(|[h, _]| *h < R::ZERO).for_each(|[h, _]| *h = R::ZERO);
    }
}

impl<R: Real, I: Index> TransferPattern<'_, R, I> {
    fn add(&self, p: R, inputs: &[R], data: &mut DataMemory<R, I>) {
        each(self.integrals, |at, weight| {
            if let Some(law) = data.robin.get_mut(at) {
                law.coefficient += p * weight;
            }
        });
        for share in self.ambient {
            let factor = match usize::from(share.input).checked_sub(1) {
                None => p,
                Some(at) => p * read(inputs, at),
            };
            each(share.integrals, |at, weight| {
                if let Some(law) = data.robin.get_mut(at) {
                    law.ambient += factor * weight;
                }
            });
        }
        for Points { at, values } in self.points {
            let Some(edge) = data.transfer.get_mut(at.at()) else { break };
            edge.iter_mut().zip(values).for_each(|(point, &add)| point[0] += p * add);
        }
    }
}
