//! Intervals of real numbers, their ends rounded outwards: what is computed with them holds for real arithmetic.

use std::ops::{Add, Mul, Sub};

/// All real numbers from `lo` to `hi`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The lower end.
    pub lo: f64,
    /// The upper end.
    pub hi: f64,
}

impl Interval {
    /// 0 alone.
    pub const ZERO: Self = Self::point(0.0);

    /// One number.
    pub const fn point(x: f64) -> Self {
        Self { lo: x, hi: x }
    }

    /// The interval between two ends, the lower one first.
    pub const fn between([lo, hi]: [f64; 2]) -> Self {
        Self { lo, hi }
    }

    /// hi − lo
    pub fn width(&self) -> f64 {
        self.hi - self.lo
    }

    /// max |x|
    pub fn size(&self) -> f64 {
        self.hi.max(-self.lo)
    }

    /// With so much more on either side.
    pub fn widened(self, by: f64) -> Self {
        Self::outwards(self.lo - by, self.hi + by)
    }

    /// Intersection of two intervals that hold the same number.
    pub fn and(self, other: Self) -> Self {
        Self { lo: self.lo.max(other.lo), hi: self.hi.min(other.hi) }
    }

    /// The least interval that holds both.
    pub fn hull(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// max(x, 0)
    pub fn not_negative(self) -> Self {
        Self { lo: self.lo.max(0.0), hi: self.hi.max(0.0) }
    }

    /// Sums and products are rounded to nearest: their neighbours lie beyond the exact ones. Of what overflows nothing is
    /// known.
    fn outwards(lo: f64, hi: f64) -> Self {
        let lo = if lo.is_nan() { f64::NEG_INFINITY } else { lo.next_down() };
        let hi = if hi.is_nan() { f64::INFINITY } else { hi.next_up() };
        Self { lo, hi }
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        match (self, other) {
            (Self::ZERO, sum) | (sum, Self::ZERO) => sum,
            _ => Self::outwards(self.lo + other.lo, self.hi + other.hi),
        }
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + Self { lo: -other.hi, hi: -other.lo }
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        if self == Self::ZERO || other == Self::ZERO {
            return Self::ZERO;
        }
        let ends = [self.lo * other.lo, self.lo * other.hi, self.hi * other.lo, self.hi * other.hi];
        if ends.iter().any(|end| end.is_nan()) {
            return Self::outwards(f64::NAN, f64::NAN);
        }
        let [least, most] = [f64::min, f64::max].map(|best| ends.into_iter().fold(ends[0], best));
        Self::outwards(least, most)
    }
}

/// Σ a_i b_i
pub fn dot(
    a: impl IntoIterator<Item = Interval>,
    b: impl IntoIterator<Item = Interval>,
) -> Interval {
    a.into_iter().zip(b).fold(Interval::ZERO, |sum, (a, b)| sum + a * b)
}

/// Boxes as intervals.
pub(super) fn between(ranges: &[[f64; 2]]) -> Vec<Interval> {
    ranges.iter().copied().map(Interval::between).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_lie_beyond_the_exact_ones() {
        let tenth = Interval::point(0.1);
        let sum = dot(vec![tenth; 10], vec![Interval::point(1.0); 10]);
        // 0.1 is above a tenth in binary, so that ten of it are above 1.
        assert!(sum.lo < 1.0 && 1.0 < sum.hi && sum.width() < 1e-14, "{sum:?}");
        let [a, b] = [Interval::between([-2.0, 3.0]), Interval::between([-5.0, 1.0])];
        let product = a * b;
        assert!(product.lo < -15.0 && 10.0 < product.hi && product.width() < 25.1, "{product:?}");
        assert_eq!((a - b).and(Interval::between([0.0, 1.0])), Interval::between([0.0, 1.0]));
    }

    #[test]
    fn nothing_is_known_of_what_overflows() {
        let large = Interval::point(f64::MAX);
        let all = (large + large) - (large + large);
        assert_eq!(all, Interval::between([f64::NEG_INFINITY, f64::INFINITY]));
        let product = Interval::between([0.0, 1.0]) * (large + large);
        assert_eq!(product.lo, f64::NEG_INFINITY, "{product:?}");
        assert_eq!(Interval::ZERO * large, Interval::ZERO);
    }
}
