//! The law of contact in a condensed model: what r̂ may be on each edge, and what it is nearest to.
//!
//! ```text
//!   x > 0:  τ = least        x = 0:  least ≤ τ ≤ greatest        x < 0:  τ = greatest
//! ```
//! both ends being counted from the base that the load contains. Without limits they are 0 and ∞. Spans lead from the base to the
//! other end, pattern by pattern.

use super::CondensedModel;
use signorini_certify::TermData;
use signorini_problem::{Problem, excess_within_ranges};
use signorini_reference::ReferenceError;

impl CondensedModel {
    /// Whether any flux has a limit.
    pub fn is_limited(&self) -> bool {
        !self.spans.is_empty()
    }

    /// Whether an input changes an end of a flux that has a limit.
    pub fn is_varying(&self) -> bool {
        is_varying(&self.spans)
    }

    /// From the base of each edge to the other end of its flux; nothing where all are ∞. In a varying model a finite one is 0
    /// where the inputs put the upper end below the lower one: by more than rounding they are refused.
    pub fn span_of(&self, p: &[f64]) -> Vec<f64> {
        let Some((constant, others)) = self.spans.split_first() else { return Vec::new() };
        let is_varying = self.is_varying();
        let of_edge = |(at, &constant): (usize, &f64)| {
            let terms = || others.iter().zip(&p[1..]).map(|(column, p)| column[at] * p);
            let sum = terms().fold(constant, |sum, term| sum + term);
            if is_varying && sum.is_finite() { sum.max(0.0) } else { sum }
        };
        constant.iter().enumerate().map(of_edge).collect()
    }

    /// Whether the load of an edge contains the upper end of its flux.
    fn is_from_above(&self, at: usize) -> bool {
        let constant = self.spans.first().and_then(|spans| spans.get(at)).copied();
        is_from_above(constant.unwrap_or(f64::INFINITY), self.is_varying())
    }

    /// The least and the greatest r̂ of an edge as m factors of p; an infinite one stands in the first, with 0 in the others.
    pub fn end_columns(&self, at: usize) -> [Vec<f64>; 2] {
        let zero = vec![0.0; self.inputs];
        let mut span: Vec<f64> = self.spans.iter().map(|column| column[at]).collect();
        if span.is_empty() {
            span = zero.clone();
            span[0] = f64::INFINITY;
        }
        if self.is_from_above(at) { [span, zero] } else { [zero, span] }
    }

    /// The least and the greatest r̂ of each edge.
    pub fn ends_of(&self, p: &[f64]) -> Vec<[f64; 2]> {
        if !self.is_limited() {
            return vec![[0.0, f64::INFINITY]; self.contact];
        }
        let ends = |span: f64| if span < 0.0 { [span, 0.0] } else { [0.0, span] };
        self.span_of(p).into_iter().map(ends).collect()
    }

    /// Refuses inputs that put an upper end below the lower one, or whose loads no fluxes within their ranges can balance
    /// where contact alone holds a part.
    pub(super) fn check_ends(&self, p: &[f64]) -> Result<(), ReferenceError> {
        if !self.is_limited() {
            return Ok(());
        }
        if self.rooms.iter().any(|room| room.view().check(&p[1..]).is_err()) {
            return Err(ReferenceError::Malformed("a limit lies below the flux at these inputs"));
        }
        let (load, ends) = (self.load_of(p), self.ends_of(p));
        for part in &self.held_by_contact {
            let sum = |end: usize| -> f64 {
                part.iter().map(|&at| (load[at] + ends[at][end]) / self.opening[at]).sum()
            };
            if sum(0) >= 0.0 || sum(1) <= 0.0 {
                return Err(ReferenceError::Unbounded { unknown: part[0] });
            }
        }
        Ok(())
    }
}

/// Whether an input changes one of these spans.
pub(super) fn is_varying(spans: &[Vec<f64>]) -> bool {
    spans.iter().skip(1).flatten().any(|&span| span != 0.0)
}

/// Whether the base of an edge with this constant of its span is the upper end of its flux.
pub(super) fn is_from_above(constant: f64, is_varying: bool) -> bool {
    constant == f64::NEG_INFINITY || constant < 0.0 && !is_varying
}

/// The admissible r̂ of an edge that is nearest. An x on a side that there is not counts as on the other.
pub(super) fn nearest(r: f64, x: f64, [least, greatest]: [f64; 2]) -> f64 {
    if x == 0.0 {
        return r.max(least).min(greatest);
    }
    let [own, other] = if x > 0.0 { [least, greatest] } else { [greatest, least] };
    if own.is_finite() { own } else { other }
}

/// The spans of every pattern, contact edge by contact edge: nothing where all are ∞.
pub(super) fn spans(patterns: &[TermData]) -> Vec<Vec<f64>> {
    match patterns.first() {
        Some(constant) if !constant.loads().spans.is_empty() => {
            patterns.iter().map(|pattern| pattern.spans.clone()).collect()
        }
        _ => Vec::new(),
    }
}

/// In the order of the unknowns and the unit of r̂, so many columns: those beyond the patterns of the scene are 0.
pub(super) fn in_unknowns(
    spans: &[Vec<f64>],
    edges: &[usize],
    openings: &[f64],
    count: usize,
) -> Vec<Vec<f64>> {
    if spans.is_empty() {
        return Vec::new();
    }
    let of_edges = |spans: &Vec<f64>| {
        edges.iter().zip(openings).map(|(&edge, opening)| opening * spans[edge]).collect()
    };
    let mut columns: Vec<Vec<f64>> = spans.iter().map(of_edges).collect();
    columns.resize(count, vec![0.0; edges.len()]);
    columns
}

/// By how much |E| (hi − lo) exceeds its mean somewhere on an edge, whatever inputs are within their ranges, times the d of its
/// unknown, at most.
pub(super) fn excess(problem: &Problem, edges: &[usize], openings: &[f64]) -> f64 {
    let free = problem.topology.counts.free;
    let of_edge = |(edge, opening): (&usize, &f64)| {
        excess_within_ranges(problem, free + edge).map_or(0.0, |excess| excess * opening)
    };
    edges.iter().zip(openings).map(of_edge).fold(0.0, f64::max)
}
