//! The connected components of the matrix graph that nothing holds but contact.

use super::problem::Matrix;

/// The contact unknowns (numbered within C) of each component with a `floating` one.
pub(super) fn floating_components(matrix: &Matrix, floating: &[bool]) -> Vec<Vec<usize>> {
    let mut visited = vec![false; if floating.is_empty() { 0 } else { matrix.unknowns() }];
    let seeds = floating.iter().enumerate().filter(|&(_, &floats)| floats);
    seeds
        .map(|(contact, _)| contact_reached_from(matrix, matrix.free + contact, &mut visited))
        .filter(|component| !component.is_empty())
        .collect()
}

/// The unvisited contact unknowns that a walk through the graph of K reaches.
fn contact_reached_from(matrix: &Matrix, seed: usize, visited: &mut [bool]) -> Vec<usize> {
    let mut reached = Vec::new();
    let mut pending = Vec::new();
    let mut visit = |unknown: usize, pending: &mut Vec<usize>| {
        if !std::mem::replace(&mut visited[unknown], true) {
            pending.push(unknown);
        }
    };
    visit(seed, &mut pending);
    while let Some(unknown) = pending.pop() {
        reached.extend(unknown.checked_sub(matrix.free));
        for &neighbour in matrix.columns(unknown) {
            visit(neighbour as usize, &mut pending);
        }
    }
    reached
}
