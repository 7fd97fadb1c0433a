//! The functions that s is a sum of, and rows of a residual over these and fluxes, as few as there can be.

use signorini_certify::CertifiedFields;
use signorini_kernel::mesh::edges::Block as Kind;
use signorini_problem::Problem;

/// Rows of one cell or Robin edge: coefficients of the functions of s, then of the fluxes, then of p.
#[derive(Debug, Clone, Default)]
pub(super) struct Block {
    /// Which functions of s, see [`Functions`].
    pub functions: Vec<u32>,
    /// Which edges' fluxes, in the edges' directions, or means.
    pub edges: Vec<u32>,
    /// Row after row.
    pub rows: Vec<Vec<f64>>,
}

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
            let free = problem.kinds[edge].block() == Kind::Free;
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

    /// The bubbles of a cell with these edges, each with its side: on a triangle there are none.
    pub fn bubbles_of(&self, edges: &[u32]) -> Vec<(usize, u32)> {
        let sides = edges.iter().enumerate();
        sides.filter_map(|(side, &edge)| Some((side, self.bubble(edge as usize)?))).collect()
    }

    /// s by its number at each function, beside a τ of these fluxes.
    pub fn fields(
        &self,
        problem: &Problem,
        of_s: impl Fn(usize) -> f64,
        tau: Vec<f64>,
    ) -> CertifiedFields {
        let bubble = |number: &Option<u32>| number.map_or(0.0, |place| of_s(place as usize));
        CertifiedFields {
            vertices: (0..problem.mesh.vertices.len()).map(&of_s).collect(),
            bubbles: self.bubbles.iter().map(bubble).collect(),
            tau,
            ..CertifiedFields::default()
        }
    }
}
