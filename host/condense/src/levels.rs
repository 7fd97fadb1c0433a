//! Values that s starts from at contact vertices: ψ, or where the gaps of two boundaries differ there a value that meets both.
//!
//! ```text
//!   u ≥ ψ_a, u ≥ ψ_b      the larger one        u ≤ ψ_a, u ≤ ψ_b      the smaller one        u ≥ ψ_a, u ≤ ψ_b      their mean
//! ```
//! s is fixed beforehand, linear in the inputs. Which gap is the larger one is read off the ranges: of ψ_a − ψ_b in \[l, h\], where
//! l < 0 < h, the chord of max(0, ·) is above it,
//! ```text
//!   max(ψ_a, ψ_b) ≤ ψ_b + (ψ_a − ψ_b − l) h/(h − l).
//! ```
//! An edge whose flux has two finite ends asks for nothing: alone it has its own ψ.

use signorini_problem::Problem;
use signorini_scene::scene::Input;

/// Gaps at a vertex that differ with an input without a range.
pub(super) struct Unbounded;

/// The ranges of the patterns: the constant 1, the inputs, and what is no input.
pub(super) fn ranges(problem: &Problem, patterns: usize) -> Vec<[f64; 2]> {
    let inputs = problem.scene.inputs.iter().map(Input::interval);
    let mut ranges: Vec<_> = std::iter::once([1.0; 2]).chain(inputs).collect();
    ranges.resize(patterns, [f64::NEG_INFINITY, f64::INFINITY]);
    ranges
}

/// The value at a vertex, of contact edges with what they ask of u ([`Problem::asks`]) and their ψ, pattern by pattern.
pub(super) fn level<'p>(
    gaps: impl Iterator<Item = ([bool; 2], &'p [f64])> + Clone,
    ranges: &[[f64; 2]],
) -> Result<Vec<f64>, Unbounded> {
    let asked = |side: usize, sign: f64| {
        let own = gaps.clone().filter(|(asks, _)| asks[side]);
        let mut own = own.map(|(_, psi)| psi.iter().map(|psi| sign * psi).collect::<Vec<_>>());
        let first = own.next();
        let most = first.map(|first| own.try_fold(first, |most, psi| above(&most, &psi, ranges)));
        let signed = |most: Vec<f64>| most.into_iter().map(|psi| sign * psi).collect::<Vec<_>>();
        most.map(|most| most.map(signed)).transpose()
    };
    Ok(match (asked(0, 1.0)?, asked(1, -1.0)?) {
        (Some(below), Some(above)) => {
            below.iter().zip(&above).map(|(below, above)| 0.5 * (below + above)).collect()
        }
        (Some(level), None) | (None, Some(level)) => level,
        (None, None) => gaps.clone().next().map_or_else(Vec::new, |(_, psi)| psi.to_vec()),
    })
}

/// A sum over the inputs that is never below two others.
fn above(one: &[f64], other: &[f64], ranges: &[[f64; 2]]) -> Result<Vec<f64>, Unbounded> {
    let difference: Vec<f64> = one.iter().zip(other).map(|(one, other)| one - other).collect();
    let [least, most] = extremes(&difference, ranges);
    match () {
        () if least >= 0.0 => Ok(one.to_vec()),
        () if most <= 0.0 => Ok(other.to_vec()),
        () if !(least.is_finite() && most.is_finite()) => Err(Unbounded),
        () => {
            let share = most / (most - least);
            let sum = other.iter().zip(&difference).map(|(other, by)| other + share * by);
            let mut sum: Vec<f64> = sum.collect();
            sum[0] -= share * least;
            Ok(sum)
        }
    }
}

/// The least and the largest value of a sum over the inputs.
fn extremes(factors: &[f64], ranges: &[[f64; 2]]) -> [f64; 2] {
    let used = factors.iter().zip(ranges).filter(|(factor, _)| **factor != 0.0);
    used.fold([0.0; 2], |[least, most], (factor, range)| {
        let [a, b] = range.map(|end| factor * end);
        [least + a.min(b), most + a.max(b)]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const RANGES: [[f64; 2]; 3] = [[1.0, 1.0], [-1.0, 3.0], [f64::NEG_INFINITY, f64::INFINITY]];
    const LOWER: [bool; 2] = [true, false];
    const UPPER: [bool; 2] = [false, true];

    fn of(gaps: &[([bool; 2], [f64; 3])]) -> Option<Vec<f64>> {
        level(gaps.iter().map(|(asks, psi)| (*asks, &psi[..])), &RANGES).ok()
    }

    #[test]
    fn the_larger_gap_is_taken_and_the_smaller_one_for_upper_limits() {
        let (low, high) = ([0.0, 0.0, 5.0], [2.0, 1.0, 5.0]);
        for gaps in [[low, high], [high, low]] {
            assert_eq!(of(&gaps.map(|psi| (LOWER, psi))), Some(high.to_vec()));
            assert_eq!(of(&gaps.map(|psi| (UPPER, psi))), Some(low.to_vec()));
        }
        assert_eq!(of(&[(LOWER, low), (UPPER, high)]), Some(vec![1.0, 0.5, 5.0]));
        assert_eq!(of(&[([false; 2], high), (UPPER, low)]), Some(low.to_vec()));
    }

    #[test]
    fn gaps_that_cross_within_a_range_are_both_below() {
        let (one, other) = ([0.0, 1.0, 5.0], [1.0, 0.0, 5.0]);
        let found = of(&[(LOWER, one), (LOWER, other)]).expect("a range");
        for p in [-1.0, 0.0, 1.0, 2.0, 3.0] {
            let at = |psi: &[f64]| psi[0] + p * psi[1];
            let [most, level] = [at(&one).max(at(&other)), at(&found)];
            assert!((0.0..=1.0).contains(&(level - most)), "{p}: {level} {most}");
        }
        assert_eq!(of(&[(LOWER, [0.0, 0.0, 1.0]), (LOWER, [1.0, 0.0, 0.0])]), None);
    }
}
