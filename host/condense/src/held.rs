//! Parts of the domain that contact alone holds.

use std::collections::BTreeMap;

use signorini_kernel::mesh::components::Support;

use signorini_problem::{Parts, Problem};
use signorini_scene::error::{Error, InputError};
use signorini_scene::scene::Scene;

/// Unknowns by the parts that they alone hold; and where there is exactly one such part, its cells.
pub(super) fn held(
    problem: &Problem,
    parts: &Parts,
    edges: &[usize],
) -> (Vec<Vec<usize>>, Option<Vec<bool>>) {
    let Ok(topology) = problem.topology.edges() else { return (Vec::new(), None) };
    let mut held = BTreeMap::<usize, Vec<usize>>::new();
    for (at, edge) in edges.iter().enumerate() {
        let part = parts.of_edge(&topology, problem.topology.counts.free + edge);
        if parts.support(part) == Support::Contact {
            held.entry(part).or_default().push(at);
        }
    }
    let alone = held.keys().next().filter(|_| parts.counts.contact == 1);
    let cells = |part| (0..problem.cells()).map(|cell| parts.of_cell(cell) == part).collect();
    let alone = alone.map(|&part| cells(part));
    (held.into_values().collect(), alone)
}

/// Constants cost no energy there: its diagonal entry is 0.
pub(super) fn held_by_one(scene: &Scene) -> Error {
    let message = "boundary: a single contact edge holds a part of the domain";
    let hint = "refine the mesh along the contact boundary";
    InputError::new(message).file(&scene.path).hint(hint).into()
}
