//! Regions cut along the line where an argument of `abs`, `sign`, `min` or `max` is 0.
//!
//! With such an argument a = ℓ ± δ, ℓ affine, a has one sign where ℓ > δ, the other where ℓ < −δ. What is left is a strip, as narrow as rounding
//! for an affine argument. Of a curved one each halving of the strip makes it four times as narrow, where boxes alone would be halved.

use std::cell::Cell;

use super::super::operation::{Binary, Unary};
use super::super::program::Numbers;
use super::form::Form;
use super::function::ULP;
use super::interval::Interval;
use super::numbers::Forms;
use super::polynomial::{CORNERS, Shape};
use super::region::Region;

/// A strip is cut off where it is narrower than this part of the region.
const NARROW: f64 = 0.25;

/// Forms, and the first argument whose sign decides and is not known.
pub(super) struct Switches {
    pub forms: Forms,
    pub found: Cell<Option<Form>>,
}

impl Switches {
    fn see(&self, argument: Form) {
        let Interval { low, high } = argument.range();
        if low < 0.0 && high > 0.0 && self.found.get().is_none() {
            self.found.set(Some(argument));
        }
    }
}

impl Numbers for Switches {
    type Number = Form;

    fn constant(&self, value: f64) -> Form {
        self.forms.constant(value)
    }

    fn unary(&self, operation: Unary, a: Form) -> Form {
        if let Unary::Abs | Unary::Sign = operation {
            self.see(a);
        }
        self.forms.unary(operation, a)
    }

    fn binary(&self, operation: Binary, a: Form, b: Form) -> Form {
        if let Binary::Min | Binary::Max = operation {
            self.see(a.minus(&b));
        }
        self.forms.binary(operation, a, b)
    }
}

/// A corner, and ℓ there.
type Corner = ([f64; 2], f64);

impl Region {
    /// Triangles on either side of a strip that holds all zeros of `argument`, and in the strip; `None` of a segment, of a quad that is no
    /// parallelogram, and where the strip is as wide as the region.
    pub fn cut(&self, argument: &Form) -> Option<Vec<Self>> {
        let [constant, slopes @ .., a, b, c] = argument.coefficients;
        let bent = a.abs() + b.abs() + c.abs();
        let slack = 64.0 * ULP * (constant.abs() + slopes[0].abs() + slopes[1].abs() + bent);
        let width = bent + argument.remainder.size() + slack;
        let at = |[xi, eta]: [f64; 2]| constant + xi * slopes[0] + eta * slopes[1];
        let references: &[[f64; 2]] = match self.shape {
            Shape::Segment => return None,
            Shape::Triangle => &CORNERS,
            Shape::Quad if self.along[2] != [0.0; 2] => return None,
            Shape::Quad => &[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]],
        };
        let corners: Vec<Corner> =
            self.corners().iter().copied().zip(references.iter().map(|&xi| at(xi))).collect();
        let [low, high] =
            corners.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], corner| {
                [low.min(corner.1), high.max(corner.1)]
            });
        let is_narrow = width <= NARROW * 0.5 * (high - low);
        if !is_narrow {
            return None;
        }
        let above = clipped(&corners, width, 1.0);
        let below = clipped(&corners, -width, -1.0);
        let strip = clipped(&clipped(&corners, -width, 1.0), width, -1.0);
        Some([above, below, strip].iter().flat_map(|polygon| triangles(polygon)).collect())
    }
}

/// The part of a convex polygon where way·(ℓ − level) ≥ 0.
fn clipped(corners: &[Corner], level: f64, way: f64) -> Vec<Corner> {
    let is_inside = |corner: &Corner| way * (corner.1 - level) >= 0.0;
    let mut kept = Vec::new();
    for (at, a) in corners.iter().enumerate() {
        let b = &corners[(at + 1) % corners.len()];
        if is_inside(a) {
            kept.push(*a);
        }
        if is_inside(a) != is_inside(b) {
            let t = (level - a.1) / (b.1 - a.1);
            kept.push(([0, 1].map(|k| a.0[k] + t * (b.0[k] - a.0[k])), level));
        }
    }
    kept
}

/// A convex polygon's fan of triangles, without empty ones.
fn triangles(polygon: &[Corner]) -> impl Iterator<Item = Region> {
    let fan = polygon.windows(2).skip(1);
    let triangle = |pair: &[Corner]| Region::triangle([polygon[0].0, pair[0].0, pair[1].0]);
    fan.map(triangle).filter(|region| region.measure() > 0.0)
}
