//! Warnings on a scene and its mesh: what may not be meant, though it is no error.

use super::functional::of_cells;
use super::solvability::floating;
use super::stored;
use super::{EdgeKind, Problem};
use signorini_scene::mesh::coincident::{Segment, coincident};
use signorini_scene::scene::{Condition, Field, Quantity, Scene};

/// The sentences, the gravest first.
pub(super) fn warnings(problem: &Problem) -> Vec<String> {
    slit(problem)
        .into_iter()
        .chain(floating(problem))
        .chain(idle_default(problem))
        .chain(idle_loads(problem))
        .chain(idle_contents(problem))
        .chain(means_of_two(problem))
        .chain(stored::warnings(problem))
        .collect()
}

/// Edges that lie on each other and have no more than the default between them.
///
/// Nodes that were not merged leave two edges where one was meant, and a condition on each that nobody
/// asked for. A slit that is meant has a table of its own.
fn slit(problem: &Problem) -> Option<String> {
    let edges: Vec<_> = outer(problem).collect();
    let segments = edges.iter().map(|&edge| Segment {
        ends: problem.segment(edge),
        cell: problem.topology.first_side(edge).0 as u32,
    });
    let found = coincident(&segments.collect::<Vec<_>>());
    let found = edges.iter().zip(found).filter(|&(_, found)| found).map(|(&edge, _)| edge);
    let unnamed: Vec<_> =
        found.filter(|&edge| !problem.binding.is_named(problem.ends[edge])).collect();
    let (&first, count) = (unnamed.first()?, unnamed.len());
    let points = unnamed.iter().flat_map(|&edge| problem.segment(edge));
    let [[left, bottom], [right, top]] = points
        .fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], [x, y]| {
            [[low[0].min(x), low[1].min(y)], [high[0].max(x), high[1].max(y)]]
        });
    let [[x0, y0], [x1, y1]] = problem.segment(first);
    Some(format!(
        "{count} boundary edges lie on others without being joined to them, the first ({x0}, {y0})–({x1}, {y1}), all \
         between ({left}, {bottom}) and ({right}, {top}): a slit that only [boundary.default] covers. Merge the nodes \
         there (in Gmsh `Coherence Mesh`); or, if the slit is meant, give it a physical curve and a table"
    ))
}

/// Means over a boundary whose name a material has, too.
fn means_of_two(problem: &Problem) -> Vec<String> {
    let Scene { outputs, materials, .. } = &*problem.scene;
    let means = outputs.iter().filter(|output| output.quantity == Quantity::Mean);
    let both = means.filter_map(|output| {
        let is_both = |name: &str| materials.iter().any(|material| material.name.value == name);
        let of = output.of.iter().find(|of| is_both(&of.value))?;
        let (output, name) = (&output.name.value, &of.value);
        Some(format!(
            "output.{output}: `{name}` is a boundary and a material; the mean is that over the boundary. Give one of them \
             another name"
        ))
    });
    both.collect()
}

/// A default that somebody wrote a condition into, on a boundary that is all named.
fn idle_default(problem: &Problem) -> Option<String> {
    let default =
        problem.scene.boundaries.iter().find(|boundary| boundary.name.value == "default")?;
    let kind = match &default.condition {
        Condition::Neumann { .. } => return None,
        Condition::Dirichlet { .. } | Condition::Robin { .. } | Condition::Contact { .. } => {
            default.condition.kind()
        }
    };
    is_idle(problem, "default").then(|| {
        format!("[boundary.default] ({kind}) acts nowhere: every boundary edge lies in a curve with a table of its own")
    })
}

/// Inputs and outputs of a default that covers no edge.
fn idle_loads(problem: &Problem) -> Vec<String> {
    let inputs = problem.scene.inputs.iter().filter(|input| input.field.value != Field::Source);
    let inputs = inputs.map(|input| (&input.name, &input.of));
    let outputs = problem.scene.outputs.iter().filter(|output| !output.quantity.is_inside());
    let outputs = outputs.flat_map(|output| output.of.iter().map(|of| (&output.name, of)));
    let idle = inputs.chain(outputs).filter(|(_, of)| is_idle(problem, &of.value));
    idle.map(|(name, of)| {
        format!("[{}] is about no edge: [boundary.{}] covers none", name.key, of.value)
    })
    .collect()
}

/// Contents and means over materials without a cell, or without one that stores u.
fn idle_contents(problem: &Problem) -> impl Iterator<Item = String> {
    let inside = problem.scene.outputs.iter().filter(|output| output.quantity.is_inside());
    let idle = inside.filter(|output| of_cells(problem, output).iter().all(|w| *w == 0.0));
    idle.map(|output| {
        let place = output.place("the domain", |name| format!("[material.{name}]"));
        format!("[{}] is about no cell that counts in {place}", output.name.key)
    })
}

/// Whether a boundary of the scene covers no edge; only a default can.
fn is_idle(problem: &Problem, name: &str) -> bool {
    let of = |edge: usize| problem.boundary_of(edge);
    name == "default" && !outer(problem).filter_map(of).any(|of| of.name.value == name)
}

/// The edges on the boundary.
fn outer(problem: &Problem) -> impl Iterator<Item = usize> {
    (0..problem.kinds.len()).filter(|&edge| problem.kinds[edge] != EdgeKind::Interior)
}
