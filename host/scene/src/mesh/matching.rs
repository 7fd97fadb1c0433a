//! Matching in a graph: pairs of neighbours, no node in two of them.
//!
//! Greedy first, edge by edge in the order given. Then every node that stayed alone looks for an
//! augmenting path: from it to another lone node, along edges that are in turn outside the matching
//! and in it. Taken the other way round, the path has a pair more:
//! ```text
//!   a   b═c   d═e   f     ─►     a═b   c═d   e═f
//! ```
//! The search goes breadth first and enters no pair twice, so that paths never meet themselves; some
//! that lead through odd cycles are missed, which takes Edmonds's blossoms to mend.

/// Pairs that one search visits at most: it is cheap, and changes only what is near.
const REACH: usize = 256;

/// For each node the edge that pairs it, if any; `edges` come best first.
pub(super) fn matching(nodes: usize, edges: &[[u32; 2]]) -> Vec<Option<u32>> {
    let mut graph =
        Graph { edges, at: vec![Vec::new(); nodes], pair: vec![None; nodes], seen: vec![0; nodes] };
    for (edge, &[a, b]) in (0..).zip(edges) {
        graph.at[a as usize].push(edge);
        graph.at[b as usize].push(edge);
        if graph.is_alone(a) && graph.is_alone(b) {
            graph.join(edge);
        }
    }
    for node in 0..nodes as u32 {
        if graph.is_alone(node) {
            graph.augment(node);
        }
    }
    graph.pair
}

struct Graph<'a> {
    edges: &'a [[u32; 2]],
    /// The edges at each node.
    at: Vec<Vec<u32>>,
    /// The edge that pairs each node.
    pair: Vec<Option<u32>>,
    /// The last search, by 1 + its root, that came to each node.
    seen: Vec<u32>,
}

/// A node that a search reached over a pair, and how.
struct Step {
    node: u32,
    /// The step before, and the edge from its node to the partner of this one.
    from: Option<(usize, u32)>,
}

impl Graph<'_> {
    fn is_alone(&self, node: u32) -> bool {
        self.pair[node as usize].is_none()
    }

    fn join(&mut self, edge: u32) {
        for node in self.edges[edge as usize] {
            self.pair[node as usize] = Some(edge);
        }
    }

    /// The other end of an edge.
    fn across(&self, edge: u32, node: u32) -> u32 {
        let [a, b] = self.edges[edge as usize];
        if a == node { b } else { a }
    }

    /// Looks for a path from `root` to another lone node and takes it.
    fn augment(&mut self, root: u32) {
        let mut steps = vec![Step { node: root, from: None }];
        self.seen[root as usize] = root + 1;
        let mut next = 0;
        while next < steps.len().min(REACH) {
            let node = steps[next].node;
            for k in 0..self.at[node as usize].len() {
                let edge = self.at[node as usize][k];
                let neighbour = self.across(edge, node);
                if self.seen[neighbour as usize] == root + 1 {
                    continue;
                }
                let Some(pair) = self.pair[neighbour as usize] else {
                    return self.take(&steps, next, edge);
                };
                let partner = self.across(pair, neighbour);
                for node in [neighbour, partner] {
                    self.seen[node as usize] = root + 1;
                }
                steps.push(Step { node: partner, from: Some((next, edge)) });
            }
            next += 1;
        }
    }

    /// Joins the path that ends in `edge`, from its end back to the root.
    fn take(&mut self, steps: &[Step], last: usize, edge: u32) {
        self.join(edge);
        let mut step = &steps[last];
        while let Some((before, edge)) = step.from {
            self.join(edge);
            step = &steps[before];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The partner of each node, whether each pair is one for both.
    fn partners(nodes: usize, edges: &[[u32; 2]]) -> Vec<Option<u32>> {
        let pairs = matching(nodes, edges);
        let partner = |(node, pair): (u32, &Option<u32>)| {
            let [a, b] = edges[(*pair)? as usize];
            assert_eq!(pairs[a as usize], pairs[b as usize]);
            Some(if a == node { b } else { a })
        };
        (0..).zip(&pairs).map(partner).collect()
    }

    #[test]
    fn the_best_edges_are_taken_where_they_leave_nobody_alone() {
        let square = [[0, 1], [2, 3], [1, 2], [3, 0]];
        assert_eq!(partners(4, &square), [Some(1), Some(0), Some(3), Some(2)]);
        assert_eq!(partners(3, &[[1, 2], [0, 1]]), [None, Some(2), Some(1)]);
        assert_eq!(partners(2, &[]), [None, None]);
    }

    #[test]
    fn a_path_is_turned_round() {
        // Greedy takes 1–2 and 3–4 and leaves both ends alone.
        let path = [[1, 2], [3, 4], [0, 1], [2, 3], [4, 5]];
        assert_eq!(partners(6, &path), [1, 0, 3, 2, 5, 4].map(Some));
    }

    #[test]
    fn no_pair_is_entered_twice() {
        // An odd cycle with a tail: four of five nodes can be paired.
        let cycle = [[0, 1], [1, 2], [2, 0], [2, 3], [3, 4]];
        assert_eq!(partners(5, &cycle).iter().flatten().count(), 4);
        // A long path whose greedy matching leaves the ends alone.
        let inner = (0..100).map(|k| [2 * k + 1, 2 * k + 2]);
        let rest = (0..101).map(|k| [2 * k, 2 * k + 1]);
        let path: Vec<_> = inner.chain(rest).collect();
        assert!(matching(202, &path).iter().all(Option::is_some));
    }
}
