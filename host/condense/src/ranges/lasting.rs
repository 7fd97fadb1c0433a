//! Sides and openings that hold in every step, whatever inputs within their ranges have been.
//!
//! With the sums over all lags (`History`), P the positive entries of S_k off the diagonal, and
//! ```text
//!   N = S_k − Σ(H_i)⁺ − P,    ν = Σ(H_i)⁻:    hi = LCP(N, b_hi − (ν + P) lo),    lo = LCP(N, b_lo − (ν + P) hi)
//! ```
//! bound all openings for ever, once N is an M-matrix: with a past between lo and hi the load is at most b_hi + Σ(H_i)⁺ hi − ν lo. For x̂
//! between them, LCP(S_k − P, load − Px̂) is so too. The fixed point of that map is the answer, since S_k is positive definite.
//!
//! Such pairs begin with lo = 0. Where fluxes have limits x has either sign, and they begin with −h and h, (N − ν − P) h = |b|. A steady
//! start is within: steps with fixed inputs lead there from within. A stated one has to be, and what it leaves is counted in b.
//!
//! What rounding leaves of a row is a load in every step, and drifts as far as S = S_k − H lets it. So b has e more on either side, a part
//! of all terms that the box allows for.

use faer::{MatRef, Side};

use super::enclosure::{Enclosure, EndBox, STEPS, minus, rooms};
use super::history::History;
use super::sides::Sides;
use super::split::{Split, product};
use crate::{Memory, SteppedModel};
use signorini_reference::ReferenceError;

/// Part of the largest opening by which rounding may put a steady start off.
const ROUNDING: f64 = 1e-9;

/// By how much more than a box needs its loads are widened for the next one.
const GROWTH: f64 = 1.25;

/// Why nothing is proved of all steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unproved {
    /// An input has no range.
    NoRange,
    /// N is not proved to be positive definite, or S_k is not.
    Indefinite,
    /// Fluxes have limits, and N − ν − P is not proved to be positive definite.
    IndefiniteWithLimits,
    /// A stated start is not within the box.
    Start,
    /// Rounding may lead out of any box that was tried.
    Rounding,
    /// The box overflows.
    Overflow,
}

/// The sides of all contact edges in all steps of a model that remembers `memory`; `kept` says that every edge is. Every row and state may
/// be off by the part `rounding` of all its terms in each step.
///
/// # Errors
/// Loads that are not finite.
pub fn lasting(
    of: &SteppedModel,
    memory: &Memory,
    rounding: f64,
) -> Result<Result<Sides, Unproved>, ReferenceError> {
    let (model, n) = (&of.model, of.model.contact);
    if !model.ranges[..of.inputs].iter().flatten().all(|end| end.is_finite()) {
        return Ok(Err(Unproved::NoRange));
    }
    let history = History::new(of, memory);
    let [pull, push] = history.parts();
    let is_definite = MatRef::from_row_major_slice(&model.matrix, n, n).llt(Side::Lower).is_ok();
    let split = Split::of(pull, push, n).filter(|_| is_definite);
    let Some(split) = split else { return Ok(Err(Unproved::Indefinite)) };
    let loads = history.loads();
    let lasting = Lasting { n, is_limited: model.is_limited(), history, split };
    let found = lasting.rounded(&loads, rounding)?;
    Ok(found.map(|enclosure| {
        let every = Sides::unproved(model);
        let sides = Sides::proposed(model, enclosure, every.inputs.clone());
        Sides { kept: every.kept, limits: every.limits, ..sides }
    }))
}

/// The problem that bounds all steps.
struct Lasting<'h> {
    n: usize,
    is_limited: bool,
    history: History<'h>,
    /// N, and ν + P.
    split: Split,
}

