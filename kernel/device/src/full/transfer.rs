//! Transfer coefficients that inputs change: h = h₀ + Σ p_c π_c stands in the matrix, and in the load beside u_ext.
//!
//! ```text
//!   ∫h       = ∫h₀ + Σ_c p_c ∫π_c
//!   ∫h u_ext = ∫h₀ (u₀ + Σ_a p_a w_a) + Σ_c p_c (∫π_c u₀ + Σ_a p_a ∫π_c w_a)
//! ```
//! with w_a what input a adds to u_ext. The integrals of products stand here: patterns of any shape are as exact as with
//! one number for h. A tick lays its rows out anew in any case, and the new diagonal comes with them.

use super::pattern::{DataMemory, Pattern, Points, TransferPattern, each};
use signorini_kernel::Real;
use signorini_kernel::index::{Index, read};

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::full::{Along, AmbientShare, Base, Contribution};
    use signorini_kernel::mesh::boundary::Robin;

    /// Two laws: h = 2 and 3 on them, u_ext = 10 and 20. Lengths are 1.
    const LAWS: [Robin<f64, u16>; 2] = [
        Robin { edge: 4, coefficient: 2.0, ambient: 20.0 },
        Robin { edge: 7, coefficient: 3.0, ambient: 60.0 },
    ];
    const POINTS: [[[f64; 2]; 8]; 2] = [[[2.0, 10.0]; 8], [[3.0, 20.0]; 8]];

    /// An input adds 1 to h of the first law and 2 to that of the second, another 5 to u_ext of the second.
    const OF_H: TransferPattern<f64, u16> = TransferPattern {
        integrals: &[Contribution { at: 0, weight: 1.0 }, Contribution { at: 1, weight: 2.0 }],
        ambient: &[
            AmbientShare {
                input: 0,
                integrals: &[
                    Contribution { at: 0, weight: 10.0 },
                    Contribution { at: 1, weight: 40.0 },
                ],
            },
            AmbientShare { input: 2, integrals: &[Contribution { at: 1, weight: 10.0 }] },
        ],
        points: &[Points { at: 0, values: [1.0; 8] }, Points { at: 1, values: [2.0; 8] }],
    };
    const PATTERNS: [Pattern<f64, u16>; 2] = [
        Pattern::Coefficient(&OF_H),
        Pattern::Ambient {
            integrals: &[Contribution { at: 1, weight: 15.0 }],
            points: &[Points { at: 1, values: [5.0; 8] }],
        },
    ];

    /// h and ∫h u_ext of both laws, and h and u_ext at a point of each.
    fn at(inputs: [f64; 2]) -> [[[f64; 2]; 2]; 2] {
        let base = Base { robin: &LAWS, transfer: Along::Seen(&POINTS), ..Base::default() };
        let (mut robin, mut transfer) = (LAWS, POINTS);
        let mut data =
            DataMemory { robin: &mut robin, transfer: &mut transfer, ..DataMemory::default() };
        assert_eq!(data.evaluate(&base, &PATTERNS, &inputs), Ok(0.0));
        assert!(transfer.iter().all(|edge| edge.iter().all(|point| *point == edge[0])));
        let laws = robin.map(|law| [law.coefficient, law.ambient]);
        [laws, transfer.map(|edge| edge[3])]
    }

    #[test]
    fn h_and_u_ext_may_change_together() {
        assert_eq!(at([0.0, 0.0]), [[[2.0, 20.0], [3.0, 60.0]], [[2.0, 10.0], [3.0, 20.0]]]);
        assert_eq!(at([3.0, 0.0]), [[[5.0, 50.0], [9.0, 180.0]], [[5.0, 10.0], [9.0, 20.0]]]);
        // (3 + 2·3)(20 + 5·4)
        assert_eq!(at([3.0, 4.0]), [[[5.0, 50.0], [9.0, 360.0]], [[5.0, 10.0], [9.0, 40.0]]]);
    }

    #[test]
    fn nothing_is_the_least_that_passes() {
        // h = 2 − 2 and 3 − 4: the second lies outside of any range that the host lets pass by more than rounding.
        assert_eq!(at([-2.0, 1.0]), [[[0.0, 0.0], [0.0, 0.0]], [[0.0, 10.0], [0.0, 25.0]]]);
    }
}
