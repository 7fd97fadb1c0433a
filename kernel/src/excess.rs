//! By how much s lies above ψ along a contact edge, and below: what either side of the law is charged for.

use crate::Real;

/// s − ψ along a contact edge: e_a (1 − t) + e_b t + 4t(1 − t) d, with d = 0 where the ends have different signs.
#[derive(Debug, Clone, Copy)]
pub struct Excess<R> {
    /// e_a and e_b.
    pub ends: [R; 2],
    /// d
    pub bubble: R,
}

impl<R: Real> Excess<R> {
    /// The mean where it is nowhere negative but for rounding: (e_a + e_b)/2 + 2d/3.
    pub fn mean(&self) -> R {
        let [a, b] = self.ends.map(|e| e.or_larger(R::ZERO));
        let mean = R::HALF * (a + b) + R::TWO * R::THIRD * self.bubble;
        mean.or_larger(R::ZERO)
    }

    /// The means of its positive and of its negative part; e_a²/(e_a − e_b)/2 of what crosses 0.
    pub fn sides(&self) -> [R; 2] {
        let ([a, b], zero) = (self.ends, R::ZERO);
        if a < zero && b > zero || a > zero && b < zero {
            let (a, b) = (a.magnitude(), b.magnitude());
            let part = |e: R| R::HALF * e * (e / (a + b));
            let parts = [part(a), part(b)];
            return if self.ends[0] > zero { parts } else { [parts[1], parts[0]] };
        }
        let is_below = a + b < zero || a + b == zero && self.bubble < zero;
        let flipped = Self { ends: [-a, -b], bubble: -self.bubble };
        if is_below { [zero, flipped.mean()] } else { [self.mean(), zero] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sides(ends: [f64; 2], bubble: f64) -> [f64; 2] {
        Excess { ends, bubble }.sides()
    }

    #[test]
    fn an_excess_of_one_sign_is_all_on_its_side() {
        assert_eq!(sides([1.0, 3.0], 0.0), [2.0, 0.0]);
        assert_eq!(sides([-3.0, -1.0], 0.0), [0.0, 2.0]);
        assert_eq!(sides([-1.0, -3.0], 0.0), [0.0, 2.0]);
        // 4t(1 − t) d has a mean of 2d/3.
        assert_eq!(sides([1.0, 3.0], -0.75), [1.5, 0.0]);
        assert_eq!(sides([-1.0, -3.0], 0.75), [0.0, 1.5]);
        assert_eq!(sides([1.0, 0.0], -0.75), [0.0, 0.0]);
        assert_eq!(sides([2.0, 2.0], -0.75), [1.5, 0.0]);
        for (ends, of_positive) in [([0.0, 3.0], true), ([-3.0, 0.0], false), ([0.0, -3.0], false)]
        {
            let bubble = if of_positive { -0.75 } else { 0.75 };
            let expected = if of_positive { [1.0, 0.0] } else { [0.0, 1.0] };
            assert_eq!(sides(ends, bubble), expected, "{ends:?}");
        }
    }

    #[test]
    fn between_ends_on_the_gap_the_bubble_says_where_it_is() {
        assert_eq!(sides([0.0, 0.0], 1.5), [1.0, 0.0]);
        assert_eq!(sides([0.0, 0.0], -1.5), [0.0, 1.0]);
        assert_eq!(sides([0.0, 0.0], 0.0), [0.0, 0.0]);
    }

    #[test]
    fn an_excess_that_crosses_the_gap_has_a_triangle_on_either_side() {
        assert_eq!(sides([3.0, -1.0], 0.0), [1.125, 0.125]);
        assert_eq!(sides([-1.0, 3.0], 0.0), [1.125, 0.125]);
        assert_eq!(sides([-3.0, 1.0], 0.0), [0.125, 1.125]);
        assert_eq!(sides([0.0, 2.0], 0.0), [1.0, 0.0]);
        assert_eq!(sides([-2.0, 0.0], 0.0), [0.0, 1.0]);
    }
}
