//! Moduli of expressions over complex neighbourhoods of a region, for what Gauss rules miss of them.
//!
//! An analytic F with |F| ≤ M in the ellipse with foci ±1 and semi-axes ½(ρ ± 1/ρ) is Σ aₖTₖ with |aₖ| ≤ 2Mρ⁻ᵏ. A Gauss rule of n ≥ 2
//! points is exact below k = 2n and, as ∫, 0 for odd k; of each other Tₖ it misses at most 2 + 2/(k² − 1), so that
//! ```text
//!   |∫F − Q| ≤ (64/15) M ρ⁻²ⁿ/(1 − ρ⁻²).
//! ```
//! The ellipse lies in the disc of radius ½(ρ + 1/ρ). Discs with real centres run through the expression: c ± r holds f(z) where the operand's
//! disc holds z. Where a disc meets a pole, a cut or a kink the radius is infinite. What underflows is not 0: a number that later factors may
//! enlarge stays in the radius.

use super::super::operation::{Binary, Unary};
use super::super::program::Numbers;
use super::function::{ULP, faded};
use std::f64::consts::FRAC_2_SQRT_PI;

/// Below this a value has lost digits, and tells nothing of values around it.
const FADED: f64 = 1e-290;

/// All complex numbers within `radius` of a real one; all of them where it is infinite. What is linear in the reference coordinates is
/// kept beside: along a thin cell that lies aslant, x and y vary by much, and their combination across it by little.
#[derive(Debug, Clone, Copy)]
pub(super) struct Disc {
    pub centre: f64,
    pub radius: f64,
    /// Factors of ξ, η and ξη.
    along: [f64; 3],
    /// The radius beside these.
    pub rest: f64,
}

impl Disc {
    pub fn new(centre: f64, radius: f64) -> Self {
        let radius = radius + 16.0 * ULP * (centre.abs() + radius);
        let is_known = centre.is_finite() && radius.is_finite();
        let (centre, radius) = if is_known { (centre, radius) } else { (0.0, f64::INFINITY) };
        Self { centre, radius, along: [0.0; 3], rest: radius }
    }

    /// The numbers c + uξ + vη + wξη, where one of ξ and η is real and the other one in the disc of radius `reach`.
    pub fn linear(centre: f64, along: [f64; 3], reach: f64) -> Self {
        Self { along, rest: 0.0, ..Self::new(centre, 0.0) }.bounded(reach)
    }

    /// With rounding of its parts, and the radius that follows from them where it is the smaller one.
    fn bounded(self, reach: f64) -> Self {
        let [u, v, w] = self.along.map(f64::abs);
        let slack = 16.0 * ULP * (self.centre.abs() + reach * (u + v + w));
        let rest = self.rest + slack;
        let radius = (v + reach * (u + w)).max(u + reach * (v + w)) * (1.0 + 8.0 * ULP) + rest;
        match radius.is_finite() && self.centre.is_finite() {
            true => Self { rest, radius, ..self },
            false => Self::unknown(),
        }
    }

    /// a·self + b·other
    fn combined(self, a: f64, other: Self, b: f64, reach: f64) -> Self {
        let along = [0, 1, 2].map(|k| a * self.along[k] + b * other.along[k]);
        let rest = (a * self.rest).abs() + (b * other.rest).abs();
        // What cancels in the sum was rounded before.
        let sizes = a.abs() * self.modulus() + b.abs() * other.modulus();
        let is_zero = |a: f64, of: Self| a == 0.0 || of.modulus() == 0.0;
        let rest = rest + 16.0 * ULP * sizes + faded(is_zero(a, self) && is_zero(b, other));
        let centre = a * self.centre + b * other.centre;
        Self { along, rest, ..Self::new(centre, rest) }.bounded(reach)
    }

    /// The largest modulus.
    pub fn modulus(self) -> f64 {
        self.centre.abs() + self.radius
    }

    /// The least.
    fn distance(self) -> f64 {
        (self.centre.abs() - self.radius).max(0.0)
    }

    /// Radius over the centre's modulus: at least 1 where the disc holds 0.
    fn share(self) -> f64 {
        if self.centre == 0.0 { f64::INFINITY } else { self.radius / self.centre.abs() }
    }

    fn unknown() -> Self {
        Self::new(0.0, f64::INFINITY)
    }

    /// cᵖ(1 + w)ᵖ, |w| ≤ q < 1: binomials of p are at most those of −|p| in modulus.
    fn power(self, p: f64) -> Self {
        let is_whole = p >= 0.0 && p.fract() == 0.0;
        let (centre, q) = (self.centre.powf(p), self.share());
        let faded = faded(self.modulus() == 0.0);
        match is_whole {
            // (|c| + r)ᵖ − |c|ᵖ
            true => Self::new(
                centre,
                (self.modulus().powf(p) - centre.abs()).max(0.0)
                    + ULP * self.modulus().powf(p)
                    + faded,
            ),
            // At most the power of the largest or least modulus.
            false if q < 1.0 && centre.abs() < FADED => {
                let far = if p > 0.0 { self.modulus() } else { self.distance() };
                Self::new(centre, far.powf(p) + faded)
            }
            false if q < 1.0 => Self::new(centre, centre.abs() * ((1.0 - q).powf(-p.abs()) - 1.0)),
            false => Self::unknown(),
        }
    }

    fn times(self, other: Self) -> Self {
        let is_zero = self.modulus() == 0.0 || other.modulus() == 0.0;
        let radius = self.centre.abs() * other.radius + self.radius * other.modulus();
        Self::new(self.centre * other.centre, radius + faded(is_zero))
    }

