//! Inputs of either end of a contact edge's flux: lo = lo₀ + Σ p_j π_j and hi = hi₀ + Σ p_j ϖ_j.
//!
//! Where inputs change them the base of every range is its lower end, if that is finite, and the span ∫(hi − lo) is linear in
//! the inputs. Below 0 it leaves no flux. What rounding may leave there is 0: two ends that are equal for these inputs.

use super::pattern::Pattern;
use signorini_kernel::error::{Array, Error};
use signorini_kernel::flux_range::settled;
use signorini_kernel::{Index, Real};

/// Refuses inputs that leave a contact edge no flux, and takes 0 for what rounding brings below it ([`settled`]). `first`
/// holds the spans without inputs.
///
/// # Errors
/// [`Error::EmptyRange`] with the first such edge, [`Error::NotFinite`] where a span overflows.
pub(super) fn check<R: Real, I: Index>(
    spans: &mut [R],
    first: &[R],
    patterns: &[Pattern<R, I>],
    inputs: &[R],
) -> Result<(), Error> {
    for (at, (span, &first)) in spans.iter_mut().zip(first).enumerate() {
        if *span >= R::ZERO && span.finite() || !first.finite() {
            continue;
        }
        if !span.finite() {
            return Err(Error::NotFinite { of: Array::ContactSpans, at });
        }
        let moved = patterns.iter().zip(inputs);
        let size = moved.fold(first.magnitude(), |sum, (pattern, &p)| {
            sum + p.magnitude() * pattern.share_of(at)
        });
        let settled = settled(*span, size, inputs.len() + 1);
        *span = settled.ok_or(Error::EmptyRange { contact: at })?;
    }
    Ok(())
}

impl<R: Real, I: Index> Pattern<'_, R, I> {
    /// How much a unit of the input moves the span of this contact edge's flux.
    fn share_of(&self, contact: usize) -> R {
        let Self::ContactRange { spans, .. } = *self else { return R::ZERO };
        let here = spans.iter().filter(|share| share.at.at() == contact);
        here.fold(R::ZERO, |sum, share| sum + share.weight.magnitude())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::full::data::Base;
    use crate::full::pattern::{Contribution, DataMemory};
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

    /// Bases and spans for these inputs: lo = 0 and hi = 1 at first on the first edge, lo = hi = 0.1 on the second.
    fn at(inputs: [f64; 2]) -> Result<([f64; 4], [f64; 4]), Error> {
        let bases = [0.0, 0.1, 2.0, 2.0];
        let spans = Spans::baked(&FIRST, 0.0);
        let base = Base { spans, contact_flux: &bases, ..Base::default() };
        let (mut contact_flux, mut spans) = ([7.0; 4], [7.0; 4]);
        let mut data = DataMemory {
            contact_flux: &mut contact_flux,
            spans: &mut spans,
            ..DataMemory::default()
        };
        data.evaluate(&base, &PATTERNS, &inputs)?;
        Ok((contact_flux, spans))
    }

    #[test]
    fn ends_are_linear_in_the_inputs() {
        let [up, down] = [f64::INFINITY, f64::NEG_INFINITY];
        assert_eq!(at([0.0, 0.0]), Ok(([0.0, 0.1, 2.0, 2.0], FIRST)));
        assert_eq!(at([2.0, -10.0]), Ok(([0.0, -2.9, 2.0, 2.0], [7.0, 3.2, up, down])));
    }

    #[test]
    fn what_rounding_leaves_of_equal_ends_is_nothing() {
        // 3 · 0.1 − 0.3 is 5.6e−17, and with the other sign less than nothing.
        let spans = |inputs| at(inputs).map(|(_, spans)| spans[1]);
        assert_eq!(spans([3.0, 1.0]), Ok(0.1 * 3.0 - 0.3));
        assert_eq!(spans([3.0, 1.0 + 4.0 * f64::EPSILON]), Ok(0.0));
        assert_eq!(spans([3.0, 1.0 + 100.0 * f64::EPSILON]), Err(Error::EmptyRange { contact: 1 }));
    }

    /// Up to 6 ε of |hi₀ − lo₀| and all that the input moves of the span: bases are no terms of it.
    #[test]
    fn rounding_is_counted_by_all_terms() {
        let of = |first: f64, p: f64, span: f64| {
            let shares = [(0, 9.0), (1, -2.0), (1, 0.5), (1, 0.25)];
            let shares = shares.map(|(at, weight)| Contribution { at, weight });
            let (fluxes, of_span) = shares.split_at(2);
            let pattern: Pattern<f64, u16> = Pattern::ContactRange { fluxes, spans: of_span };
            let mut spans = [1.0, span];
            check(&mut spans, &[7.0, first], &[pattern], &[p]).map(|()| spans)
        };
        let unit = 6.0 * f64::EPSILON;
        for (first, p, terms) in [(0.5, 0.0, 0.5), (-2.0, 0.0, 2.0), (0.0, -4.0, 3.0)] {
            assert_eq!(of(first, p, -0.999 * unit * terms), Ok([1.0, 0.0]), "{terms}");
            let beyond = of(first, p, -1.001 * unit * terms);
            assert_eq!(beyond, Err(Error::EmptyRange { contact: 1 }), "{terms}");
        }
    }

    #[test]
    fn a_limit_below_the_least_flux_is_refused() {
        assert_eq!(at([-0.4, -1.0]), Err(Error::EmptyRange { contact: 0 }));
        assert_eq!(at([0.0, 0.1]), Err(Error::EmptyRange { contact: 1 }));
        let beyond = Err(Error::NotFinite { of: Array::ContactSpans, at: 0 });
        assert_eq!(at([1e308, 0.0]), beyond);
        assert_eq!(at([-1e308, -1e307]), beyond);
    }
}
