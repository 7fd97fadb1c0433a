//! Whether refinement still pays: how fast the bound falls with the number of unknowns.
//!
//! With first-order elements the bound falls like N^(−½) where cells follow the solution. A slope flatter than −1/12 over the
//! last levels, while N has doubled twice, is a stall: data that no mesh of this size resolves, rounding, or a solver that stopped.

use super::Level;
use super::indicators::{oscillations, squares};
use crate::certify::cell::Cell;
use signorini_scene::error::Result;

/// The flattest slope of the bound that goes on.
const FLATTEST: f64 = 1.0 / 12.0;
/// Over how large a growth of N it is measured.
const GROWTH: f64 = 4.0;

/// Which term of the bound no longer falls, and where it is largest.
#[derive(Debug, Clone, PartialEq)]
pub struct Stall {
    /// The largest term of the bound.
    pub term: Term,
    /// The middle of the cell in which it is largest.
    pub at: [f64; 2],
}

/// A term of the error bound.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Term {
    /// What s and τ are apart.
    Gap,
    /// What f, g and q leave out.
    Oscillation,
    /// What rounding can have hidden.
    Rounding,
    /// What the solver left.
    Algebraic,
}

impl Term {
    /// What it is, in words.
    pub fn sentence(self) -> &'static str {
        match self {
            Self::Gap => "the gap between s and τ, as where data jump inside cells",
            Self::Oscillation => "the oscillation of data that the mesh does not resolve",
            Self::Rounding => "rounding",
            Self::Algebraic => "what the solver left unfinished",
        }
    }
}

/// N and bound of all levels so far.
#[derive(Debug, Default)]
pub(super) struct History(Vec<[f64; 2]>);

impl History {
    /// Adds a level; why it is no use to go on, if so.
    pub fn stalled(&mut self, level: &Level) -> Result<Option<Stall>> {
        let Some(bound) = level.solution.bound else { return Ok(None) };
        let now = [level.problem.topology.counts.unknowns() as f64, bound.total];
        self.0.push(now);
        let is_far = |before: &&[f64; 2]| now[0] >= GROWTH * before[0];
        let Some(before) = self.0.iter().rev().find(is_far) else { return Ok(None) };
        let slope = (before[1] / now[1]).ln() / (now[0] / before[0]).ln();
        if slope >= FLATTEST {
            return Ok(None);
        }
        worst(level).map(Some)
    }
}

/// The largest term, and the cell that has most of it.
fn worst(level: &Level) -> Result<Stall> {
    let Level { problem, solution, .. } = level;
    let bound = solution.bound.unwrap_or_default();
    let terms = [
        (Term::Gap, (bound.duality_gap.powi(2) - bound.algebraic.powi(2)).max(0.0).sqrt()),
        (Term::Oscillation, 2.0 * bound.oscillation),
        (Term::Rounding, bound.rounding),
        (Term::Algebraic, bound.algebraic),
    ];
    let (term, _) = terms.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or(terms[0]);
    let of_cells = match term {
        Term::Oscillation => oscillations(problem)?,
        Term::Gap | Term::Rounding | Term::Algebraic => squares(problem, solution)?,
    };
    let largest = (0..of_cells.len()).max_by(|&a, &b| of_cells[a].total_cmp(&of_cells[b]));
    Ok(Stall { term, at: Cell::of(problem, largest.unwrap_or(0)).middle() })
}
