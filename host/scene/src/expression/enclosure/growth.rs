//! Unbounded expressions: those that grow like a power of the distance to a point or a line.
//!
//! ```text
//!   low·ρᵉ ≤ |f| ≤ high·ρᵉ,   ρ: the distance to one place
//! ```
//! Affine functions have their zero as their place, and e = 1; a sum of two squares of such the point where both are 0, with the eigenvalues
//! of its form; powers, products and quotients follow. |ln ρ| ≤ Cρ^−δ. Integrals of ρᵉ are enclosed in closed form ([`super::power`]).

use super::super::operation::{Binary, Unary};
use super::super::program::Numbers;
use super::form::Form;
use super::function::{ULP, faded};
use super::numbers::Forms;
use super::region::{Region, cross, dot, from, norm};

/// Where a power of the distance grows without bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// n·x = c, |n| = 1.
    Line([f64; 2], f64),
    /// A point.
    Point([f64; 2]),
}

/// |f| lies between `low` and `high` times ρ^`exponent`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Growth {
    /// The least factor.
    pub low: f64,
    /// The greatest.
    pub high: f64,
    /// −1 or 1 where f has that sign everywhere, else 0.
    pub sign: f64,
    /// The exponent.
    pub exponent: f64,
    /// The place that ρ is the distance to; `None` where the exponent is 0.
    pub place: Option<Place>,
}

/// Exponent of what bounds a logarithm.
const FLAT: f64 = 1.0 / 16.0;
/// Places that differ by less of the coordinates are one, which was rounded in two ways: between two poles that are near each other is a
/// peak, however near they are.
const SAME: f64 = 64.0 * ULP;

impl Growth {
    fn plain(form: &Form) -> Option<Self> {
        let range = form.range();
        let [low, high, sign] = [range.distance(), range.size(), range.sign()];
        range.is_finite().then_some(Self { low, high, sign, exponent: 0.0, place: None })
    }

    fn power(self, p: f64) -> Option<Self> {
        let is_even = p % 2.0 == 0.0;
        let sign = if is_even { 1.0 } else { self.sign };
        if (p.fract() != 0.0 && self.sign <= 0.0) || (p < 0.0 && self.low == 0.0) {
            return None;
        }
        let [a, b] = [self.low.powf(p), self.high.powf(p)];
        let slack = 8.0 * ULP;
        let [low, high] = [a.min(b) * (1.0 - slack), a.max(b) * (1.0 + slack)];
        let high = high.max(faded(self.high == 0.0));
        Some(Self { low, high, sign, exponent: p * self.exponent, ..self })
    }

    fn times(self, other: Self, place: Option<Place>) -> Self {
        let is_zero = self.high == 0.0 || other.high == 0.0;
        Self {
            low: self.low * other.low * (1.0 - 4.0 * ULP),
            high: (self.high * other.high * (1.0 + 4.0 * ULP)).max(faded(is_zero)),
            sign: self.sign * other.sign,
            exponent: self.exponent + other.exponent,
            place,
        }
    }
}

/// A form, and how it grows where that is known.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grown {
    pub form: Form,
    pub growth: Option<Growth>,
    /// Factors of x, y and 1, where it is affine in them.
    pub affine: Option<[f64; 3]>,
}

/// Forms over a region with their growth.
pub(super) struct Grows<'r>(pub &'r Region);

