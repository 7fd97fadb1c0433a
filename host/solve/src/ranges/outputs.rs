//! Where every output of a condensed model lies for all inputs of the box.
//!
//! For solutions every output but a length is affine in (p, x), since r = Sx − Bp is 0 wherever x is not:
//! ```text
//!   y = Y_p p + Y_x x + Y_r r = a p + c x,     a = Y_p − Y_r B,     c = Y_x + Y_r S.
//! ```
//! On the edges O that are always open r = 0, so that any multiple μ of their rows may be added. With μ ≈ −c_O S_OO⁻¹
//! hardly any of x_O is left:
//! ```text
//!   y = (a − μB) p + (c + μS) x                          whatever μ is, to the last bit.
//! ```
//! Each form has an interval for p in its box and lo ≤ x ≤ hi, and one by its slopes (`slopes.rs`); the sum with its
//! reactions r ≥ 0 has another. An output lies in all of them. Sums are of intervals, rounded outwards. What the elimination
//! of the mesh has rounded in Y, S and B is not known to a bound: 1e-12 of all terms is added for it.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

use super::affine::AffineOutput;
use super::enclosure::Enclosure;
use super::interval::{Interval, between};
use super::sides::Sides;
use super::slopes::Slopes;
use crate::condense::{CondensedModel, Measure};
use crate::reference::ReferenceError;

/// Part of an output's terms that the elimination of the mesh may have rounded: seen up to 1e-13, but for contrasts of 1e10
/// and more in one mesh, where it may be larger.
const ELIMINATION: f64 = 1e-12;

/// An interval for each output of `model` that holds its value at the solution for all inputs of the box: `sides` are
/// those of `model`. None for the error bound, and nothing at all where no enclosure is proved.
///
/// # Errors
/// Loads that are not finite.
pub fn intervals(
    model: &CondensedModel,
    sides: &Sides,
) -> Result<Option<Vec<Option<Interval>>>, ReferenceError> {
    let is_bounded = sides.inputs.iter().flatten().all(|end| end.is_finite());
    let nothing = Enclosure { lo: Vec::new(), hi: Vec::new(), reaction: Vec::new() };
    let enclosure = match &sides.enclosure {
        Some(enclosure) => enclosure,
        None if model.contact == 0 && is_bounded => &nothing,
        None => return Ok(None),
    };
    let slopes = Slopes::new(model, enclosure, &sides.inputs)?;
    let known = Known { model, enclosure, inputs: between(&sides.inputs), slopes };
    model.outputs.iter().map(|measure| known.output(measure)).collect::<Result<_, _>>().map(Some)
}

/// What is known of all solutions.
struct Known<'k> {
    model: &'k CondensedModel,
    enclosure: &'k Enclosure,
    inputs: Vec<Interval>,
    slopes: Option<Slopes<'k>>,
}

