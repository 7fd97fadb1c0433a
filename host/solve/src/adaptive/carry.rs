//! From the solution on one mesh to a start on the next.
//!
//! ```text
//!   an edge            the old u_h at its middle, seen from an old cell that holds it
//!   a contact edge     ψ where the old edge touched; else not on the other side of ψ than the old edge
//! ```

use std::cmp::Ordering;
use std::collections::HashMap;

use super::Level;
use signorini_problem::Problem;
use signorini_problem::field::CellField;
use signorini_problem::quadrature::Point;
use signorini_scene::mesh::adaptive::Carried;

/// u to begin with on every unknown edge of `problem`.
pub(super) fn start(level: &Level, problem: &Problem, carried: &Carried) -> Vec<f64> {
    let mut u = vec![0.0; problem.topology.counts.unknowns()];
    for (edges, cells) in sides(problem, carried) {
        for (&edge, &cell) in edges.iter().zip(cells) {
            if let Some(start) = u.get_mut(edge as usize) {
                *start = at_middle(level, cell as usize, problem, edge as usize).unwrap_or(0.0);
            }
        }
    }
    let before = sides_of_gap(level);
    let free = problem.topology.counts.free;
    let origins: HashMap<_, _> = carried.boundary.iter().map(|of| (of.edge, of.origin)).collect();
    for (at, u) in u.iter_mut().enumerate().skip(free) {
        let [a, b] = problem.ends[at];
        let old = origins.get(&[a.min(b), a.max(b)]).and_then(|origin| before.get(origin));
        let gap = problem.loads.gap[at - free];
        match old {
            Some(Ordering::Equal) => *u = gap,
            Some(Ordering::Greater) => *u = u.max(gap),
            Some(Ordering::Less) => *u = u.min(gap),
            None => {}
        }
    }
    u
}

/// The edges of every cell, and the old cell that holds each.
fn sides<'a>(
    problem: &'a Problem,
    carried: &'a Carried,
) -> impl Iterator<Item = (&'a [u32], &'a [u32])> {
    let triangles = problem.topology.of_triangles.iter().zip(&carried.triangle_sides);
    let quads = problem.topology.of_quads.iter().zip(&carried.quad_sides);
    let triangles = triangles.map(|(edges, cells)| (&edges[..], &cells[..]));
    triangles.chain(quads.map(|(edges, cells)| (&edges[..], &cells[..])))
}

/// The old u_h at the middle of an edge of `problem`.
fn at_middle(level: &Level, cell: usize, problem: &Problem, edge: usize) -> Option<f64> {
    let [a, b] = problem.segment(edge);
    let x = [0.5 * a[0] + 0.5 * b[0], 0.5 * a[1] + 0.5 * b[1]];
    let Level { problem: old, solution, .. } = level;
    let field = CellField::new(old, cell, &solution.u, &solution.flux);
    let reference = field.locate(x)?;
    Some(field.sample(&Point { x, reference, weight: 0.0 }).u)
}

/// The side of ψ that u was on, of every contact edge by its vertices.
fn sides_of_gap(level: &Level) -> HashMap<[u32; 2], Ordering> {
    let Level { problem, solution, .. } = level;
    let counts = problem.topology.counts;
    let of_edge = |at: usize| {
        let [a, b] = problem.ends[counts.free + at];
        let (u, gap) = (solution.u[counts.free + at], solution.gap(problem, at));
        ([a.min(b), a.max(b)], u.partial_cmp(&gap).unwrap_or(Ordering::Equal))
    };
    (0..counts.contact).map(of_edge).collect()
}
