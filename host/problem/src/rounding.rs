//! The part of a difference between data of u that rounding explains, so that one rule tells a jump from rounding everywhere.
//!
//! Two expressions for one value differ by the rounding of their operations and constants, and since they are evaluated where a
//! mesh generator has put a vertex: Gmsh writes 1.999999999998744 for the end of a curve at 2. Each carries how far it may be off
//! through that ([`signorini_scene::expression::Expression::rounding`]). Data of a scene are typed with few digits as well: a
//! small part of their range is no jump either. What is explained so is moved, and counted where it is.

use super::{EdgeKind, Problem, Sum};
use signorini_scene::scene::Field;

/// Part of the range of the data of u that a difference may have: cos(1.5π) is −1.8e−16, and 0.3333333333 stands for ⅓.
const TYPED: f64 = 1e-9;

/// Mesh generators find the end of a curve to about this part of its coordinates.
const FOUND: f64 = 1e-12;

/// By how much the data of u on two edges may differ at a common vertex where they stand for one number; `range` is that of all
/// data of u.
pub fn slack(problem: &Problem, range: f64, edges: [usize; 2], vertex: u32) -> f64 {
    let at = problem.mesh.vertices[vertex as usize];
    let off =
        FOUND * edges.map(|edge| extent(problem.segment(edge))).into_iter().fold(0.0, f64::max);
    let sums = edges.map(|edge| datum(problem, edge));
    let explained: f64 = sums.iter().flatten().map(|sum| sum.rounding_at(at, off)).sum();
    explained.max(TYPED * range)
}

/// The datum of an edge: u_D, or the gap.
pub(super) fn datum(problem: &Problem, edge: usize) -> Option<Sum<'_>> {
    Sum::on_edge(problem, edge, field_of(problem.kinds[edge]))
}

/// The field that says what an edge asks of u.
pub(super) fn field_of(kind: EdgeKind) -> Field {
    match kind {
        EdgeKind::Dirichlet => Field::Value,
        EdgeKind::Contact | EdgeKind::Interior | EdgeKind::Neumann | EdgeKind::Robin => Field::Gap,
    }
}

/// The largest coordinate of a segment.
pub fn extent(segment: [[f64; 2]; 2]) -> f64 {
    segment.as_flattened().iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// The range of the means of all data of u: gaps and boundary values.
pub fn range_of(problem: &Problem) -> f64 {
    let given = problem.loads.dirichlet.iter().chain(&problem.loads.gap);
    let ends =
        given.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &x| [low.min(x), high.max(x)]);
    (ends[1] - ends[0]).max(0.0)
}
