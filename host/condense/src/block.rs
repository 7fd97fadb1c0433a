//! The functions that s is a sum of, and rows of a residual over these and fluxes, as few as there can be.

use signorini_kernel::mesh::edges::Block as Kind;
use signorini_problem::Problem;

/// A remainder below this part of its column is the rounding of a dependent one. A row more than needed does no harm: at
/// each step |c|² = (q·c)² + |c − (q·c)q|² for any unit vector q.
const DEPENDENT: f64 = 16.0 * f64::EPSILON;

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

/// |x|
pub(crate) fn norm(x: &[f64]) -> f64 {
    x.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}

/// The rows of R in the QR factorisation of `columns` by modified Gram–Schmidt: Q is not kept, and a
/// column that depends on those before it adds no row.
pub(super) fn triangular(mut columns: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let sizes: Vec<f64> = columns.iter().map(|column| norm(column)).collect();
    let mut rows = Vec::new();
    for at in 0..columns.len() {
        let remainder = norm(&columns[at]);
        if remainder <= DEPENDENT * sizes[at] {
            continue;
        }
        let unit: Vec<f64> = columns[at].iter().map(|entry| entry / remainder).collect();
        let mut row = vec![0.0; columns.len()];
        row[at] = remainder;
        for (entry, column) in row.iter_mut().zip(&mut columns).skip(at + 1) {
            *entry = unit.iter().zip(&*column).map(|(q, c)| q * c).sum();
            column.iter_mut().zip(&unit).for_each(|(c, q)| *c -= *entry * q);
        }
        rows.push(row);
    }
    rows
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
}
