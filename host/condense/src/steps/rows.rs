//! What a step leaves of its equation, cell by cell, as rows over what s, s_old and τ are made of.

use super::super::block::{Block, Functions};
use super::super::residual::points;
use signorini_certify::TermData;
use signorini_certify::cell::Cell;
use signorini_problem::Problem;
use signorini_problem::triangular::triangular;

/// The rows of k^{−½}R, R = f̄ − k(s − s_old) + ∇·τ, of the cells of a step that store something; the functions of s_old follow those of s.
/// Quads are parallelograms.
pub(super) fn storage(
    problem: &Problem,
    patterns: &[TermData],
    functions: &Functions,
) -> Vec<Block> {
    let of_cell = |at: usize| {
        let content = problem.loads.content(at);
        if content == 0.0 {
            return None;
        }
        let cell = Cell::of(problem, at);
        let (area, edges) = (cell.area(), problem.topology.edges_of(at));
        let k = content / area;
        let bubbles = functions.bubbles_of(edges);
        let vertices = problem.vertices_of(at);
        let own: Vec<u32> =
            vertices.iter().copied().chain(bubbles.iter().map(|&(_, function)| function)).collect();
        let old = own.iter().map(|function| function + functions.count() as u32);
        let out = edges.iter().enumerate().map(|(side, &edge)| {
            let first = problem.topology.first_side(edge as usize) == (at, side);
            if first { 1.0 / area } else { -1.0 / area }
        });
        let sources = patterns.iter().map(|pattern| pattern.loads().of_cell(at) / area);
        let rest: Vec<f64> = out.chain(sources).collect();
        let row = |(reference, weight): ([f64; 3], f64)| {
            let local = cell.local(reference);
            let factor = (weight * local.determinant / k).sqrt();
            let corners = local.vertices[..vertices.len()].iter().map(|of| of.value);
            let inside = bubbles.iter().map(|&(side, _)| local.sides[side].bubble().value);
            let values: Vec<f64> = corners.chain(inside).map(|value| factor * k * value).collect();
            let of_s = values.iter().map(|value| -value).chain(values.iter().copied());
            of_s.chain(rest.iter().map(|entry| factor * entry)).collect::<Vec<f64>>()
        };
        let rule = if at < problem.mesh.triangles.len() { 2 } else { 3 };
        let mut columns = vec![Vec::new(); 2 * own.len() + rest.len()];
        for point in points(&cell, rule, &[]) {
            columns.iter_mut().zip(row(point)).for_each(|(to, entry)| to.push(entry));
        }
        Some(Block {
            functions: own.iter().copied().chain(old).collect(),
            edges: edges.to_vec(),
            rows: triangular(columns),
        })
    };
    (0..problem.cells()).filter_map(of_cell).collect()
}
