//! A case solved as a user would.

use std::path::Path;

use super::case::{RandomCase, Way};
use signorini_certify::ErrorBound;
use signorini_problem::{Approach, Problem};
use signorini_scene::setting::ModelKind;
use signorini_scene::{Error, Result, Scene};
use signorini_session::with_session;
use signorini_solve::{Ending, Options, Solution, SolverKind, solve};

/// A case that was answered: its problem with the inputs of the answer, and the answer.
pub struct Attempt {
    /// The scene on its mesh, its inputs at those of the answer.
    pub problem: Problem,
    /// The answer, in the scene's units.
    pub answer: Solution,
}

/// An answer in units in which its numbers are near 1.
pub struct Held<'a> {
    pub case: &'a RandomCase,
    pub problem: &'a Problem,
    pub answer: &'a Solution,
    pub bound: ErrorBound,
}

/// Updates of unknowns that a solve may take.
const UPDATES: f64 = 1e9;

pub fn attempt(case: &RandomCase) -> Result<Attempt> {
    let scene = Scene::parse(&case.scene, Path::new("scene.toml"))?;
    let problem = Problem::new(&scene, case.mesh.clone())?;
    match case.effort.way {
        Way::Sweeps | Way::Direct => {
            let options = options(case, &problem);
            let answer = solve(&problem, &options)?;
            Ok(Attempt { problem, answer })
        }
        Way::Full | Way::Condensed => ticks(case, problem),
    }
}

fn options(case: &RandomCase, problem: &Problem) -> Options {
    let updates = UPDATES / problem.topology.counts.unknowns().max(1) as f64;
    // Of each kind of cases, with a feature and without, one half.
    let solver = match case.effort.way {
        Way::Direct if case.number % 4 < 2 => SolverKind::Multigrid,
        Way::Direct => SolverKind::Direct,
        _ => SolverKind::Kernel,
    };
    let max_sweeps = case.effort.sweeps.unwrap_or(updates.clamp(1.0, 1e6) as u32);
    Options {
        scalar: case.effort.scalar,
        solver,
        max_sweeps: Some(max_sweeps),
        ..Options::default()
    }
}

/// The earlier ticks, whatever they say, and then the one that is judged.
fn ticks(case: &RandomCase, problem: Problem) -> Result<Attempt> {
    let has_tick = Approach::Tick.lack(&problem)?.is_none();
    let condensed = problem.scene.setting.and_then(|set| set.model) == Some(ModelKind::Condensed);
    // There each tick is a solve for the inputs that were posed.
    let own = !condensed && !has_tick;
    let at = problem.with_inputs(if own { &[] } else { &case.effort.inputs })?;
    let inputs: Vec<f64> = at.scene.inputs.iter().map(|input| input.default).collect();
    let answer = with_session(&problem, |session| {
        for earlier in &case.effort.earlier {
            // What an extreme tick says is its own affair; what it leaves behind is not.
            let _ = session.tick(earlier);
        }
        if let Err(error) = session.tick(&inputs) {
            session.restart();
            return match session.tick(&inputs) {
                Ok(_) => Err(Error::Check(format!("only a new controller answers: {error}"))),
                Err(_) => Err(error),
            };
        }
        session.answer(&at)
    })?;
    let status = Ending::Solve(answer.status.of_solve());
    Ok(Attempt { problem: at, answer: Solution { status, ..answer } })
}

impl Attempt {
    pub fn is_finite(&self) -> bool {
        let Solution { u, flux, contact_force, bound, certified, .. } = &self.answer;
        let parts = [u, flux, &certified.vertices, &certified.bubbles, &certified.tau];
        let bound = bound.is_none_or(|bound| bound.total.is_finite());
        bound && contact_force.is_finite() && parts.into_iter().flatten().all(|x| x.is_finite())
    }
}
