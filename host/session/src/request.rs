//! How a scene is to be solved: as its setting says, or as a request says instead.

use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_scene::setting::{Precision, Setting};
use signorini_solve::{Options, ScalarKind, Solution, SolverKind, solve};

/// Parts of how to solve that are given; the scene's setting, then a default, has the rest.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SolveRequest {
    /// The scalar type.
    pub scalar: Option<ScalarKind>,
    /// The solver.
    pub solver: Option<SolverKind>,
    /// When sweeps end.
    pub tolerance: Option<f64>,
    /// Most sweeps.
    pub max_sweeps: Option<u32>,
    /// Whether the mesh is refined for it.
    pub refined: bool,
}

impl SolveRequest {
    /// Whether it leaves how to solve to the scene.
    pub fn follows_setting(&self) -> bool {
        let chosen = self.solver.is_some() || self.tolerance.is_some();
        !chosen && self.max_sweeps.is_none() && !self.refined
    }

    /// Solves a problem, as its scene's setting says where it has one and the request follows it.
    ///
    /// # Errors
    /// Data or a setting that cannot be solved with.
    pub fn solve(&self, problem: &Problem) -> Result<Solution> {
        let own = problem.scene.setting.and_then(|setting| setting.scalar);
        let setting = problem.scene.setting.filter(|setting| {
            let mixed = setting.scalar == Some(Precision::Mixed) && self.scalar.is_none();
            self.follows_setting() && (mixed || !setting.of_method().is_empty())
        });
        if let Some(setting) = setting {
            let scalar = self.scalar.map(|scalar| match scalar {
                ScalarKind::F32 => Precision::F32,
                ScalarKind::F64 => Precision::F64,
            });
            let setting = Setting { scalar: scalar.or(own), ..setting };
            return crate::solve(&problem.with_setting(Some(setting)));
        }
        solve(problem, &self.options(own))
    }

    /// The solver's options; `own` is the scalar of the scene's setting.
    pub fn options(&self, own: Option<Precision>) -> Options {
        let single = own == Some(Precision::F32);
        let scalar = self.scalar.unwrap_or(if single { ScalarKind::F32 } else { ScalarKind::F64 });
        Options {
            scalar,
            solver: self.solver(),
            tolerance: self.tolerance,
            max_sweeps: self.max_sweeps,
            ..Options::default()
        }
    }

    /// The solver: `max_sweeps` implies the one that sweeps.
    fn solver(&self) -> SolverKind {
        match (self.solver, self.max_sweeps) {
            (None | Some(SolverKind::Auto), Some(_)) => SolverKind::Kernel,
            (asked, _) => asked.unwrap_or(SolverKind::Auto),
        }
    }
}