impl Known<'_> {
    fn output(&self, measure: &Measure) -> Result<Option<Interval>, ReferenceError> {
        match measure {
            Measure::Linear { of_inputs, of_contact } => {
                self.linear(of_inputs, of_contact, &[]).map(Some)
            }
            Measure::Flux { of_inputs, of_contact, of_reaction } => {
                self.linear(of_inputs, of_contact, of_reaction).map(Some)
            }
            Measure::Length { always, of_contact } => Ok(Some(self.length(*always, of_contact))),
            Measure::Saturated { .. } | Measure::Bound => Ok(None),
        }
    }

    fn linear(
        &self,
        of_inputs: &[f64],
        of_contact: &[f64],
        of_reaction: &[f64],
    ) -> Result<Interval, ReferenceError> {
        let own = AffineOutput {
            of_inputs: points(of_inputs, self.model.inputs),
            of_contact: points(of_contact, self.model.contact),
        };
        let mut range = self.with_reactions(&own, of_reaction);
        let mut sum = own;
        let touching =
            of_reaction.iter().enumerate().filter(|(at, _)| !self.enclosure.is_open(*at));
        touching.for_each(|(at, &weight)| sum.add(self.model, at, weight));
        let eliminated = self.eliminated(&sum);
        let x = self.enclosure.intervals();
        for form in [Some(sum), eliminated].iter().flatten() {
            range = range.and(form.within(&self.inputs, &x));
            if let Some(slopes) = &self.slopes {
                range = range.and(slopes.range(form)?);
            }
        }
        range = range.widened(ELIMINATION * self.terms(of_inputs, of_contact, of_reaction));
        // A force is a sum of reactions, none of which is negative.
        if of_inputs.is_empty() && of_contact.is_empty() && of_reaction.iter().all(|&r| r >= 0.0) {
            range = range.not_negative();
        }
        Ok(range)
    }

    /// The sizes of all that an output is summed from.
    fn terms(&self, of_inputs: &[f64], of_contact: &[f64], of_reaction: &[f64]) -> f64 {
        let p: Vec<f64> = self.inputs.iter().map(Interval::size).collect();
        let x = &self.enclosure.hi;
        let sizes = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a * b).abs()).sum::<f64>();
        let row = |(at, weight): (usize, &f64)| {
            let own = &self.model.matrix[at * self.model.contact..][..self.model.contact];
            let load: f64 = self.model.load.iter().zip(&p).map(|(b, p)| (b[at] * p).abs()).sum();
            weight.abs() * (sizes(own, x) + load)
        };
        let reactions: f64 = of_reaction.iter().enumerate().map(row).sum();
        sizes(of_inputs, &p) + sizes(of_contact, x) + reactions
    }

    /// Y_p p + Y_x x + Y_r r with r ≥ 0, and 0 where the edge is always open.
    fn with_reactions(&self, own: &AffineOutput, of_reaction: &[f64]) -> Interval {
        let x = self.enclosure.intervals();
        let reaction = |(at, &weight): (usize, &f64)| {
            if weight == 0.0 || self.enclosure.is_open(at) {
                return Interval::ZERO;
            }
            let mut row = AffineOutput::none(self.model);
            row.add(self.model, at, 1.0);
            Interval::point(weight) * row.within(&self.inputs, &x).not_negative()
        };
        let reactions = of_reaction.iter().enumerate().map(reaction);
        reactions.fold(own.within(&self.inputs, &x), |sum, reaction| sum + reaction)
    }

    /// The same with μ times the rows of O; nothing where S_OO is not positive definite to working precision.
    fn eliminated(&self, of: &AffineOutput) -> Option<AffineOutput> {
        let n = self.model.contact;
        let open: Vec<usize> = (0..n).filter(|&at| self.enclosure.is_open(at)).collect();
        if open.is_empty() {
            return None;
        }
        let entry = |i: usize, j: usize| self.model.matrix[open[i] * n + open[j]];
        let own = Mat::from_fn(open.len(), open.len(), entry);
        let middle = |of: Interval| 0.5 * of.lo + 0.5 * of.hi;
        let given = Mat::from_fn(open.len(), 1, |i, _| -middle(of.of_contact[open[i]]));
        let weights = own.llt(Side::Lower).ok()?.solve(given);
        let mut sum = of.clone();
        open.iter().enumerate().for_each(|(i, &at)| sum.add(self.model, at, weights[(i, 0)]));
        Some(sum)
    }

    /// All that always touches, and any part of what may.
    fn length(&self, always: f64, of_contact: &[f64]) -> Interval {
        let length = |(at, &length): (usize, &f64)| match () {
            () if self.enclosure.is_open(at) => Interval::ZERO,
            () if self.enclosure.is_touching(at) => Interval::point(length),
            () => Interval::between([0.0, length]),
        };
        let lengths = of_contact.iter().enumerate().map(length);
        lengths.fold(Interval::point(always), |sum, length| sum + length).not_negative()
    }
}

/// Numbers as intervals; zeros where there are none.
fn points(numbers: &[f64], length: usize) -> Vec<Interval> {
    match numbers.is_empty() {
        true => vec![Interval::ZERO; length],
        false => numbers.iter().copied().map(Interval::point).collect(),
    }
}
