//! The fields that a certificate is about, in the scalar that it is computed in.

use signorini_bound::certificate::{Buffers, Discretization, LoadCase, Pair};
use signorini_kernel::Error as KernelError;
use signorini_kernel::law::Law;

use signorini_problem::scalar::Scalar;
use signorini_problem::{Problem, State};

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

    fn pair(&self) -> Pair<'_, R> {
        let Self { vertices, bubbles, tau, .. } = self;
        Pair { vertices, bubbles, tau }
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
        let mut openings = std::mem::take(&mut self.openings);
        if !openings.is_empty() {
            self.pair().openings(of, given, law, &mut openings)?;
        }
        self.openings = openings;
        Ok(())
    }

    /// As the kernel takes it.
    pub fn buffers(&mut self) -> Buffers<'_, R> {
        let Self { vertices, bubbles, tau, indicators, .. } = self;
        Buffers { vertices, bubbles, tau, indicators }
    }

    /// Distances of τ from A∇s for s at the beginning of a step, in its middle and at its end, squared.
    ///
    /// # Errors
    /// Never for fields of this problem.
    pub fn distances(
        &self,
        of: &Discretization<R, u32>,
        given: &LoadCase<R, u32>,
        law: Law<R>,
        begin: &State<R>,
    ) -> Result<[R; 3], KernelError> {
        let middle = |a: &[R], b: &[R]| -> Vec<R> {
            a.iter().zip(b).map(|(&a, &b)| R::HALF * a + R::HALF * b).collect()
        };
        let middle =
            [middle(&self.vertices, &begin.vertices), middle(&self.bubbles, &begin.bubbles)];
        let with = |vertices: &[R], bubbles: &[R]| {
            Pair { vertices, bubbles, tau: &self.tau }.distance(of, given, law)
        };
        Ok([
            with(&begin.vertices, &begin.bubbles)?,
            with(&middle[0], &middle[1])?,
            with(&self.vertices, &self.bubbles)?,
        ])
    }

    /// Terms of contact for s at the beginning of a step and at its end.
    pub fn contacts(
        &self,
        of: &Discretization<R, u32>,
        given: &LoadCase<R, u32>,
        law: Law<R>,
        begin: &State<R>,
    ) -> [R; 2] {
        [&begin.openings, &self.openings]
            .map(|openings| self.pair().contact(of, given, law, openings))
    }
}
