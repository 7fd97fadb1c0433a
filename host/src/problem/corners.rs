//! Where Dirichlet and contact boundary meet, u_D may not lie below the gap: no u could satisfy both.

use std::collections::HashMap;

use super::loads::Sum;
use super::{EdgeKind, Problem};
use crate::error::Result;
use crate::scene::{Condition, Field, Scene};

/// What rounding may leave of u_D = ψ, relative to the range of the boundary data: cos(1.5π) in an
/// expression is −1.8e−16.
const ROUNDING: f64 = 1e-9;

/// Checks every vertex between a Dirichlet and a contact edge at the time of the problem.
///
/// # Errors
/// The first vertex where u_D < ψ beyond rounding, with both values.
pub(super) fn check(scene: &Scene, problem: &Problem) -> Result<()> {
    let counts = problem.topology.counts;
    let contact = counts.free..counts.unknowns();
    let touched: HashMap<u32, usize> =
        contact.flat_map(|edge| problem.ends[edge].map(|vertex| (vertex, edge))).collect();
    let given = problem.loads.dirichlet.iter().chain(&problem.loads.gap);
    let (low, high) =
        given.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &x| (a.min(x), b.max(x)));
    for edge in counts.unknowns()..counts.edges() {
        for vertex in problem.ends[edge] {
            let Some(&neighbour) = touched.get(&vertex) else { continue };
            let [x, y] = problem.mesh.vertices[vertex as usize];
            let value = at_vertex(scene, problem, edge, [x, y]);
            let gap = at_vertex(scene, problem, neighbour, [x, y]);
            let (Some((value, key)), Some((gap, _))) = (value, gap) else { continue };
            if gap - value > ROUNDING * (high - low) {
                let message = format!("u_D = {value} at ({x}, {y}) lies below the gap ψ = {gap}");
                let hint = "where Dirichlet and contact boundary meet, value ≥ gap is needed";
                return Err(scene.error(key, message).hint(hint).into());
            }
        }
    }
    Ok(())
}

type Located<'s> = &'s crate::scene::Located<crate::expression::Expression>;

/// u_D or ψ of the boundary that an edge belongs to.
fn at_vertex<'s>(
    scene: &'s Scene,
    problem: &Problem,
    edge: usize,
    [x, y]: [f64; 2],
) -> Option<(f64, Located<'s>)> {
    let boundary = &scene.boundaries[problem.binding.boundary(problem.ends[edge])?];
    let (field, key) = match (&boundary.condition, problem.kinds[edge]) {
        (Condition::Dirichlet { value }, EdgeKind::Dirichlet) => (Field::Value, value),
        (Condition::Contact { gap, .. }, EdgeKind::Contact) => (Field::Gap, gap),
        _ => return None,
    };
    Some((Sum::new(scene, &boundary.name.value, field, key, problem.time).at(x, y), key))
}
