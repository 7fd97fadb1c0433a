//! Enclosures of expressions over cells, edges and parts of them: no value lies outside.
//!
//! ```text
//! corners ─► Region ─┐
//!                    ├─► program, run on forms ─► Form: c₀ + c₁ξ + c₂η + c₃ξ² + c₄ξη + c₅η² + [r₋, r₊], and a range
//! expression, t ─────┘
//! ```
//! (ξ, η) are reference coordinates of the region. A smooth operation is its Taylor polynomial of degree 2 in its operand, and
//! Lagrange's remainder with the third derivative enclosed by intervals; beside it each form carries the range that
//! intervals alone give (`interval`, rounded outward), and takes it where the remainder is wider. `abs`, `min` and `max` are
//! resolved where the sign of their argument is known, and lie between a chord and a chord less the kink's height where it
//! is not. A jump is the hull of its values.
//!
//! What is enclosed is the expression in real numbers and in f64 alike, almost everywhere: at a pole the sign of a zero does not count.
//! Where it has values in a part of the region only, the form encloses these, and says that it is not [`Form::is_finite`].

mod branches;
mod continuation;
mod cut;
mod degree;
mod derivatives;
mod form;
mod function;
mod growth;
mod interval;
mod numbers;
mod parts;
mod polynomial;
mod power;
mod region;
mod slope;
#[cfg(test)]
mod tests;

pub use form::Form;
pub use growth::{Growth, Place};
pub use interval::Interval;
pub use polynomial::Shape;
pub use region::Region;
use region::reach;

use super::Expression;
use super::program::Numbers;
use branches::{Branch, Branches};
use continuation::{Disc, Discs};
use cut::Switches;
use degree::{Degree, Degrees};
use growth::Grows;
use numbers::Forms;
pub use numbers::root;
use slope::{Slope, Slopes};

impl Expression {
    /// All values in `region` at the time t, in f64 arithmetic whatever that of the expression.
    pub fn enclose(&self, region: &Region, t: f64) -> Form {
        let forms = Forms(region.shape());
        match self.is_constant() {
            Some(value) => forms.constant(value),
            None => self.program.at(&forms, region.coordinates(), t),
        }
    }

    /// The largest modulus of its analytic continuation, where one reference coordinate of the region's rule is complex and within
    /// ½(ρ + 1/ρ) of the middle: see [`Region::missed`]. Infinite where there may be none.
    pub fn modulus(&self, region: &Region, rho: f64, t: f64) -> f64 {
        self.disc(region, rho, t).modulus()
    }

    /// The largest modulus of that continuation less some function that is linear in the reference coordinates.
    pub fn bend(&self, region: &Region, rho: f64, t: f64) -> f64 {
        self.disc(region, rho, t).rest
    }

    fn disc(&self, region: &Region, rho: f64, t: f64) -> Disc {
        let ([x, y], discs) = (region.neighbourhood(rho), Discs(reach(rho)));
        if self.is_smooth() {
            return self.program.at(&discs, [x, y], t);
        }
        let branches = Branches(Forms(region.shape()), discs);
        let [of_x, of_y] = region.coordinates();
        let at = [Branch { form: of_x, disc: x }, Branch { form: of_y, disc: y }];
        self.program.at(&branches, at, t).disc
    }

    /// The first argument of a kink or a jump whose sign is not known in a region, see [`Region::cut`].
    pub fn switch(&self, region: &Region, t: f64) -> Option<Form> {
        let switches = Switches { forms: Forms(region.shape()), found: None.into() };
        self.program.at(&switches, region.coordinates(), t);
        switches.found.get()
    }

    /// How it grows in a region where it is not bounded, if that is known.
    pub fn growth(&self, region: &Region, t: f64) -> Option<Growth> {
        let grows = Grows(region);
        self.program.at(&grows, grows.coordinates(), t).growth
    }

    /// Its degree as a polynomial in x and y at the time t, infinite where it may be none.
    pub fn degree(&self, t: f64) -> f64 {
        let one = Degree { degree: 1.0, value: f64::NAN };
        self.program.at(&Degrees, [one; 2], t).degree
    }

    /// All values and all derivatives along a way on which x and y change as fast as `direction` says, where there are any:
    /// at a kink the derivatives of both sides.
    pub fn enclose_slope(&self, region: &Region, t: f64, direction: [f64; 2]) -> [Form; 2] {
        let forms = Forms(region.shape());
        let ([x, y], [dx, dy]) = (region.coordinates(), direction.map(|by| forms.constant(by)));
        let at = [(x, dx), (y, dy)].map(|(value, slope)| Slope { value, slope });
        let Slope { value, slope } = self.program.at(&Slopes(forms), at, t);
        [value, slope]
    }
}
