//! Inputs of either end of a contact edge's flux: lo = lo₀ + Σ p_j π_j and hi = hi₀ + Σ p_j ϖ_j.
//!
//! Where inputs change them the base of every range is its lower end, if that is finite, and the span ∫(hi − lo) is linear in
//! the inputs. Inputs that bring it below 0 by more than rounding are refused ([`Room`]); what is left below 0 is 0, and the base goes
//! half of the way: both ends are their mean.

use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error};
use signorini_kernel::flux_range::Room;

/// Refuses inputs that leave a contact flux no range, and takes 0 for what rounding brings below it. `first`
/// holds the spans without inputs. Returns by how much ends were moved at most.
///
/// # Errors
/// [`Error::EmptyRange`] with an input, [`Error::NotFinite`] where a span overflows.
pub(super) fn check<R: Real>(
    (fluxes, spans): (&mut [R], &mut [R]),
    first: &[R],
    rooms: &[Room<R>],
    inputs: &[R],
) -> Result<R, Error> {
    let mut moved = R::ZERO;
    for (at, (span, &first)) in spans.iter_mut().zip(first).enumerate() {
        if *span >= R::ZERO && span.finite() || !first.finite() {
            continue;
        }
        if !span.finite() {
            return Err(Error::NotFinite { of: Array::ContactSpans, at });
        }
        let half = R::HALF * *span;
        if let Some(base) = fluxes.get_mut(at) {
            *base += half;
        }
        (*span, moved) = (R::ZERO, moved.or_larger(-half));
    }
    rooms.iter().try_for_each(|room| room.check(inputs))?;
    Ok(moved)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::full::data::Base;
    use crate::full::pattern::{Contribution, DataMemory, Pattern};
    use signorini_kernel::flux_range::Spans;

    const SUPPLY: [Contribution<f64, u16>; 2] =
        [Contribution { at: 0, weight: 3.0 }, Contribution { at: 1, weight: 0.1 }];
    /// A unit of the first input raises both limits, one of the second lo of the second edge.
    const PATTERNS: [Pattern<f64, u16>; 2] = [
        Pattern::ContactRange { fluxes: &[], spans: &SUPPLY },
        Pattern::ContactRange {
            fluxes: &[Contribution { at: 1, weight: 0.3 }],
            spans: &[Contribution { at: 1, weight: -0.3 }],
        },
    ];
    const FIRST: [f64; 4] = [1.0, 0.0, f64::INFINITY, f64::NEG_INFINITY];

    const ROOMS: [Room<f64>; 2] =
        [Room { terms: &[1.0, 3.0, 0.0], size: 1.0 }, Room { terms: &[0.0, 0.1, -0.3], size: 0.2 }];

    /// Bases and spans for these inputs, and by how much ends were moved: lo = 0 and hi = 1 at first on the first edge, lo = hi = 0.1
    /// on the second.
    fn at(inputs: [f64; 2]) -> Result<([f64; 4], [f64; 4], f64), Error> {
        let bases = [0.0, 0.1, 2.0, 2.0];
        let spans = Spans::baked(&FIRST, 0.0);
        let base = Base { spans, contact_flux: &bases, rooms: &ROOMS, ..Base::default() };
        let (mut contact_flux, mut spans) = ([7.0; 4], [7.0; 4]);
        let mut data = DataMemory {
            contact_flux: &mut contact_flux,
            spans: &mut spans,
            ..DataMemory::default()
        };
        let moved = data.evaluate(&base, &PATTERNS, &inputs)?;
        Ok((contact_flux, spans, moved))
    }

    #[test]
    fn ends_are_linear_in_the_inputs() {
        let [up, down] = [f64::INFINITY, f64::NEG_INFINITY];
        assert_eq!(at([0.0, 0.0]), Ok(([0.0, 0.1, 2.0, 2.0], FIRST, 0.0)));
        assert_eq!(at([2.0, -10.0]), Ok(([0.0, -2.9, 2.0, 2.0], [7.0, 3.2, up, down], 0.0)));
    }

    /// hi − lo = 0.1 p − 0.3 q has terms of 0.2 + 0.3 + 0.3 at p = 3, 2⁻¹⁹ of which are rounding.
    #[test]
    fn ends_that_cross_by_rounding_are_their_mean() -> Result<(), Error> {
        let slack = 0.8 / f64::from(1 << 19);
        for part in [0.5, 0.99] {
            let (fluxes, spans, moved) = at([3.0, 1.0 + part * slack / 0.3])?;
            let (lo, hi) = (0.1 + 0.3 + part * slack, 0.1 + 0.3);
            assert!((fluxes[1] - 0.5 * (lo + hi)).abs() < 1e-15 && spans[1] == 0.0, "{fluxes:?}");
            assert!((moved - 0.5 * part * slack).abs() < 1e-15, "{moved}");
        }
        for part in [1.01, 2.0] {
            let refused = Err(Error::EmptyRange { input: 1 });
            assert_eq!(at([3.0, 1.0 + part * slack / 0.3]), refused, "{part}");
        }
        Ok(())
    }

    #[test]
    fn a_limit_below_the_least_flux_is_refused() {
        assert_eq!(at([-0.4, -1.0]), Err(Error::EmptyRange { input: 0 }));
        assert_eq!(at([0.0, 0.1]), Err(Error::EmptyRange { input: 1 }));
        let beyond = Err(Error::NotFinite { of: Array::ContactSpans, at: 0 });
        assert_eq!(at([1e308, 0.0]), beyond);
        assert_eq!(at([-1e308, -1e307]), beyond);
    }
}
