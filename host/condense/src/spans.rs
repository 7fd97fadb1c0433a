//! Spans of contact fluxes, pattern by pattern: from the base, which loads contain, to the other end.

use signorini_certify::TermData;
use signorini_problem::{Problem, spread};

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

/// Why a model whose ends inputs change has no bound: hi − lo varies along an edge.
pub(super) fn varies(problem: &Problem, patterns: &[TermData]) -> Option<String> {
    let input = problem.scene.limit_input()?;
    let counts = problem.topology.counts;
    let varies = |edge: usize| {
        patterns.iter().any(|pattern| spread(&pattern.problem, edge, problem.time).is_some())
    };
    let edge = (counts.free..counts.unknowns()).find(|&edge| varies(edge))?;
    let [a, b] = problem.segment(edge);
    let [x, y] = [0, 1].map(|k| 0.5 * (a[k] + b[k]));
    Some(format!(
        "limit − flux varies along the edge around ({x}, {y}), and input.{} changes an end of a flux: what the bound misses \
         there is not known for all inputs",
        input.name.value
    ))
}

/// By how much |E| (hi − lo) exceeds its mean somewhere on an edge, times the d of its unknown, at most.
pub(super) fn excess(problem: &Problem, edges: &[usize], openings: &[f64]) -> f64 {
    let free = problem.topology.counts.free;
    let of_edge = |(edge, opening): (&usize, &f64)| {
        spread(problem, free + edge, problem.time).map_or(0.0, |spread| spread.excess * opening)
    };
    edges.iter().zip(openings).map(of_edge).fold(0.0, f64::max)
}
