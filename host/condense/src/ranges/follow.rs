//! Proofs for all inputs where one of them changes a transfer coefficient, so that the matrix follows it.
//!
//! The range of that input is cut into pieces. In a piece the model is the one of its middle, but for what modes change:
//! ```text
//!   S(δ) x − B(δ) p = S_m x − B_m p − ε,      |ε_i| ≤ change of row i for all p and x of the piece.
//! ```
//! So ε are n inputs more of a model with one matrix, and so is what every output changes by. T maps y to the solution for
//! the ε that y makes; it is continuous. Where T maps a box of x into itself, it has a fixed point there (Brouwer), which is the
//! solution, since there is one alone. The box is proposed by the middle of the piece, widened, and checked.

use super::change::Change;
use super::enclosure::{Enclosure, EndBox};
use super::interval::{Interval, between};
use super::outputs::intervals;
use super::sides::{EdgeSide, Sides, widened};
use super::split::Split;
use crate::model::sum;
use crate::{CondensedModel, ModalModel};
use signorini_reference::ReferenceError;

/// Pieces to begin with, and how often one is halved that is not proved.
const PIECES: usize = 64;
const HALVINGS: u32 = 6;
/// How often a box is proposed, and then made smaller.
const PROPOSALS: u32 = 6;
const REFINED: u32 = 2;
/// A box is proposed so much wider than what was found, as a part of the largest x.
const ROOM: f64 = 1.0 / 16.0;
/// Entries off the diagonal that are positive by less than this part of both diagonals are rounding.
const ROUNDING: f64 = 1e-12;

/// Findings proved of a model of modes for all inputs within their ranges.
#[derive(Debug, Clone)]
pub struct FollowedRanges {
    /// The sides of its edges; all are kept.
    pub sides: Sides,
    /// Where each output lies; none for the error bound.
    pub outputs: Vec<Option<Interval>>,
    /// Pieces of the coefficient's range that the proof took.
    pub pieces: usize,
}

impl FollowedRanges {
    /// Nothing where a range is infinite, contact alone holds a part, or N of the matrix is no M-matrix somewhere.
    ///
    /// # Errors
    /// Loads that are not finite.
    pub fn new(modes: &ModalModel) -> Result<Option<Self>, ReferenceError> {
        let is_bounded = modes.model.ranges[..modes.inputs].iter().flatten().all(|p| p.is_finite());
        let [lo, hi] = modes.model.ranges[modes.input];
        if !is_bounded || lo > hi || !modes.model.held_by_contact.is_empty() {
            return Ok(None);
        }
        let mut waiting = pieces(modes, [lo, hi]);
        let mut whole: Option<Self> = None;
        while let Some((range, halvings)) = waiting.pop() {
            let piece = match Piece::new(modes, range) {
                Some(piece) => piece.proved()?,
                None => return Ok(None),
            };
            match piece {
                Some(found) => whole = Some(found.and(whole)),
                None if halvings == 0 => return Ok(None),
                None => {
                    let middle = 0.5 * range[0] + 0.5 * range[1];
                    waiting.push(([range[0], middle], halvings - 1));
                    waiting.push(([middle, range[1]], halvings - 1));
                }
            }
        }
        Ok(whole.map(|whole| whole.of_all(modes)))
    }

    /// Findings that hold in this piece and in others.
    fn and(self, others: Option<Self>) -> Self {
        let Some(others) = others else { return self };
        let Some((own, other)) = self.sides.enclosure.as_ref().zip(others.sides.enclosure.as_ref())
        else {
            return others;
        };
        let join = |a: &[f64], b: &[f64], of: fn(f64, f64) -> f64| {
            a.iter().zip(b).map(|(&a, &b)| of(a, b)).collect::<Vec<f64>>()
        };
        let enclosure = Enclosure {
            lo: join(&own.lo, &other.lo, f64::min),
            hi: join(&own.hi, &other.hi, f64::max),
            reaction: join(&own.reaction, &other.reaction, f64::min),
        };
        let side = |(&a, &b): (&EdgeSide, &EdgeSide)| if a == b { a } else { EdgeSide::MayChange };
        let of = self.sides.of.iter().zip(&others.sides.of).map(side).collect();
        let hull =
            |(a, b): (&Option<Interval>, &Option<Interval>)| a.zip(*b).map(|(a, b)| a.hull(b));
        let outputs = self.outputs.iter().zip(&others.outputs).map(hull).collect();
        let sides = Sides { of, enclosure: Some(enclosure), ..others.sides };
        Self { sides, outputs, pieces: self.pieces + others.pieces }
    }

    /// Findings in terms of the model whose inputs are those of the scene; no x is held back, and no edge is taken out.
    fn of_all(self, modes: &ModalModel) -> Self {
        let mut model = modes.in_own_scale(modes.model.defaults[modes.input]);
        model.ranges = modes.model.ranges[..modes.inputs].to_vec();
        let Sides { of, enclosure, .. } = self.sides;
        Self { sides: Sides { of, enclosure, ..Sides::unproved(&model) }, ..self }
    }
}

/// Pieces of equal change of the softest mode, δ/(1 + δν).
fn pieces(modes: &ModalModel, [lo, hi]: [f64; 2]) -> Vec<([f64; 2], u32)> {
    let softest = modes.compliance.iter().fold(0.0, |most: f64, nu| most.max(*nu));
    if lo == hi {
        return vec![([lo, hi], 0)];
    }
    let change = hi - modes.origin;
    let most = change / (1.0 + change * softest);
    let end = |at: usize| match at {
        0 => lo,
        PIECES => hi,
        _ => {
            let gain = most * at as f64 / PIECES as f64;
            (modes.origin + gain / (1.0 - gain * softest)).clamp(lo, hi)
        }
    };
    (0..PIECES).map(|at| ([end(at), end(at + 1)], HALVINGS)).collect()
}

