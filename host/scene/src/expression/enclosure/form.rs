//! Taylor forms: a polynomial of degree 2, an interval of what is missed, and a range.

use super::function::ULP;
use super::interval::Interval;
use super::polynomial::{self, Polynomial, Shape};

/// All that a function may be on a region: its value at (ξ, η) is p(ξ, η) plus a number of `remainder`, and lies in `range`.
///
/// Invariant: no part is NaN, the coefficients are finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Form {
    shape: Shape,
    /// Coefficients of p: 1, ξ, η, ξ², ξη, η². No monomial is larger than 1.
    pub coefficients: Polynomial,
    /// The difference between the function and p.
    pub remainder: Interval,
    range: Interval,
    is_defined: bool,
    /// Whether it is analytic inside the region: then it takes no value on more than lines, or it is constant.
    is_analytic: bool,
}

impl Form {
    /// The constant `value`.
    pub fn constant(shape: Shape, value: f64) -> Self {
        Self::flat(shape, Interval::point(value), !value.is_nan())
    }

    /// Anything in `range`; `is_defined` if it is a number everywhere.
    pub fn flat(shape: Shape, range: Interval, is_defined: bool) -> Self {
        let middle = range.middle();
        let coefficients = [middle, 0.0, 0.0, 0.0, 0.0, 0.0];
        let remainder = range - Interval::point(middle);
        Self {
            shape,
            coefficients,
            remainder,
            range,
            is_defined,
            is_analytic: range.low == range.high,
        }
    }

    /// p and what is missed, whose values lie in `natural` too: what is narrower stays.
    pub(super) fn new(
        shape: Shape,
        coefficients: Polynomial,
        remainder: Interval,
        (natural, is_defined): (Interval, bool),
        is_analytic: bool,
    ) -> Self {
        let is_finite = coefficients.iter().all(|c| c.is_finite()) && remainder.is_finite();
        if !is_finite || !is_defined || remainder.width() > natural.width() {
            return Self { is_analytic, ..Self::flat(shape, natural, is_defined) };
        }
        let range = natural.meet(polynomial::range(shape, &coefficients) + remainder);
        Self { shape, coefficients, remainder, range, is_defined, is_analytic }
    }

    /// The shape that its reference coordinates run through.
    pub fn shape(&self) -> Shape {
        self.shape
    }

    /// No value lies outside.
    pub fn range(&self) -> Interval {
        self.range
    }

    /// Whether it is proved that every value is a number; it may still be infinite.
    pub fn is_defined(&self) -> bool {
        self.is_defined
    }

    /// Whether it is proved that every value is a finite number.
    pub fn is_finite(&self) -> bool {
        self.is_defined && self.range.is_finite()
    }

    /// Whether it is proved to be one number everywhere.
    pub fn is_constant(&self) -> bool {
        self.is_defined && self.range.low == self.range.high
    }

    /// Whether it is proved to take no value on more than lines: it is analytic, and differs between corners.
    pub(super) fn has_thin_levels(&self) -> bool {
        let corners = polynomial::CORNERS.map(|at| self.at(at));
        let differ = |a: Interval, b: Interval| a.high < b.low || b.high < a.low;
        self.is_analytic && (differ(corners[0], corners[1]) || differ(corners[0], corners[2]))
    }

    /// Whether it is analytic inside the region.
    pub(super) fn is_analytic(&self) -> bool {
        self.is_analytic
    }

    /// The values of p(ξ, η) + `remainder` at reference coordinates.
    pub fn at(&self, reference: [f64; 2]) -> Interval {
        let value = Interval::point(polynomial::value(&self.coefficients, reference));
        let slack = 4.0 * ULP * polynomial::size(&self.coefficients);
        self.range.meet(value.widened(slack) + self.remainder)
    }

    /// a·self + b·other
    #[must_use]
    pub fn combined(&self, a: f64, other: &Self, b: f64) -> Self {
        let coefficients =
            [0, 1, 2, 3, 4, 5].map(|k| a * self.coefficients[k] + b * other.coefficients[k]);
        let size = (a * polynomial::size(&self.coefficients)).abs()
            + (b * polynomial::size(&other.coefficients)).abs();
        let remainder = (a * self.remainder + b * other.remainder).widened(4.0 * ULP * size);
        let range = a * self.range + b * other.range;
        // ∞ − ∞
        let is_number = range.is_finite() || self.range.is_finite() || other.range.is_finite();
        let is_defined = self.is_defined && other.is_defined && is_number;
        Self::new(
            self.shape,
            coefficients,
            remainder,
            (range, is_defined),
            self.is_analytic && other.is_analytic,
        )
    }

    /// self − other
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        self.combined(1.0, other, -1.0)
    }

    /// a·self
    #[must_use]
    pub fn scaled(&self, a: f64) -> Self {
        let coefficients = self.coefficients.map(|c| a * c);
        let slack = 2.0 * ULP * polynomial::size(&coefficients);
        let remainder = (a * self.remainder).widened(slack);
        Self::new(
            self.shape,
            coefficients,
            remainder,
            (a * self.range, self.is_defined),
            self.is_analytic,
        )
    }

    /// self + a
    #[must_use]
    pub fn shifted(&self, a: f64) -> Self {
        self.shifted_by(Interval::point(a))
    }

    /// self + a for some number of `a`.
    pub(super) fn shifted_by(&self, a: Interval) -> Self {
        let constant = Self { is_analytic: true, ..Self::flat(self.shape, a, true) };
        self.combined(1.0, &constant, 1.0)
    }

    /// self·other
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let is_defined = self.is_finite() && other.is_finite();
        self.times_within(other, (self.range * other.range, is_defined))
    }

    /// self·other, whose values lie in `natural`.
    ///
    /// (p + r)(q + s) = pq + r(q + s) + ps
    pub(super) fn times_within(&self, other: &Self, natural: (Interval, bool)) -> Self {
        if other.is_constant() && self.is_finite() && other.remainder == Interval::ZERO {
            return self.scaled(other.coefficients[0]).within(natural);
        }
        if self.is_constant() && other.is_finite() && self.remainder == Interval::ZERO {
            return other.scaled(self.coefficients[0]).within(natural);
        }
        let (kept, rest) = polynomial::product(self.shape, &self.coefficients, &other.coefficients);
        let own = polynomial::range(self.shape, &self.coefficients);
        let remainder = rest + self.remainder * other.range + own * other.remainder;
        Self::new(self.shape, kept, remainder, natural, self.is_analytic && other.is_analytic)
    }

    /// This, whose values lie in `natural` too.
    pub(super) fn within(mut self, (natural, is_defined): (Interval, bool)) -> Self {
        self.range = self.range.meet(natural);
        self.is_defined &= is_defined;
        self
    }
}
