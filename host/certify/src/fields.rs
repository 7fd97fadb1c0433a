//! The fields that a certificate is about, in its own scalar or in f64, and columns of them.

use signorini_bound::certificate::{Buffers, Discretization, LoadCase, openings};
use signorini_kernel::Error as KernelError;
use signorini_kernel::law::Law;

use super::admissible::{Admissible, Following};
use super::evolution::StepTerms;
use super::lifted::Lifts;
use signorini_problem::Problem;
use signorini_problem::scalar::{Scalar, widened};

/// The admissible pair of a certificate.
#[derive(Debug, Clone, Default)]
pub struct CertifiedFields<R = f64> {
    /// s at the vertices.
    pub vertices: Vec<R>,
    /// The bubbles of s, one an edge.
    pub bubbles: Vec<R>,
    /// ∫_E τ·n of every edge, along its direction.
    pub tau: Vec<R>,
    /// Each cell's part of gap², triangles first.
    pub indicators: Vec<R>,
    /// The means of (s − ψ)⁺ and (ψ − s)⁺ along each contact edge, where materials store u.
    pub openings: Vec<[R; 2]>,
    /// The terms of a step in the bound of the evolution, one for each way to balance its cells.
    pub evolution: Vec<StepTerms<f64>>,
    /// Where s has extensions.
    pub following: Following,
    /// Its extensions, where materials store u.
    pub lifts: Lifts,
}

/// A column of s and τ, where these are sums over inputs and unknowns.
#[derive(Debug, Clone)]
pub struct Column {
    /// The problem in which this column is left alone.
    pub problem: Problem,
    /// s and τ.
    pub certified: CertifiedFields,
    /// The flux of each transfer law, ∫h (u_ext − u), where a coefficient changes: in a sum of columns that is ∫τ·n. Else nothing.
    pub laws: Vec<f64>,
}

impl CertifiedFields {
    /// S and τ as the exact norms take them.
    pub fn admissible(&self) -> Admissible<'_> {
        let Self { vertices, bubbles, tau, following, .. } = self;
        Admissible { vertices, bubbles, tau, following }
    }
}

impl<R: Scalar> CertifiedFields<R> {
    /// Of `problem`.
    pub(super) fn new(problem: &Problem) -> Self {
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
            evolution: Vec::new(),
            following: Following::WhereNeeded,
            lifts: Lifts::default(),
        }
    }

    /// Fills in how far s is from ψ.
    ///
    /// # Errors
    /// Never for fields of this problem.
    pub(super) fn open(
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

    /// The fields in the kernel's form.
    pub(super) fn buffers(&mut self) -> Buffers<'_, R> {
        let Self { vertices, bubbles, tau, indicators, .. } = self;
        Buffers { vertices, bubbles, tau, indicators }
    }

    /// These fields in f64.
    pub(super) fn widened(&self) -> CertifiedFields {
        CertifiedFields {
            vertices: widened(&self.vertices),
            bubbles: widened(&self.bubbles),
            tau: widened(&self.tau),
            indicators: widened(&self.indicators),
            openings: self.openings.iter().map(|pair| pair.map(R::wide)).collect(),
            evolution: self.evolution.clone(),
            following: self.following.clone(),
            lifts: self.lifts.clone(),
        }
    }
}
