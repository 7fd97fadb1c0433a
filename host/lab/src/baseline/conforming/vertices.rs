//! Which vertices are unknowns, in the order that the kernel's sweeps ask for.
//!
//! ```text
//!   free vertices | vertices on C | vertices on D, which wins where it meets C
//! ```

use signorini_kernel::mesh::edges::EdgeCounts;

use signorini_problem::{EdgeKind, Problem};

/// The numbering.
#[derive(Debug, Clone)]
pub(super) struct Vertices {
    /// The number of each vertex of the mesh.
    pub number: Vec<usize>,
    /// How many there are of each kind; a vertex takes the place of an edge.
    pub counts: EdgeCounts,
}

impl Vertices {
    pub fn of(problem: &Problem) -> Self {
        let mut block = vec![0_u8; problem.mesh.vertices.len()];
        for (ends, kind) in problem.ends.iter().zip(&*problem.kinds) {
            let own = match kind {
                EdgeKind::Dirichlet => 2,
                EdgeKind::Contact => 1,
                _ => 0,
            };
            ends.iter().for_each(|&v| block[v as usize] = block[v as usize].max(own));
        }
        let count = |wanted: u8| block.iter().filter(|&&own| own == wanted).count();
        let counts = EdgeCounts { free: count(0), contact: count(1), dirichlet: count(2) };
        let mut next = [0, counts.free, counts.unknowns()];
        let number = block.iter().map(|&own| {
            let next = &mut next[usize::from(own)];
            *next += 1;
            *next - 1
        });
        Self { number: number.collect(), counts }
    }
}
