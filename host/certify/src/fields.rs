//! The fields that a certificate is about, in its own scalar.

use signorini_bound::certificate::Buffers;

use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;

/// Memory of a certificate: s at the vertices and its bubbles, τ, and each cell's part.
#[derive(Debug, Clone)]
pub struct Fields<R> {
    /// s at the vertices.
    pub vertices: Vec<R>,
    /// The bubbles of s, one per edge.
    pub bubbles: Vec<R>,
    /// ∫_E τ·n of every edge, along its direction.
    pub tau: Vec<R>,
    /// Each cell's part of gap², triangles first.
    pub indicators: Vec<R>,
}

impl<R: Scalar> Fields<R> {
    /// Zeros for `problem`.
    pub fn new(problem: &Problem) -> Self {
        let zeros = |length| vec![R::ZERO; length];
        let edges = problem.topology.counts.edges();
        let (vertices, cells) = (problem.mesh.vertices.len(), problem.cells());
        Self {
            vertices: zeros(vertices),
            bubbles: zeros(edges),
            tau: zeros(edges),
            indicators: zeros(cells),
        }
    }

    /// As the kernel takes them.
    pub fn buffers(&mut self) -> Buffers<'_, R> {
        let Self { vertices, bubbles, tau, indicators } = self;
        Buffers { vertices, bubbles, tau, indicators }
    }
}
