//! A case solved as a user would.

use std::path::Path;

use super::case::{RandomCase, Way};
use signorini_bake::engine;
use signorini_certify::ErrorBound;
use signorini_problem::{Approach, Problem};
use signorini_scene::error::{Error, Result};
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;
use signorini_scene::setting::ModelKind;
use signorini_solve::{Options, Solution, SolverKind, solve, status_name};

/// What a solver says, in the scene's units.
#[derive(Debug, Clone)]
pub struct SolverAnswer {
    /// How it ended.
    pub status: &'static str,
    /// Whether it claims success.
    pub success: bool,
    /// Sweeps spent.
    pub sweeps: u32,
    /// Mean of u_h over each edge.
    pub u: Vec<f64>,
    /// ∫_E σ·n of each edge.
    pub flux: Vec<f64>,
    /// ∫_C (σ·n − q)
    pub force: f64,
    /// Its bound.
    pub bound: Option<ErrorBound>,
    /// What the bound is about.
    pub certified: signorini_certify::CertifiedFields,
}

/// A case that was answered: its problem with the inputs of the answer, and the answer.
pub struct Attempt {
    /// The scene on its mesh, its inputs at those of the answer.
    pub problem: Problem,
    /// The answer.
    pub answer: SolverAnswer,
}

/// Updates of unknowns that a solve may take.
const UPDATES: f64 = 1e9;

/// Solves `case`.
///
/// # Errors
/// Input that is refused.
pub fn attempt(case: &RandomCase) -> Result<Attempt> {
    let scene = Scene::parse(&case.scene, Path::new("scene.toml"))?;
    let problem = Problem::new(&scene, case.mesh.clone())?;
    match case.effort.way {
        Way::Sweeps | Way::Direct => {
            let options = options(case, &problem);
            let answer = SolverAnswer::from(solve(&problem, &options)?);
            Ok(Attempt { problem, answer })
        }
        Way::Full | Way::Condensed => ticks(case, problem),
    }
}

fn options(case: &RandomCase, problem: &Problem) -> Options {
    let updates = UPDATES / problem.topology.counts.unknowns().max(1) as f64;
    let solver = match case.effort.way {
        Way::Direct => SolverKind::Direct,
        _ => SolverKind::Kernel,
    };
    let max_sweeps = case.effort.sweeps.unwrap_or(updates.clamp(1.0, 1e6) as u32);
    Options { scalar: case.effort.scalar, solver, max_sweeps, ..Options::default() }
}

/// The earlier ticks, whatever they say, and then the one that is judged.
fn ticks(case: &RandomCase, problem: Problem) -> Result<Attempt> {
    let has_tick = Approach::Tick.lack(&problem)?.is_none();
    let condensed = problem.scene.setting.and_then(|set| set.model) == Some(ModelKind::Condensed);
    // There an engine answers for the scene's own inputs.
    let own = !condensed && !has_tick;
    let at = problem.with_inputs(if own { &[] } else { &case.effort.inputs })?;
    let inputs: Vec<f64> = at.scene.inputs.iter().map(|input| input.default).collect();
    let answer = engine::with(&problem, |engine| {
        for earlier in &case.effort.earlier {
            // What an extreme tick says is its own affair; what it leaves behind is not.
            let _ = engine.tick(earlier);
        }
        if let Err(error) = engine.tick(&inputs) {
            engine.restart();
            return match engine.tick(&inputs) {
                Ok(_) => Err(Error::Check(format!("only a new controller answers: {error}"))),
                Err(_) => Err(error),
            };
        }
        engine.answer(&at)
    })?;
    Ok(Attempt { problem: at, answer: SolverAnswer::from(answer) })
}

impl From<Solution> for SolverAnswer {
    fn from(solution: Solution) -> Self {
        Self {
            status: status_name(solution.status),
            success: solution.converged(),
            sweeps: solution.sweeps,
            u: solution.u,
            flux: solution.flux,
            force: solution.contact_force,
            bound: solution.bound,
            certified: solution.certified,
        }
    }
}

impl From<engine::TickSolution> for SolverAnswer {
    fn from(answer: engine::TickSolution) -> Self {
        let status = status_name(answer.status);
        Self {
            status,
            success: status == "converged",
            sweeps: answer.sweeps,
            u: answer.u,
            flux: answer.flux,
            force: answer.force,
            bound: answer.bound,
            certified: answer.certified,
        }
    }
}

impl SolverAnswer {
    /// The same in other units.
    #[must_use]
    pub fn divided(mut self, units: &Units) -> Self {
        let divide = |all: &mut [f64], unit: f64| all.iter_mut().for_each(|x| *x /= unit);
        divide(&mut self.u, units.u);
        divide(&mut self.flux, units.flux());
        self.force /= units.flux();
        self.bound = self.bound.map(|bound| bound.times(1.0 / units.energy()));
        divide(&mut self.certified.vertices, units.u);
        divide(&mut self.certified.bubbles, units.u);
        divide(&mut self.certified.tau, units.flux());
        self
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        let certified = &self.certified;
        let parts = [&self.u, &self.flux, &certified.vertices, &certified.bubbles, &certified.tau];
        let bound = self.bound.is_none_or(|bound| bound.total.is_finite());
        bound && self.force.is_finite() && parts.into_iter().flatten().all(|x| x.is_finite())
    }
}
