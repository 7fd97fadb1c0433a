//! The edges at each vertex.

use std::ops::Range;

/// Lists of edges, one after the other.
pub(crate) struct Around {
    start: Vec<u32>,
    edges: Vec<u32>,
}

impl Around {
    /// The edges at vertices below `count`, in the order of the edges; `ends` are the two vertices of each.
    pub fn new(ends: &[[u32; 2]], count: usize) -> Self {
        let mut start = vec![0; count + 2];
        for &end in ends.as_flattened().iter().filter(|&&end| (end as usize) < count) {
            start[end as usize + 2] += 1;
        }
        for at in 2..start.len() {
            start[at] += start[at - 1];
        }
        let mut edges = vec![0; start[count + 1] as usize];
        for (pair, edge) in ends.iter().zip(0..) {
            for &end in pair.iter().filter(|&&end| (end as usize) < count) {
                let place = &mut start[end as usize + 1];
                edges[*place as usize] = edge;
                *place += 1;
            }
        }
        Self { start, edges }
    }

    /// The edges at a vertex.
    pub fn at(&self, vertex: u32) -> &[u32] {
        let [start, end] = [0, 1].map(|after| self.start[vertex as usize + after] as usize);
        &self.edges[Range { start, end }]
    }
}
