//! Where Dirichlet and contact boundary meet, u_D may not lie below the gap: no u could satisfy both.

use std::collections::HashMap;

use super::{Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::scene::Field;

/// Difference that rounding may leave of u_D = ψ, relative to the range of the boundary data: cos(1.5π) in an
/// expression is −1.8e−16.
const ROUNDING: f64 = 1e-9;

const BELOW: &str = "where Dirichlet and contact boundary meet, value ≥ gap is needed";
const ABOVE: &str =
    "where u ≤ gap (flux = \"-inf\") meets a Dirichlet boundary, value ≤ gap is needed";

/// Checks every vertex between a Dirichlet and a contact edge at the time of the problem.
///
/// # Errors
/// The first vertex where u_D < ψ beyond rounding, with both values.
pub(super) fn check(problem: &Problem) -> Result<()> {
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
            let given = Sum::on_edge(problem, edge, Field::Value, problem.time);
            let gap = Sum::on_edge(problem, neighbour, Field::Gap, problem.time);
            let (Some(given), Some(gap)) = (given, gap) else { continue };
            let (value, gap) = (given.at(x, y), gap.at(x, y));
            let span = problem.loads.spans.get(neighbour - counts.free);
            let (side, off, hint) = match span.copied().unwrap_or(f64::INFINITY) {
                f64::INFINITY => ("below", gap - value, BELOW),
                f64::NEG_INFINITY => ("above", value - gap, ABOVE),
                // On either side there is a flux.
                _ => continue,
            };
            if off > ROUNDING * (high - low) {
                let message = format!("u_D = {value} at ({x}, {y}) lies {side} the gap ψ = {gap}");
                return Err(problem.scene.error(given.key(), message).hint(hint).into());
            }
        }
    }
    Ok(())
}