/// A piece of the coefficient's range.
struct Piece<'p> {
    modes: &'p ModalModel,
    range: [f64; 2],
    middle: f64,
    /// The model there with n inputs more, and one for each output.
    model: CondensedModel,
    /// Entries of each row that were positive off the diagonal, and are 0 in the model.
    cut: Vec<Vec<f64>>,
    split: Split,
}

impl<'p> Piece<'p> {
    /// Nothing where N is no M-matrix.
    fn new(modes: &'p ModalModel, range: [f64; 2]) -> Option<Self> {
        let middle = 0.5 * range[0] + 0.5 * range[1];
        let mut model = modes.in_own_scale(middle);
        model.ranges = widened(&model.ranges);
        model.ranges[modes.input] = range;
        let cut = without_rounding(&mut model);
        let split = Split::new(&model.matrix, model.contact)?;
        extend(&mut model);
        Some(Self { modes, range, middle, model, cut, split })
    }

    /// Findings proved of it; `None` where no box was found.
    fn proved(mut self) -> Result<Option<FollowedRanges>, ReferenceError> {
        let mut x = vec![Interval::ZERO; self.model.contact];
        for _ in 0..PROPOSALS {
            let found = self.enclosed(&x)?.map(|found| found.intervals());
            let Some(found) = found else { return Ok(None) };
            if x.iter().zip(&found).all(|(x, found)| x.lo <= found.lo && found.hi <= x.hi) {
                return self.refined(found);
            }
            x = wider(&x, &found);
        }
        Ok(None)
    }

    /// Every box that holds the solution makes a smaller one.
    fn refined(&mut self, mut x: Vec<Interval>) -> Result<Option<FollowedRanges>, ReferenceError> {
        for _ in 1..REFINED {
            if let Some(found) = self.enclosed(&x)? {
                x = found.intervals();
            }
        }
        let Some(enclosure) = self.enclosed(&x)? else { return Ok(None) };
        let inputs = self.model.ranges.clone();
        let sides = Sides::proposed(&self.model, enclosure, inputs);
        let found = intervals(&self.model, &sides)?;
        Ok(found.map(|outputs| FollowedRanges { sides, outputs, pieces: 1 }))
    }

    /// Where solutions are for the ε that p and x within these make.
    fn enclosed(&mut self, x: &[Interval]) -> Result<Option<Enclosure>, ReferenceError> {
        let (m, n) = (self.modes.inputs, self.model.contact);
        let p = between(&self.model.ranges[..m]);
        let change = Change::new(self.modes, self.middle, self.range, [&p, x]);
        let cut = |row: &[f64]| row.iter().zip(x).map(|(entry, x)| entry * x.size()).sum::<f64>();
        let rows = (0..n).map(|at| change.of_row(at) + cut(&self.cut[at]));
        let outputs = self.modes.model.outputs.iter().map(|measure| change.of_output(measure));
        let ends = rows.chain(outputs).map(|by| by * (1.0 + ROUNDING));
        let ends: Vec<[f64; 2]> = ends.map(|by| [-by, by]).collect();
        if ends.iter().flatten().any(|end| !end.is_finite()) {
            return Ok(None);
        }
        self.model.ranges[m..].copy_from_slice(&ends);
        let found = Enclosure::new(&self.split, &EndBox::new(&self.model, &self.model.ranges))?;
        Ok(found.filter(Enclosure::is_finite))
    }
}

/// Rounding above 0 off the diagonal becomes 0; what it was.
fn without_rounding(model: &mut CondensedModel) -> Vec<Vec<f64>> {
    let n = model.contact;
    let roots: Vec<f64> = (0..n).map(|i| model.matrix[i * n + i].sqrt()).collect();
    let mut cut = vec![vec![0.0; n]; n];
    for (at, entry) in model.matrix.iter_mut().enumerate() {
        let (i, j) = (at / n, at % n);
        if i != j && *entry > 0.0 && *entry <= ROUNDING * roots[i] * roots[j] {
            cut[i][j] = *entry;
            *entry = 0.0;
        }
    }
    cut
}

/// An input for every row, whose load is 1 there, and one for every output that is a sum.
fn extend(model: &mut CondensedModel) {
    let (m, n, outputs) = (model.inputs, model.contact, model.outputs.len());
    let of_row = |at: usize| (0..n).map(|i| if i == at { 1.0 } else { 0.0 }).collect();
    model.load.extend((0..n).map(of_row));
    model.load.extend(vec![vec![0.0; n]; outputs]);
    model.inputs = m + n + outputs;
    if model.is_limited() {
        model.spans.resize(model.inputs, vec![0.0; n]);
    }
    model.defaults.resize(model.inputs, 0.0);
    model.ranges.resize(model.inputs, [0.0, 0.0]);
    for (at, measure) in model.outputs.iter_mut().enumerate() {
        let Some((of_inputs, ..)) = sum(measure) else { continue };
        // What is a sum of reactions alone stays one.
        if !of_inputs.is_empty() {
            of_inputs.resize(m, 0.0);
            of_inputs.resize(m + n + outputs, 0.0);
            of_inputs[m + n + at] = 1.0;
        }
    }
}

/// Intervals that hold both, and more.
fn wider(a: &[Interval], b: &[Interval]) -> Vec<Interval> {
    let largest = b.iter().fold(0.0, |most: f64, x| most.max(x.size()));
    a.iter().zip(b).map(|(a, b)| a.hull(*b).widened(ROOM * largest)).collect()
}
