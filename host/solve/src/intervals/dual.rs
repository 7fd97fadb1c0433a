//! Linear problems on the mesh of another: their solutions weigh its errors.

use crate::certify::admissible::{Admissible, Following};
use crate::energy_norm::norm;
use crate::problem::Problem;
use crate::solve::{Options, Solution, SolverKind, solve};
use signorini_scene::error::Result;
use signorini_scene::expression::Expression;
use signorini_scene::scene::{Condition, Field, Located, Scene};

/// A solved linear problem with the A and transfer coefficients of another.
pub(super) struct Dual {
    problem: Problem,
    pub solution: Solution,
}

/// What holds on a boundary of it, with a constant.
#[derive(Debug, Clone, Copy)]
pub(super) enum Data {
    /// z = this; on a boundary with a transfer law h(this − z) leaves.
    Value(f64),
    /// The flux is this.
    Flux(f64),
}

impl Dual {
    /// Solves ∇·(A∇z) = 0 with `data` on each boundary of `problem`; those with a transfer law keep its coefficient.
    ///
    /// # Errors
    /// Numbers that cannot be solved for.
    pub fn solve(problem: &Problem, data: impl Fn(usize) -> Data) -> Result<Self> {
        let mut scene: Scene = problem.scene.as_ref().clone();
        let zero = constant(&scene.source, 0.0);
        scene.source = zero.clone();
        scene.inputs.retain(|input| input.field.value == Field::Coefficient);
        (scene.outputs, scene.exact, scene.setting) = (Vec::new(), None, None);
        for (at, boundary) in scene.boundaries.iter_mut().enumerate() {
            let of = |value| constant(&zero, value);
            boundary.condition = match (&boundary.condition, data(at)) {
                (Condition::Robin { coefficient, .. }, Data::Value(value)) => {
                    Condition::Robin { coefficient: coefficient.clone(), ambient: of(value) }
                }
                (_, Data::Value(value)) => Condition::Dirichlet { value: of(value) },
                (_, Data::Flux(flux)) => Condition::Neumann { flux: of(flux) },
            };
        }
        let problem = Problem::new(&scene, problem.mesh.clone())?;
        let options = Options { solver: SolverKind::Factor, ..Options::default() };
        let solution = solve(&problem, &options)?;
        Ok(Self { problem, solution })
    }

    /// The problem and its solution.
    pub fn parts(&self) -> (&Problem, &Solution) {
        (&self.problem, &self.solution)
    }

    /// (‖A^½∇w‖² + ∫_R h w²)^½ of the function w with these values at the vertices.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn norm(&self, vertices: &[f64]) -> Result<f64> {
        let bubbles = vec![0.0; self.problem.ends.len()];
        let following = Following::default();
        norm(
            &self.problem,
            &Admissible { vertices, bubbles: &bubbles, tau: &[], following: &following },
        )
    }
}

fn constant(like: &Located<Expression>, value: f64) -> Located<Expression> {
    Located { value: Expression::constant(value), key: like.key.clone(), span: like.span.clone() }
}
