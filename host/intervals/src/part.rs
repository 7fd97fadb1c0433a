//! The part of the boundary that an output is about.

use signorini_problem::{EdgeKind, Problem};
use signorini_scene::scene::{Condition, Output};

/// A boundary of the scene, or all contact edges.
pub(super) struct Part<'p> {
    problem: &'p Problem,
    name: Option<&'p str>,
}

impl<'p> Part<'p> {
    pub fn new(problem: &'p Problem, output: &'p Output) -> Self {
        Self { problem, name: output.of.as_ref().map(|of| of.value.as_str()) }
    }

    /// Whether the boundary of the scene's table `at` belongs to it.
    pub fn has_table(&self, at: usize) -> bool {
        let boundary = &self.problem.scene.boundaries[at];
        match self.name {
            Some(name) => boundary.name.value == name,
            None => matches!(boundary.condition, Condition::Contact { .. }),
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

    /// Condition that holds on it; `None` where it has no edge.
    pub fn kind(&self) -> Option<EdgeKind> {
        self.edges().next().map(|edge| self.problem.kinds[edge])
    }
}
