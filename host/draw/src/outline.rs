//! Outlines: directed sides, in any order, joined to closed polygons.

use std::collections::BTreeMap;

use super::simplify::simplify;

/// Where an outline turns: on an edge between two vertices, or (with twice the same number) at a vertex.
pub type Node = [usize; 2];

/// The edge between two vertices, whichever comes first.
pub fn crossing([a, b]: [usize; 2]) -> Node {
    [a.min(b), a.max(b)]
}

/// The sides that only one of the triangles has, directed as in it; all of the same orientation.
pub fn rim(triangles: impl IntoIterator<Item = [usize; 3]>) -> Vec<[usize; 2]> {
    let mut sides: BTreeMap<Node, (usize, [usize; 2])> = BTreeMap::new();
    for [a, b, c] in triangles {
        for side in [[a, b], [b, c], [c, a]] {
            sides.entry(crossing(side)).or_insert((0, side)).0 += 1;
        }
    }
    sides.into_values().filter(|&(count, _)| count == 1).map(|(_, side)| side).collect()
}

/// The outlines of triangles, all of the same orientation; `point` says where a vertex lies.
pub fn around(
    triangles: impl IntoIterator<Item = [usize; 3]>,
    point: impl Fn(usize) -> [f64; 2],
) -> Vec<Vec<[f64; 2]>> {
    let mut segments = Segments::default();
    rim(triangles).into_iter().for_each(|[a, b]| segments.add([a, a], [b, b]));
    segments.outlines(|[vertex, _]| point(vertex))
}

/// Directed pieces of outlines, to be joined.
#[derive(Debug, Default)]
pub struct Segments {
    next: BTreeMap<Node, Vec<Node>>,
}

impl Segments {
    /// Adds one piece.
    pub fn add(&mut self, from: Node, to: Node) {
        self.next.entry(from).or_default().push(to);
    }

    /// The polygons, simplified; `point` says where a node lies.
    pub fn outlines(self, point: impl Fn(Node) -> [f64; 2]) -> Vec<Vec<[f64; 2]>> {
        let loops = self.loops().into_iter();
        loops.map(|nodes| simplify(nodes.into_iter().map(&point).collect())).collect()
    }

    /// Follows the segments until each is used.
    fn loops(mut self) -> Vec<Vec<Node>> {
        let mut loops = Vec::new();
        while let Some((&start, _)) = self.next.first_key_value() {
            let (mut node, mut outline) = (start, Vec::new());
            while let Some(successors) = self.next.get_mut(&node) {
                outline.push(node);
                let successor = successors.pop();
                if successors.is_empty() {
                    self.next.remove(&node);
                }
                node = successor.unwrap_or(start);
            }
            loops.push(outline);
        }
        loops
    }
}
