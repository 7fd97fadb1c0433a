//! The functions that s is a sum of: vertex functions and bubbles.

use signorini_kernel::mesh::edges::Block;

use signorini_problem::Problem;

/// The numbers of s: its vertex values, then the bubbles of free edges between quads.
#[derive(Debug)]
pub(super) struct Functions {
    /// The number of each edge's bubble.
    bubbles: Vec<Option<u32>>,
    count: usize,
}

impl Functions {
    pub fn of(problem: &Problem) -> Self {
        let topology = &problem.topology;
        let (vertices, triangles) = (problem.mesh.vertices.len(), 3 * problem.mesh.triangles.len());
        let mut count = vertices;
        let bubbles = topology.half_edges.iter().enumerate().map(|(edge, halves)| {
            let of_quads = halves.iter().all(|&half| half as usize >= triangles);
            let free = problem.kinds[edge].block() == Block::Free;
            (of_quads && free).then(|| {
                count += 1;
                count as u32 - 1
            })
        });
        let bubbles = bubbles.collect();
        Self { bubbles, count }
    }

    pub fn count(&self) -> usize {
        self.count
    }

    /// The number of the bubble on an edge.
    pub fn bubble(&self, edge: usize) -> Option<u32> {
        self.bubbles[edge]
    }
}
