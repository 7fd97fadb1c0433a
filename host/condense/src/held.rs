//! Parts of the domain that contact alone holds.

use std::collections::BTreeMap;

use signorini_kernel::mesh::components::Support;

use signorini_problem::{Parts, Problem};
use signorini_scene::error::{Error, InputError};
use signorini_scene::scene::Scene;

/// The cells of the one part that contact alone holds, where there is exactly one.
pub(super) fn held_alone(problem: &Problem, parts: &Parts, edges: &[usize]) -> Option<Vec<bool>> {
    if parts.counts.contact != 1 {
        return None;
    }
    let topology = problem.topology.edges().ok()?;
    let free = problem.topology.counts.free;
    let of_edge = edges.iter().map(|edge| parts.of_edge(&topology, free + edge));
    let part = of_edge.into_iter().find(|&part| parts.support(part) == Support::Contact)?;
    Some((0..problem.cells()).map(|cell| parts.of_cell(cell) == part).collect())
}

/// Unknowns by the parts that they alone hold.
pub(super) fn held_by_contact(
    problem: &Problem,
    parts: &Parts,
    edges: &[usize],
) -> Vec<Vec<usize>> {
    let Ok(topology) = problem.topology.edges() else { return Vec::new() };
    let mut held = BTreeMap::<usize, Vec<usize>>::new();
    for (at, edge) in edges.iter().enumerate() {
        let part = parts.of_edge(&topology, problem.topology.counts.free + edge);
        if parts.support(part) == Support::Contact {
            held.entry(part).or_default().push(at);
        }
    }
    held.into_values().collect()
}

/// Constants cost no energy there: its diagonal entry is 0.
pub(super) fn held_by_one(scene: &Scene) -> Error {
    let message = "boundary: a single contact edge holds a part of the domain";
    let hint = "refine the mesh along the contact boundary";
    InputError::new(message).file(&scene.path).hint(hint).into()
}
