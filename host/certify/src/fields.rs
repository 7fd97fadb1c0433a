//! The fields that a certificate is about, in the scalar that it is computed in.

use signorini_bound::certificate::{Buffers, Discretization, Handed, LoadCase, openings};
use signorini_kernel::Error as KernelError;
use signorini_kernel::law::Law;

use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;

/// Memory of a certificate: s at the vertices and its bubbles, τ, and each cell's part.
#[derive(Debug, Clone)]
pub struct Fields<R> {
    /// See [`Buffers`].
    pub vertices: Vec<R>,
    /// See [`Buffers`].
    pub bubbles: Vec<R>,
    /// See [`Buffers`].
    pub tau: Vec<R>,
    /// See [`Buffers`].
    pub indicators: Vec<R>,
    /// One per contact edge where materials store u.
    pub openings: Vec<[R; 2]>,
}

impl<R: Scalar> Fields<R> {
    /// Of `problem`.
    pub fn new(problem: &Problem) -> Self {
        let zeros = |length| vec![R::ZERO; length];
        let edges = problem.topology.counts.edges();
        let (vertices, cells) = (problem.mesh.vertices.len(), problem.cells());
        Self {
            vertices: zeros(vertices),
            bubbles: zeros(edges),
            tau: zeros(edges),
            indicators: zeros(cells),
            openings: match problem.capacities.is_empty() {
                true => Vec::new(),
                false => vec![[R::ZERO; 2]; problem.topology.counts.contact],
            },
        }
    }

    /// Fills in how far s is from ψ.
    ///
    /// # Errors
    /// Never for fields of this problem.
    pub fn open(
        &mut self,
        of: &Discretization<R, u32>,
        given: &LoadCase<R, u32>,
        law: Law<R>,
    ) -> Result<(), KernelError> {
        match self.openings.is_empty() {
            true => Ok(()),
            false => openings(of, given, law, [&self.vertices, &self.bubbles], &mut self.openings),
        }
    }

    /// The field in the kernel's form.
    pub fn buffers(&mut self) -> Buffers<'_, R> {
        let Self { vertices, bubbles, tau, indicators, .. } = self;
        Buffers { vertices, bubbles, tau, indicators }
    }

    /// As the kernel takes it for cells that hand on what they lack.
    pub fn handed(&mut self) -> Handed<'_, R> {
        Handed { tau: &mut self.tau, indicators: &mut self.indicators }
    }
}
