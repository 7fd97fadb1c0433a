//! Runs of contact edges on one side, along the boundary.

use crate::choice::Origin;
use crate::text::{short, table};
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
    /// The largest u − ψ in any step; nothing where ticks are no steps in time.
    pub opening: Option<f64>,
}

/// An edge as it is walked along.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Step {
    side: EdgeSide,
    kept: bool,
    boundary: Option<usize>,
    ends: [u32; 2],
    opening: Option<f64>,
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
        opening: steps.iter().filter_map(|step| step.opening).reduce(f64::max),
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
    let keeps = |at: usize| match &origin.steps {
        Some(steps) => steps.settled.keeps(edges[at]),
        None => origin.reduced.is_none() || origin.sides.kept[at],
    };
    let enclosure = origin.sides.enclosure.as_ref().filter(|_| origin.steps.is_some());
    let opening = |at: usize| match origin.sides.of[at] {
        EdgeSide::Touching => enclosure.map(|_| 0.0),
        _ => enclosure.map(|of| (of.hi[at] * origin.whole.opening[at]).max(0.0)),
    };
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
            opening: opening(at),
        });
    }
    steps
}

/// The runs of edges on one side, in the order of the unknowns; of steps in time with the largest openings.
pub(super) fn along_boundary(problem: &Problem, origin: &Origin) -> String {
    let head = ["along the boundary", "edges", "kept", "from", "to", "boundary"];
    let point = |[x, y]: [f64; 2]| format!("({}, {})", short(x), short(y));
    let runs = runs(problem, origin);
    let row = |run: &Run| {
        let [edges, kept] = [run.edges, run.kept].map(|count| count.to_string());
        [run.side.to_owned(), edges, kept, point(run.from), point(run.to), run.boundary.clone()]
    };
    let rows: Vec<_> =
        std::iter::once(head.map(str::to_owned)).chain(runs.iter().map(row)).collect();
    if origin.steps.is_none() {
        return table(&rows);
    }
    let of_runs = runs.iter().map(|run| run.opening.map_or_else(String::new, short));
    let openings = std::iter::once("largest opening".to_owned()).chain(of_runs);
    let with = |([side, edges, kept, from, to, boundary], opening): ([String; 6], String)| {
        [side, edges, kept, from, to, opening, boundary]
    };
    table(&rows.into_iter().zip(openings).map(with).collect::<Vec<_>>())
}
