//! The part of the boundary that an output is about.

use signorini_problem::{EdgeKind, Problem};
use signorini_scene::scene::{Condition, Output};

/// Boundaries of the scene, or all contact edges.
pub(super) struct Part<'p> {
    problem: &'p Problem,
    output: &'p Output,
}

impl<'p> Part<'p> {
    pub fn new(problem: &'p Problem, output: &'p Output) -> Self {
        Self { problem, output }
    }

    /// Whether the boundary of the scene's table `at` belongs to it.
    pub fn has_table(&self, at: usize) -> bool {
        let boundary = &self.problem.scene.boundaries[at];
        match self.output.of[..] {
            [] => matches!(boundary.condition, Condition::Contact { .. }),
            _ => self.output.is_of(&boundary.name.value),
        }
    }

    pub fn has(&self, edge: usize) -> bool {
        let table = self.problem.binding.boundary(self.problem.ends[edge]);
        self.problem.kinds[edge] != EdgeKind::Interior
            && table.is_some_and(|table| self.has_table(table))
    }

    /// Its edges.
    pub fn edges(&self) -> impl Iterator<Item = usize> {
        (0..self.problem.kinds.len()).filter(|&edge| self.has(edge))
    }

    /// Its length.
    pub fn length(&self) -> f64 {
        self.edges().map(|edge| self.problem.lengths[edge]).sum()
    }

    /// Whether no flux passes but through it and N: the loads give it then. No energy weighs it, and what a tick rounds stays.
    pub fn takes_all(&self) -> bool {
        let kinds = self.problem.kinds.iter().enumerate();
        kinds
            .filter(|(_, kind)| !matches!(kind, EdgeKind::Interior | EdgeKind::Neumann))
            .all(|(edge, _)| self.has(edge))
    }

    /// Whether the data give the flux of all its edges: of N, and of C where both ends of its range are one.
    pub fn is_given(&self) -> bool {
        let problem = self.problem;
        let free = problem.topology.counts.free;
        let is_given = |edge: usize| match problem.kinds[edge] {
            EdgeKind::Neumann => true,
            EdgeKind::Contact if problem.scene.limit_input().is_none() => {
                problem.loads.flux_range(edge - free).span().length() == 0.0
            }
            _ => false,
        };
        self.edges().next().is_some() && self.edges().all(is_given)
    }

    /// Whether it has edges, and this condition holds on all of them.
    pub fn is_all(&self, kind: EdgeKind) -> bool {
        self.edges().next().is_some() && self.edges().all(|edge| self.problem.kinds[edge] == kind)
    }
}
