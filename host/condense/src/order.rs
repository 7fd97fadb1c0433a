//! The order of the contact unknowns: along the boundary, whatever order the mesh has its edges in.
//!
//! Neighbours open and touch together, so of the groups of eight that the kernel works in most are open or
//! touch as a whole, and products leave out those that touch.

use std::collections::BTreeMap;

use signorini_problem::Problem;

/// Contact edges that meet at a vertex.
type Meetings = BTreeMap<u32, Vec<usize>>;

/// The contact edge of each unknown, counted from the first contact edge: chain after chain from one
/// end to the other, then closed curves. Where more than two edges meet, any of them goes on.
pub fn along_boundary(problem: &Problem) -> Vec<usize> {
    let counts = problem.topology.counts;
    let ends = &problem.ends[counts.free..][..counts.contact];
    let mut meetings = Meetings::new();
    for (edge, vertices) in ends.iter().enumerate() {
        vertices.iter().for_each(|vertex| meetings.entry(*vertex).or_default().push(edge));
    }
    let mut order = Order { ends, meetings: &meetings, is_taken: vec![false; ends.len()] };
    let is_end = |vertex: u32| meetings[&vertex].len() == 1;
    let mut edges = Vec::with_capacity(ends.len());
    for (edge, &[one, other]) in ends.iter().enumerate() {
        if is_end(one) || is_end(other) {
            edges.extend(order.walk(edge, if is_end(one) { other } else { one }));
        }
    }
    for (edge, &[_, other]) in ends.iter().enumerate() {
        edges.extend(order.walk(edge, other));
    }
    edges
}

/// Edges that have been walked along.
struct Order<'o> {
    ends: &'o [[u32; 2]],
    meetings: &'o Meetings,
    is_taken: Vec<bool>,
}

impl Order<'_> {
    /// The edges from `first` on, over its end `ahead`, as far as they are not taken.
    fn walk(&mut self, first: usize, mut ahead: u32) -> Vec<usize> {
        let mut walked = Vec::new();
        let mut next = Some(first).filter(|&edge| !self.is_taken[edge]);
        while let Some(edge) = next {
            self.is_taken[edge] = true;
            walked.push(edge);
            next = self.meetings[&ahead].iter().copied().find(|&edge| !self.is_taken[edge]);
            if let Some([one, other]) = next.map(|edge| self.ends[edge]) {
                ahead = if one == ahead { other } else { one };
            }
        }
        walked
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    use signorini_scene::mesh::adapted;
    use signorini_scene::scene::Scene;

    fn problem(name: &str) -> Problem {
        let path = format!("../../meshes/scenes/{name}.toml");
        let scene = Scene::read(Path::new(&path)).expect("a standard scene");
        let mesh = adapted::of_scene(&scene).expect("its mesh");
        Problem::new(&scene, mesh).expect("a sound problem")
    }

    #[test]
    fn neighbours_follow_each_other() {
        for name in ["levee", "pit", "slab", "strip", "membrane"] {
            let problem = problem(name);
            let order = along_boundary(&problem);
            let counts = problem.topology.counts;
            let mut sorted = order.clone();
            sorted.sort_unstable();
            assert!(sorted.into_iter().eq(0..counts.contact), "{name}: each edge once");
            let ends = |edge: usize| problem.ends[counts.free + edge];
            let breaks = order.windows(2).filter(|pair| {
                let [one, other] = [ends(pair[0]), ends(pair[1])];
                !one.iter().any(|vertex| other.contains(vertex))
            });
            assert!(breaks.count() <= 2, "{name}: {order:?}");
        }
    }
}
