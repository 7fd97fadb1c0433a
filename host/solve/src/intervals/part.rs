//! The part of the boundary that an output is about.

use crate::problem::{EdgeKind, Problem};
use signorini_scene::scene::Output;

/// A boundary of the scene, or all contact edges.
pub(super) struct Part<'p> {
    problem: &'p Problem,
    name: Option<String>,
}

impl<'p> Part<'p> {
    pub fn new(problem: &'p Problem, output: &Output) -> Self {
        Self { problem, name: output.of.as_ref().map(|of| of.value.clone()) }
    }

    /// What to call it.
    pub fn name(&self) -> &str {
        self.name.as_deref().unwrap_or("all contact edges")
    }

    /// Whether the boundary of the scene's table `at` belongs to it.
    pub fn has_table(&self, at: usize) -> bool {
        use signorini_scene::scene::Condition::Contact;
        let boundary = &self.problem.scene.boundaries[at];
        match &self.name {
            Some(name) => boundary.name.value == *name,
            None => matches!(boundary.condition, Contact { .. }),
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

    /// What holds on it; none where it has no edge.
    pub fn kind(&self) -> Option<EdgeKind> {
        self.edges().next().map(|edge| self.problem.kinds[edge])
    }
}
