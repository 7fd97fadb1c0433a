//! The linear problem that weighs errors in an output: its z and ζ.
//!
//! On contact edges where u = ψ, z keeps its given value as long as |ζ·n| stays within a part of λ, like a body held by friction. On all
//! others ζ·n is given. Both are contact with limits, so that the kernel solves it.

use std::sync::Arc;

use super::contact::ContactEdge;
use super::goal::Goal;
use signorini_certify::CertifiedFields;
use signorini_problem::{Loads, Problem, State};
use signorini_scene::error::Result;
use signorini_scene::expression::Expression;
use signorini_scene::scene::{Condition, Field, Located, Scene};
use signorini_solve::{SharedSolver, Solution};

/// z at the vertices and its bubbles, and ζ in the place of τ; z is not yet within what contact asks of it.
pub(super) type Weights = CertifiedFields;

/// The linear problem of a goal, but for how far ζ·n may go on contact edges.
pub(super) struct Dual {
    problem: Problem,
    /// Its last solution, where the next one may begin.
    last: Vec<f64>,
}

impl Dual {
    /// The dual problem of `goal` on the mesh, A and transfer coefficients of `problem`.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn new(problem: &Problem, goal: &Goal) -> Result<Self> {
        let mut dual = problem.restated(scene(&problem.scene, goal));
        dual.loads = Loads::of(&dual)?;
        for record in &mut dual.loads.robin {
            let edge = record.edge as usize;
            record.ambient += problem.lengths[edge] * goal.density_on(problem, edge);
        }
        if !goal.sources.is_empty() {
            let mut all = goal.sources.clone();
            let triangles = problem.mesh.triangles.len();
            (dual.loads.quads, dual.loads.triangles) = (all.split_off(triangles), all);
        }
        // Its step begins at 0.
        if let Some(step) = &problem.loads.step {
            dual = dual.stepping(step.length, State::zero(problem))?;
        }
        Ok(Self { problem: dual, last: Vec::new() })
    }

    /// Its problem.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// Solves it where |ζ·n| may be up to `part` of λ on contact edges; nothing where it has no solution.
    pub fn solve(
        &mut self,
        solver: &SharedSolver,
        contact: &[ContactEdge],
        goal: &Goal,
        part: f64,
    ) -> Option<Weights> {
        let base = |of: &ContactEdge| {
            let density = goal.density_on(&self.problem, of.edge);
            self.problem.lengths[of.edge] * density - part * of.room
        };
        let bases = contact.iter().map(base).collect();
        let loads = &mut self.problem.loads;
        loads.contact_flux = bases;
        loads.spans = contact.iter().map(|of| 2.0 * part * of.room).collect();
        let solution = solver.solve(&self.problem, &self.last).ok()??;
        let Solution { u, bound, certified, .. } = solution;
        self.last = u;
        bound.map(|_| certified)
    }
}

/// `of` with the data of the goal; inputs of transfer coefficients stay.
fn scene(of: &Arc<Scene>, goal: &Goal) -> Scene {
    let mut scene: Scene = of.as_ref().clone();
    let like = scene.source.clone();
    let constant = |value| Located { value: Expression::constant(value), ..like.clone() };
    scene.source = constant(0.0);
    scene.inputs.retain(|input| input.field.value == Field::Coefficient);
    (scene.outputs, scene.exact) = (Vec::new(), None);
    let data = goal.values.iter().zip(&goal.densities);
    for (boundary, (&value, &density)) in scene.boundaries.iter_mut().zip(data) {
        boundary.condition = match &boundary.condition {
            Condition::Robin { coefficient, .. } => {
                Condition::Robin { coefficient: coefficient.clone(), ambient: constant(value) }
            }
            Condition::Dirichlet { .. } => Condition::Dirichlet { value: constant(value) },
            Condition::Neumann { .. } => Condition::Neumann { flux: constant(density) },
            // Both ends are finite, so that z may be on either side.
            Condition::Contact { .. } => Condition::Contact {
                gap: constant(value),
                flux: constant(-1.0),
                limit: constant(1.0),
            },
        };
    }
    scene
}