    /// erf or erfc around its value at c. Of |exp(−z²)| = exp(v² − u²), z = u + iv, with v² ≤ r² − (u − c)² the
    /// largest is at u = c/2 where the disc reaches as far, else at its end next to 0.
    fn bell(self, value: f64) -> Self {
        let (c, r, slack) = (self.centre.abs(), self.radius, 8.0 * ULP);
        let exponent = match c <= 2.0 * r {
            true => (1.0 + slack) * (r * r) - (1.0 - slack) * (0.5 * c * c),
            false => -(1.0 - slack) * (c - r).powi(2),
        };
        // Where erfc underflows it is not 0.
        Self::new(value, FRAC_2_SQRT_PI * r * exponent.exp() + f64::MIN_POSITIVE)
    }

    /// Around f(c), with a bound of |f′| in the disc.
    fn steep(self, centre: f64, slope: f64) -> Self {
        Self::new(centre, self.radius * slope)
    }
}

/// Discs, the reference coordinate that is complex being within this number of the middle.
pub(super) struct Discs(pub f64);

impl Numbers for Discs {
    type Number = Disc;

    fn constant(&self, value: f64) -> Disc {
        Disc { centre: value, radius: 0.0, along: [0.0; 3], rest: 0.0 }
    }

    fn unary(&self, operation: Unary, a: Disc) -> Disc {
        let (c, r) = (a.centre, a.radius);
        let value = operation.apply(c);
        // The least product of distances from the branch points ±1.
        let off = ((c - 1.0).abs() - r) * ((c + 1.0).abs() - r);
        match operation {
            Unary::Negate => a.combined(-1.0, self.constant(0.0), 0.0, self.0),
            // |sin z − sin c| = 2|sin ½(z − c) cos ½(z + c)|
            Unary::Sin | Unary::Cos => Disc::new(value, 2.0 * (0.5 * r).sinh() * (0.5 * r).cosh()),
            Unary::Tan => {
                self.binary(Binary::Divide, self.unary(Unary::Sin, a), self.unary(Unary::Cos, a))
            }
            Unary::Sinh | Unary::Cosh => {
                Disc::new(value, 2.0 * (0.5 * r).sinh() * (c.abs() + 0.5 * r).cosh())
            }
            // No pole within ½π of the real axis.
            Unary::Tanh if r < 1.5 => a.steep(value, r.cos().powi(-2)),
            Unary::Exp if value < FADED => {
                // Beside the rounding of the exponent, which is no larger than |c| + r.
                let most = (c + r).exp() * (1.0 + 4.0 * ULP * (c.abs() + r));
                Disc::new(value, most + f64::MIN_POSITIVE)
            }
            Unary::Exp => Disc::new(value, value * r.exp_m1()),
            Unary::Erf | Unary::Erfc => a.bell(value),
            Unary::Ln if c > r => Disc::new(value, -(-a.share()).ln_1p()),
            Unary::Sqrt if c > r => a.power(0.5),
            Unary::Asin | Unary::Acos if c.abs() + r < 1.0 => a.steep(value, off.powf(-0.5)),
            Unary::Atan => {
                let far = c.hypot(1.0) - r;
                if far > 0.0 { a.steep(value, far.powi(-2)) } else { Disc::unknown() }
            }
            Unary::Abs if c.abs() > r => Disc::new(value, r),
            Unary::Sign if c.abs() > r => self.constant(value),
            Unary::Tanh
            | Unary::Ln
            | Unary::Sqrt
            | Unary::Asin
            | Unary::Acos
            | Unary::Abs
            | Unary::Sign => Disc::unknown(),
        }
    }

    fn binary(&self, operation: Binary, a: Disc, b: Disc) -> Disc {
        let is_apart = (a.centre - b.centre).abs() > a.radius + b.radius;
        match operation {
            Binary::Add => a.combined(1.0, b, 1.0, self.0),
            Binary::Subtract => a.combined(1.0, b, -1.0, self.0),
            Binary::Multiply if b.radius == 0.0 => a.combined(b.centre, b, 0.0, self.0),
            Binary::Multiply if a.radius == 0.0 => b.combined(a.centre, a, 0.0, self.0),
            Binary::Multiply => a.times(b),
            Binary::Divide if b.radius == 0.0 && b.centre != 0.0 => {
                a.combined(1.0 / b.centre, b, 0.0, self.0)
            }
            Binary::Divide => a.times(b.power(-1.0)),
            Binary::Power if b.radius == 0.0 && (b.centre.fract() == 0.0 || a.centre > 0.0) => {
                a.power(b.centre)
            }
            Binary::Power if a.centre > a.radius => {
                self.unary(Unary::Exp, b.times(self.unary(Unary::Ln, a)))
            }
            Binary::Atan2 => self.angle(a, b),
            Binary::Min | Binary::Max if is_apart => {
                let is_first = operation.apply(a.centre, b.centre) == a.centre;
                if is_first { a } else { b }
            }
            Binary::Power | Binary::Min | Binary::Max => Disc::unknown(),
        }
    }
}

impl Discs {
    /// atan2(a, b), analytic where b or a keeps its sign and a² + b² has no zero: arctan(a/b) or ±½π − arctan(b/a), plus constants.
    fn angle(&self, a: Disc, b: Disc) -> Disc {
        let quotient = if b.centre > b.radius {
            self.binary(Binary::Divide, a, b)
        } else if a.distance() > 0.0 {
            self.binary(Binary::Divide, b, a)
        } else {
            return Disc::unknown();
        };
        let Disc { radius, .. } = self.unary(Unary::Atan, quotient);
        Disc::new(a.centre.atan2(b.centre), radius)
    }
}
