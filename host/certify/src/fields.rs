//! The fields that a certificate is about, in the scalar that it is computed in.

use signorini_bound::certificate::{
    Buffers, Discretization, LoadCase, Motion, Residual, StepTerms,
};
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

    fn motion<'a>(&'a self, begin: [&'a [R]; 2]) -> Motion<'a, R> {
        Motion { begin, end: [&self.vertices, &self.bubbles], tau: &self.tau }
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
            let end = [&self.vertices[..], &self.bubbles];
            self.motion(end).openings(of, given, law, &mut openings)?;
        }
        self.openings = openings;
        Ok(())
    }

    /// As the kernel takes it.
    pub fn buffers(&mut self) -> Buffers<'_, R> {
        let Self { vertices, bubbles, tau, indicators, .. } = self;
        Buffers { vertices, bubbles, tau, indicators }
    }

    /// The terms of a step that began from `begin`, what it leaves of its equation, and its oscillation.
    ///
    /// # Errors
    /// Never for fields of this problem.
    pub fn terms(
        &self,
        of: &Discretization<R, u32>,
        given: &LoadCase<R, u32>,
        law: Law<R>,
        (begin, length): (&State<R>, f64),
        left: (&Residual<R>, R),
    ) -> Result<StepTerms<f64>, KernelError> {
        let motion = self.motion([&begin.vertices, &begin.bubbles]);
        let distance = motion.distances(of, given)?;
        let contact = motion.contacts(of, given, law, &begin.openings)?;
        let StepTerms { distance, contact, oscillation, inside, residual, .. } =
            StepTerms::new(R::narrow(length), left, distance, contact);
        Ok(StepTerms {
            length,
            distance: distance.map(R::wide),
            contact: contact.map(R::wide),
            oscillation: oscillation.wide(),
            inside: inside.wide(),
            residual: residual.map(R::wide),
        })
    }
}