impl Numbers for Grows<'_> {
    type Number = Grown;

    fn constant(&self, value: f64) -> Grown {
        self.seen(Form::constant(self.0.shape(), value), Some([0.0, 0.0, value]), None)
    }

    fn unary(&self, operation: Unary, a: Grown) -> Grown {
        let form = self.forms().unary(operation, a.form);
        let singular = a.growth.filter(|growth| growth.place.is_some());
        let growth = singular.and_then(|growth| match operation {
            Unary::Negate => Some(Growth { sign: -growth.sign, ..growth }),
            Unary::Abs => Some(Growth { sign: 1.0, ..growth }),
            Unary::Sqrt => growth.power(0.5),
            Unary::Ln => self.logarithm(growth),
            // Whatever they are of, bounded functions are bounded.
            _ => Growth::plain(&form),
        });
        let negated = a.affine.filter(|_| operation == Unary::Negate);
        self.seen(form, negated.map(|affine| affine.map(|c| -c)), growth)
    }

    fn binary(&self, operation: Binary, a: Grown, b: Grown) -> Grown {
        let form = self.forms().binary(operation, a.form, b.form);
        let growth = a.growth.zip(b.growth).and_then(|(of_a, of_b)| match operation {
            _ if of_a.place.is_none() && of_b.place.is_none() => None,
            Binary::Add => self.sum(of_a, of_b),
            Binary::Subtract => self.sum(of_a, Growth { sign: -of_b.sign, ..of_b }),
            Binary::Multiply => self.product(of_a, of_b),
            Binary::Divide => self.product(of_a, of_b.power(-1.0)?),
            Binary::Power if b.form.is_constant() => of_a.power(b.form.range().low),
            _ => None,
        });
        self.seen(form, affine(operation, a, b), growth)
    }
}

/// Of sums, and of products and quotients with a constant.
fn affine(operation: Binary, a: Grown, b: Grown) -> Option<[f64; 3]> {
    let (of_a, of_b) = (a.affine?, b.affine?);
    let both = |way: f64| Some([0, 1, 2].map(|k| of_a[k] + way * of_b[k]));
    let number = |form: Form| form.is_constant().then_some(form.range().low);
    match operation {
        Binary::Add => both(1.0),
        Binary::Subtract => both(-1.0),
        Binary::Multiply => match (number(a.form), number(b.form)) {
            (Some(a), _) => Some(of_b.map(|c| a * c)),
            (_, Some(b)) => Some(of_a.map(|c| b * c)),
            _ => None,
        },
        Binary::Divide => number(b.form).map(|b| of_a.map(|c| c / b)),
        _ => None,
    }
}

