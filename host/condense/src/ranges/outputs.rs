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
use crate::{CondensedModel, Measure};
use signorini_reference::ReferenceError;

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

/// Facts on all solutions.
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
            Measure::Length { always, of_contact } => {
                let may_touch = |at: usize| [self.enclosure.is_touching(at), true];
                let counts = |at| if self.side(at).is_some() { [false; 2] } else { may_touch(at) };
                Ok(Some(self.lengths(*always, of_contact, counts)))
            }
            Measure::Saturated { always, of_contact } => {
                let Enclosure { lo, .. } = self.enclosure;
                let may_be = |at: usize| !self.enclosure.is_touching(at) && lo[at] < 0.0;
                let counts = |at| [self.enclosure.is_saturated(at), may_be(at)];
                Ok(Some(self.lengths(*always, of_contact, counts)))
            }
            Measure::Bound => Ok(None),
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
        for (at, &weight) in of_reaction.iter().enumerate() {
            match self.side(at) {
                Some(side) => sum.add_end(self.model, at, side, weight),
                None => sum.add(self.model, at, weight),
            }
        }
        let eliminated = self.eliminated(&sum);
        let x = self.enclosure.intervals();
        for form in [Some(sum), eliminated].iter().flatten() {
            range = range.and(form.within(&self.inputs, &x));
            if let Some(slopes) = &self.slopes {
                range = range.and(slopes.range(form)?);
            }
        }
        range = range.widened(ELIMINATION * self.terms(of_inputs, of_contact, of_reaction));
        // A force is a sum of reactions, none of which is negative where the base is the lower end.
        let is_pressed = |(at, &weight): (usize, &f64)| {
            weight == 0.0
                || weight > 0.0 && self.model.end_columns(at)[0].iter().all(|&end| end == 0.0)
        };
        let are_pressed = of_reaction.iter().enumerate().all(is_pressed);
        if of_inputs.is_empty() && of_contact.is_empty() && are_pressed {
            range = range.not_negative();
        }
        Ok(range)
    }

    /// The sizes of all that an output is summed from.
    fn terms(&self, of_inputs: &[f64], of_contact: &[f64], of_reaction: &[f64]) -> f64 {
        let p: Vec<f64> = self.inputs.iter().map(Interval::size).collect();
        let x: Vec<f64> = self.enclosure.intervals().iter().map(Interval::size).collect();
        let x = &x;
        let sizes = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a * b).abs()).sum::<f64>();
        let row = |(at, weight): (usize, &f64)| {
            let own = &self.model.matrix[at * self.model.contact..][..self.model.contact];
            let load: f64 = self.model.load.iter().zip(&p).map(|(b, p)| (b[at] * p).abs()).sum();
            let ends = self.model.end_columns(at).concat();
            let ends = ends.iter().filter(|end| end.is_finite()).zip(p.iter().cycle());
            let ends: f64 = ends.map(|(end, p)| (end * p).abs()).sum();
            weight.abs() * (sizes(own, x) + load + ends)
        };
        let reactions: f64 = of_reaction.iter().enumerate().map(row).sum();
        sizes(of_inputs, &p) + sizes(of_contact, x) + reactions
    }

    /// Y_p p + Y_x x + Y_r r with r within its ends, and at one of them where the edge is always on one side.
    fn with_reactions(&self, own: &AffineOutput, of_reaction: &[f64]) -> Interval {
        let x = self.enclosure.intervals();
        let reaction = |(at, &weight): (usize, &f64)| {
            if weight == 0.0 {
                return Interval::ZERO;
            }
            let Some(side) = self.side(at) else {
                let r = AffineOutput::row(self.model, at).within(&self.inputs, &x);
                return Interval::point(weight) * self.admissible(at, r);
            };
            let mut end = AffineOutput::none(self.model);
            end.add_end(self.model, at, side, 1.0);
            Interval::point(weight) * end.within(&self.inputs, &x)
        };
        let reactions = of_reaction.iter().enumerate().map(reaction);
        reactions.fold(own.within(&self.inputs, &x), |sum, reaction| sum + reaction)
    }

    /// Output with μ times the rows of O less their ends; `None` where S_OO is not positive definite to working precision.
    fn eliminated(&self, of: &AffineOutput) -> Option<AffineOutput> {
        let n = self.model.contact;
        let open: Vec<usize> = (0..n).filter(|&at| self.side(at).is_some()).collect();
        if open.is_empty() {
            return None;
        }
        let entry = |i: usize, j: usize| self.model.matrix[open[i] * n + open[j]];
        let own = Mat::from_fn(open.len(), open.len(), entry);
        let middle = |of: Interval| 0.5 * of.lo + 0.5 * of.hi;
        let given = Mat::from_fn(open.len(), 1, |i, _| -middle(of.of_contact[open[i]]));
        let weights = own.llt(Side::Lower).ok()?.solve(given);
        let mut sum = of.clone();
        for (i, &at) in open.iter().enumerate() {
            let weight = weights[(i, 0)];
            sum.add(self.model, at, weight);
            sum.add_end(self.model, at, self.side(at)?, -weight);
        }
        Some(sum)
    }

    /// All that counts in any case, and any part of what may; `counts` tells of an edge which of both it is, if either.
    fn lengths(
        &self,
        always: f64,
        of_contact: &[f64],
        counts: impl Fn(usize) -> [bool; 2],
    ) -> Interval {
        let length = |(at, &length): (usize, &f64)| match counts(at) {
            [true, _] => Interval::point(length),
            [false, true] => Interval::between([0.0, length]),
            [false, false] => Interval::ZERO,
        };
        let lengths = of_contact.iter().enumerate().map(length);
        lengths.fold(Interval::point(always), |sum, length| sum + length).not_negative()
    }

    /// The end of r on an edge that is always on one side: 0 where it is open, 1 where it is at its limit.
    fn side(&self, at: usize) -> Option<usize> {
        let is_saturated = || self.enclosure.is_saturated(at);
        if self.enclosure.is_open(at) { Some(0) } else { is_saturated().then_some(1) }
    }

    /// Part of an interval of r that lies between the ends that inputs may make.
    fn admissible(&self, at: usize, r: Interval) -> Interval {
        let [least, greatest] = self.model.ends_within(at, &self.inputs);
        let lo = if least.lo == f64::NEG_INFINITY { r.lo } else { r.lo.max(least.lo) };
        Interval { lo, hi: if greatest.hi == f64::INFINITY { r.hi } else { r.hi.min(greatest.hi) } }
    }
}

/// Numbers as intervals; zeros where there are none.
fn points(numbers: &[f64], length: usize) -> Vec<Interval> {
    match numbers.is_empty() {
        true => vec![Interval::ZERO; length],
        false => numbers.iter().copied().map(Interval::point).collect(),
    }
}
