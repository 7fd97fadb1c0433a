//! Intervals of reals, rounded outward.
//!
//! Sums, products, quotients and roots are rounded by an ulp where they are not exact, so that 0 stays 0: the
//! coordinate of a side on y = 0 does not become negative. Functions of libm are widened by 4 ulp ([`super::function`]).

/// All reals from `low` to `high`; never NaN.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The least.
    pub low: f64,
    /// The greatest.
    pub high: f64,
}

impl Interval {
    /// Every real.
    pub const ALL: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };
    /// 0 alone.
    pub const ZERO: Self = Self { low: 0.0, high: 0.0 };

    /// From `low` to `high`; everything where one of both is no number.
    pub fn new(low: f64, high: f64) -> Self {
        let clear = |end: f64, other: f64| if end.is_nan() { other } else { end };
        Self { low: clear(low, f64::NEG_INFINITY), high: clear(high, f64::INFINITY) }
    }

    /// One number.
    pub fn point(value: f64) -> Self {
        Self::new(value, value)
    }

    /// From −size to size.
    pub fn around(size: f64) -> Self {
        Self::new(-size, size)
    }

    /// The least interval that holds all of `values`; everything where one is no number.
    pub fn hull(values: &[f64]) -> Self {
        if values.iter().any(|value| value.is_nan()) {
            return Self::ALL;
        }
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        Self { low, high: values.iter().copied().fold(f64::NEG_INFINITY, f64::max) }
    }

    /// The least interval that holds both.
    pub fn join(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The numbers that both hold; this one where rounding or an empty domain has left nothing.
    pub fn meet(self, other: Self) -> Self {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        if low <= high { Self { low, high } } else { self }
    }

    /// Whether it holds `value`.
    pub fn holds(self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    /// Whether both ends are finite.
    pub fn is_finite(self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    /// The larger modulus.
    pub fn size(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// The smaller modulus: 0 where it holds 0.
    pub fn distance(self) -> f64 {
        if self.holds(0.0) { 0.0 } else { self.low.abs().min(self.high.abs()) }
    }

    /// −1 or 1 where no number of it has the other sign, else 0.
    pub(super) fn sign(self) -> f64 {
        f64::from(self.low >= 0.0) - f64::from(self.low < 0.0 && self.high <= 0.0)
    }

    /// high − low
    pub fn width(self) -> f64 {
        self.high - self.low
    }

    /// A number in its middle; 0 where it has no end on one side or both.
    pub fn middle(self) -> f64 {
        let middle = 0.5 * self.low + 0.5 * self.high;
        if middle.is_finite() { middle.clamp(self.low, self.high) } else { 0.0 }
    }

    /// The numbers within `by` of it.
    pub fn widened(self, by: f64) -> Self {
        if by == 0.0 { self } else { self + Self::around(by) }
    }

    /// The squares.
    pub fn square(self) -> Self {
        let [least, most] = [self.distance(), self.size()];
        Self::new(product_down(least, least), product_up(most, most))
    }

    /// The moduli.
    pub fn abs(self) -> Self {
        Self { low: self.distance(), high: self.size() }
    }

    /// Quotients; of a zero in `other` both one-sided limits where it lies inside, one where it is an end.
    pub fn over(self, other: Self) -> Self {
        if other.low == 0.0 && other.high == 0.0 {
            return Self::ALL;
        }
        match (other.low < 0.0, other.high > 0.0) {
            (true, true) => Self::ALL,
            (true, false) => (-self).over_positive(-other),
            (false, _) => self.over_positive(other),
        }
    }

    /// Quotients by what is not negative.
    fn over_positive(self, other: Self) -> Self {
        // No zero of it is one below the axis.
        let other = Self { low: other.low + 0.0, high: other.high + 0.0 };
        let low = if self.low < 0.0 { other.low } else { other.high };
        let high = if self.high > 0.0 { other.low } else { other.high };
        Self::new(quotient(self.low, low, f64::next_down), quotient(self.high, high, f64::next_up))
    }
}

impl std::ops::Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl std::ops::Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let low = sum(self.low, other.low, |error| error < 0.0, f64::next_down);
        let high = sum(self.high, other.high, |error| error > 0.0, f64::next_up);
        Self::new(low, high)
    }
}

impl std::ops::Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl std::ops::Mul for Interval {
    type Output = Self;

    /// By the signs of the factors: two products are the least and the greatest, but where both factors have both signs.
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self, other);
        let ([least, lower], [most, upper]) = if a.low >= 0.0 {
            let low = if b.low < 0.0 { a.high } else { a.low };
            let high = if b.high > 0.0 { a.high } else { a.low };
            ([low, b.low], [high, b.high])
        } else if a.high <= 0.0 {
            let low = if b.high > 0.0 { a.low } else { a.high };
            let high = if b.low < 0.0 { a.low } else { a.high };
            ([low, b.high], [high, b.low])
        } else if b.low >= 0.0 {
            ([a.low, b.high], [a.high, b.high])
        } else if b.high <= 0.0 {
            ([a.high, b.low], [a.low, b.low])
        } else {
            let low = product_down(a.low, b.high).min(product_down(a.high, b.low));
            return Self::new(low, product_up(a.low, b.low).max(product_up(a.high, b.high)));
        };
        Self::new(product_down(least, lower), product_up(most, upper))
    }
}

impl std::ops::Mul<Interval> for f64 {
    type Output = Interval;

    fn mul(self, other: Interval) -> Interval {
        Interval::point(self) * other
    }
}

/// a + b, stepped on where what rounding has cut off says so.
fn sum(a: f64, b: f64, is_beyond: impl Fn(f64) -> bool, step: impl Fn(f64) -> f64) -> f64 {
    let sum = a + b;
    let part = sum - a;
    let error = (a - (sum - part)) + (b - part);
    if is_beyond(error) { step(sum) } else { sum }
}

/// a·b, where 0 times what has no end is the limit 0.
fn product(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}

fn product_down(a: f64, b: f64) -> f64 {
    let value = product(a, b);
    if is_exact_product(a, b, value) { value } else { value.next_down() }
}

fn product_up(a: f64, b: f64) -> f64 {
    let value = product(a, b);
    if is_exact_product(a, b, value) { value } else { value.next_up() }
}

/// a/b for b ≥ 0, where x/0 is its one-sided limit and 0/0 may be 0.
fn quotient(a: f64, b: f64, step: impl Fn(f64) -> f64) -> f64 {
    if a == 0.0 {
        return 0.0;
    }
    let value = a / b;
    let is_exact = value.is_infinite() || is_exact_product(value, b, a);
    if is_exact || value.is_nan() { value } else { step(value) }
}

/// Whether `value` is a·b to the last bit (Dekker); false in doubt.
pub(super) fn is_exact_product(a: f64, b: f64, value: f64) -> bool {
    const SPLIT: f64 = 134_217_729.0;
    if a == 0.0 || b == 0.0 {
        return value == 0.0;
    }
    if a.is_infinite() || b.is_infinite() {
        return true;
    }
    let [small, large] = [1e-140, 1e140];
    let in_range = |x: f64| (small..large).contains(&x.abs());
    if !in_range(a) || !in_range(b) || value != a * b {
        return false;
    }
    let split = |x: f64| {
        let high = SPLIT * x - (SPLIT * x - x);
        [high, x - high]
    };
    let ([a1, a0], [b1, b0]) = (split(a), split(b));
    a0 * b0 - (((value - a1 * b1) - a0 * b1) - a1 * b0) == 0.0
}