impl Grows<'_> {
    fn forms(&self) -> Forms {
        Forms(self.0.shape())
    }

    /// x and y.
    pub fn coordinates(&self) -> [Grown; 2] {
        let [x, y] = self.0.coordinates();
        [self.seen(x, Some([1.0, 0.0, 0.0]), None), self.seen(y, Some([0.0, 1.0, 0.0]), None)]
    }

    /// A form as it grows: plainly where it is bounded and not 0 anywhere, from its zero where it is affine, else as its operation says.
    fn seen(&self, form: Form, affine: Option<[f64; 3]>, growth: Option<Growth>) -> Grown {
        let is_plain = form.is_finite() && !form.range().holds(0.0);
        let plain = || Growth::plain(&form).filter(|_| form.is_finite());
        let beside_zero = || self.beside_zero(&form, affine?);
        let growth = if is_plain { plain() } else { beside_zero().or(growth).or_else(plain) };
        Grown { form, growth, affine }
    }

    /// An affine function that is 0 somewhere: its slope times the distance from there.
    fn beside_zero(&self, form: &Form, affine: [f64; 3]) -> Option<Growth> {
        let (slope, place) = self.0.zero(affine)?;
        let slack = 1e-12;
        let [low, high] = [slope * (1.0 - slack), slope * (1.0 + slack)];
        Some(Growth { low, high, sign: form.range().sign(), exponent: 1.0, place: Some(place) })
    }

    /// The one place of both, where it is one: a line is seen from a point on it with no lower bound.
    fn joint(&self, a: Growth, b: Growth) -> Option<(Growth, Growth, Option<Place>)> {
        let corners = self.0.corners().iter().map(|corner| norm(*corner));
        let size = SAME * corners.fold(0.0, f64::max);
        let is_near = |p, q| norm(from(q, p)) <= size;
        let seen = |line: Growth, place| Growth { low: 0.0, place: Some(place), ..line };
        match (a.place, b.place) {
            (place, None) | (None, place) => Some((a, b, place)),
            (Some(Place::Point(p)), Some(Place::Point(q))) if is_near(p, q) => {
                Some((a, b, a.place))
            }
            (Some(Place::Line(n, c)), Some(Place::Line(m, d)))
                if norm(from(m, n)) <= SAME && (c - d).abs() <= size =>
            {
                Some((a, b, a.place))
            }
            (Some(Place::Line(n, c)), Some(place @ Place::Point(p))) if a.exponent >= 0.0 => {
                let is_on = (dot(n, p) - c).abs() <= size;
                is_on.then(|| (seen(a, place), b, Some(place)))
            }
            (Some(Place::Point(_)), Some(Place::Line(..))) => {
                self.joint(b, a).map(|(b, a, place)| (a, b, place))
            }
            _ => None,
        }
    }

    fn product(&self, a: Growth, b: Growth) -> Option<Growth> {
        self.joint(a, b).map(|(a, b, place)| a.times(b, place))
    }

    fn sum(&self, a: Growth, b: Growth) -> Option<Growth> {
        if a.high == 0.0 || b.high == 0.0 {
            return Some(if a.high == 0.0 { b } else { a });
        }
        if let (Some(Place::Line(n, c)), Some(Place::Line(m, d))) = (a.place, b.place)
            && (a.exponent, b.exponent, a.sign, b.sign) == (2.0, 2.0, 1.0, 1.0)
            && let Some(squares) = squares([a, b], [n, m], [c, d])
        {
            return Some(squares);
        }
        let (a, b, place) = self.joint(a, b)?;
        let far = place.map_or(1.0, |place| self.0.farthest(place));
        let exponent = a.exponent.min(b.exponent);
        let [high_a, high_b] = [a, b].map(|of| of.high * far.powf(of.exponent - exponent));
        let lowest = if a.exponent <= b.exponent { a } else { b };
        let agree = a.sign * b.sign > 0.0;
        Some(Growth {
            low: if agree { lowest.low } else { 0.0 },
            high: (high_a + high_b) * (1.0 + 8.0 * ULP),
            sign: if agree { a.sign } else { 0.0 },
            exponent,
            place: place.filter(|_| exponent != 0.0),
        })
    }

    /// |ln(cρᵉ)| ≤ |e||ln ρ| + |ln c|, and ρ^δ |ln ρ| ≤ max(1/(δ exp 1), D^δ |ln D|) up to the distance D.
    fn logarithm(&self, of: Growth) -> Option<Growth> {
        if of.low == 0.0 || of.sign < 0.0 {
            return None;
        }
        let far = self.0.farthest(of.place?);
        let flat = (1.0 / (FLAT * std::f64::consts::E)).max(far.powf(FLAT) * far.ln().abs());
        let rest = of.low.ln().abs().max(of.high.ln().abs()) * far.powf(FLAT);
        let high = (of.exponent.abs() * flat + rest) * (1.0 + 16.0 * ULP);
        Some(Growth { low: 0.0, high, sign: 0.0, exponent: -FLAT, ..of })
    }
}

/// a·dist² + b·dist² of two lines that meet: between the eigenvalues of a nnᵀ + b mmᵀ times the square of the distance to their point.
fn squares(factors: [Growth; 2], [n, m]: [[f64; 2]; 2], [c, d]: [f64; 2]) -> Option<Growth> {
    let turn = cross(n, m);
    if turn.abs() < 1e-6 {
        return None;
    }
    let point = [(c * m[1] - d * n[1]) / turn, (n[0] * d - m[0] * c) / turn];
    let eigenvalues = |a: f64, b: f64| {
        let [xx, yy] = [0, 1].map(|k| a * n[k] * n[k] + b * m[k] * m[k]);
        let xy = a * n[0] * n[1] + b * m[0] * m[1];
        let (half, root) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        [half - root, half + root]
    };
    let slack = 1e-12;
    let low = eigenvalues(factors[0].low, factors[1].low)[0] * (1.0 - slack);
    let high = eigenvalues(factors[0].high, factors[1].high)[1] * (1.0 + slack);
    Some(Growth {
        low: low.max(0.0),
        high,
        sign: 1.0,
        exponent: 2.0,
        place: Some(Place::Point(point)),
    })
}