impl Lasting<'_> {
    /// Where x lies in every step with these loads, all of which may be off by what rounds.
    fn rounded(
        &self,
        loads: &EndBox,
        rounding: f64,
    ) -> Result<Result<Enclosure, Unproved>, ReferenceError> {
        let mut off = vec![0.0; self.n];
        for _ in 0..STEPS {
            let found = match self.enclosure(&loads.widened(&off))? {
                Ok(found) => found,
                Err(why) => return Ok(Err(why)),
            };
            let needed = self.history.rounded(&found, rounding);
            if needed.iter().zip(&off).all(|(needed, off)| needed <= off) {
                return Ok(Ok(found));
            }
            off = needed.iter().map(|needed| GROWTH * needed).collect();
        }
        Ok(Err(Unproved::Rounding))
    }

    /// Where x lies in every step with these loads.
    fn enclosure(&self, loads: &EndBox) -> Result<Result<Enclosure, Unproved>, ReferenceError> {
        let begin = match self.is_limited {
            true => self.linear(loads)?,
            false => Some([vec![0.0; self.n], vec![f64::INFINITY; self.n]]),
        };
        let Some([lo, hi]) = begin else { return Ok(Err(Unproved::IndefiniteWithLimits)) };
        let begin = Enclosure { lo, hi, reaction: vec![0.0; self.n] };
        let mut now = begin.shrunk(&self.split, loads, |lo| self.above(loads, lo))?;
        if !now.is_finite() {
            return Ok(Err(Unproved::Overflow));
        }
        if !self.holds_the_start(&now) {
            return Ok(Err(Unproved::Start));
        }
        now.reaction = self.rooms(&now, loads);
        // From w to openings.
        now.lo = minus(&now.lo, &self.history.moves);
        if !self.is_limited {
            now.lo.iter_mut().for_each(|lo| *lo = lo.max(0.0));
        }
        Ok(Ok(now))
    }

    /// The upper solution with the gap at its highest.
    fn above(&self, loads: &EndBox, lo: &[f64]) -> Result<Vec<f64>, ReferenceError> {
        let EndBox { least, greatest } = loads;
        let [push, _] = self.split.push(lo);
        let moves = &self.history.moves;
        let of_gap = self.split.negative.chunks(self.n.max(1)).map(|row| {
            let (sum, noise) = product(row, moves);
            sum - noise
        });
        let off: Vec<f64> = push.iter().zip(of_gap).map(|(push, gap)| push + gap).collect();
        let above = self.split.above(&minus(&least.hi, &off), &minus(&greatest.hi, &off))?;
        Ok(above.iter().zip(moves).map(|(x, moves)| (x + moves).next_up()).collect())
    }

    /// −h and h; nothing where N − ν − P is not proved to be an M-matrix.
    fn linear(&self, loads: &EndBox) -> Result<Option<[Vec<f64>; 2]>, ReferenceError> {
        let rest = minus(&self.split.negative, &self.split.positive);
        let Some(split) = Split::of(rest.clone(), vec![0.0; self.n * self.n], self.n) else {
            return Ok(None);
        };
        let EndBox { least, greatest } = loads;
        let size = |end: f64| if end.is_finite() { end.abs() } else { 0.0 };
        let moves = &self.history.moves;
        let load = |(at, row): (usize, &[f64])| {
            let (sum, noise) = product(row, moves);
            size(least.hi[at]).max(size(greatest.lo[at])) - sum + noise
        };
        let loads: Vec<f64> = rest.chunks(self.n.max(1)).enumerate().map(load).collect();
        let above = split.above(&loads, &vec![f64::INFINITY; self.n])?;
        let h: Vec<f64> = above.iter().zip(moves).map(|(x, moves)| (x + moves).next_up()).collect();
        Ok(Some([h.iter().map(|h| -h).collect(), h]))
    }

    /// Whether the start is within, a steady one but for rounding.
    fn holds_the_start(&self, of: &Enclosure) -> bool {
        let largest = of.lo.iter().chain(&of.hi).fold(0.0, |most: f64, x| most.max(x.abs()));
        let room = if self.history.is_steady() { ROUNDING * largest } else { 0.0 };
        let begin = self.history.begin();
        let mut ends = begin.iter().zip(of.lo.iter().zip(&of.hi));
        ends.all(|(x, (lo, hi))| lo - room <= *x && *x <= hi + room)
    }

    /// At most the way from the residual of an edge, where u = ψ is taken, to either end; none where the gap moves.
    fn rooms(&self, of: &Enclosure, loads: &EndBox) -> Vec<f64> {
        let rows = self.split.negative.chunks(self.n.max(1)).enumerate().map(|(at, row)| {
            let mut row = row.to_vec();
            // Of the edge itself its past alone.
            row[at] = -self.history.forward[at * self.n + at];
            row
        });
        let ([down, _], [_, up]) = (self.split.push(&of.lo), self.split.push(&of.hi));
        let rooms = rooms(rows, [&down, &up], of, loads);
        let moves = self.history.moves.iter();
        rooms
            .iter()
            .zip(moves)
            .map(|(&room, &moves)| if moves > 0.0 { 0.0 } else { room })
            .collect()
    }
}
