//! Runs of contact edges on one side, along the boundary.

use crate::choice::Origin;
use signorini_condense::ranges::sides::EdgeSide;
use signorini_problem::Problem;

/// Edges that follow each other, on one side and of one boundary.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Run {
    /// In words.
    pub side: &'static str,
    /// How many there are.
    pub edges: usize,
    /// How many of them the model keeps.
    pub kept: usize,
    /// Where the first one begins.
    pub from: [f64; 2],
    /// Where the last one ends.
    pub to: [f64; 2],
    /// The table of the scene that they belong to.
    pub boundary: String,
}

/// An edge as it is walked along.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Step {
    side: EdgeSide,
    kept: bool,
    boundary: Option<usize>,
    ends: [u32; 2],
}

/// All runs, in the order of the unknowns.
pub(super) fn runs(problem: &Problem, origin: &Origin) -> Vec<Run> {
    let steps = steps(problem, origin);
    let same =
        |a: &Step, b: &Step| a.side == b.side && a.boundary == b.boundary && a.ends[1] == b.ends[0];
    steps.chunk_by(same).map(|steps| run(problem, steps)).collect()
}

fn run(problem: &Problem, steps: &[Step]) -> Run {
    let (first, last) = (steps[0], steps[steps.len() - 1]);
    let at = |vertex: u32| problem.mesh.vertices[vertex as usize];
    let name = |at: usize| format!("{:?}", problem.scene.boundaries[at].name.value);
    Run {
        side: word(first.side),
        edges: steps.len(),
        kept: steps.iter().filter(|step| step.kept).count(),
        from: at(first.ends[0]),
        to: at(last.ends[1]),
        boundary: first.boundary.map_or_else(String::new, name),
    }
}

fn word(side: EdgeSide) -> &'static str {
    match side {
        EdgeSide::Open => "open",
        EdgeSide::Touching => "touching",
        EdgeSide::Saturated => "at its limit",
        EdgeSide::MayChange => "may change",
    }
}

/// The contact edges, each with its ends in the order in which they are passed.
fn steps(problem: &Problem, origin: &Origin) -> Vec<Step> {
    let free = problem.topology.counts.free;
    let edges = &origin.whole.edges;
    let ends: Vec<[u32; 2]> = edges.iter().map(|edge| problem.ends[free + edge]).collect();
    let keeps = |at: usize| origin.reduced.is_none() || origin.sides.kept[at];
    let mut steps: Vec<Step> = Vec::with_capacity(ends.len());
    for (at, &[a, b]) in ends.iter().enumerate() {
        let before = steps.last().map(|step| step.ends[1]);
        let is_ahead = |vertex| ends.get(at + 1).is_some_and(|next| next.contains(&vertex));
        let is_reversed = before == Some(b) || before != Some(a) && is_ahead(a) && !is_ahead(b);
        steps.push(Step {
            side: origin.sides.of[at],
            kept: keeps(at),
            boundary: problem.binding.boundary([a, b]),
            ends: if is_reversed { [b, a] } else { [a, b] },
        });
    }
    steps
}
