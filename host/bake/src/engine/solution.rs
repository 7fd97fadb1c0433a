//! One solve in the scene's own setting, for `signorini solve`.

use std::time::Instant;

use super::{TickSolution, completed, with};
use signorini_problem::inputs::{InputSpace, drawn};
use signorini_problem::{Parts, Problem};
use signorini_scene::error::Result;
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;
use signorini_scene::setting::{Precision, Start};
use signorini_solve::{ScalarKind, Seconds, Solution};

/// Ticks before the one that is asked for: a fixed number of warm sweeps is one of a controller that has run for a
/// while, with inputs around the defaults as a trade study draws them.
fn earlier(scene: &Scene) -> Vec<Vec<f64>> {
    const TICKS: usize = 100;
    let setting = completed(scene);
    let runs = setting.start == Start::Warm && setting.sweeps.is_some() && !scene.inputs.is_empty();
    if runs { drawn::<f64>(&InputSpace::of(scene), TICKS).collect() } else { Vec::new() }
}

/// Solves `problem` for its default inputs and at t = 0, as its setting says.
///
/// # Errors
/// As for [`with`].
pub fn solve(problem: &Problem) -> Result<Solution> {
    let problem = &problem.restated(Scene::clone(&problem.scene).at_rest());
    let parts = Parts::examine(problem)?.counts;
    let start = Instant::now();
    let inputs: Vec<f64> = problem.scene.inputs.iter().map(|input| input.default).collect();
    let (prepared, swept, answer) = with(problem, |engine| {
        let prepared = start.elapsed().as_secs_f64();
        for earlier in earlier(&problem.scene) {
            engine.tick(&earlier)?;
        }
        engine.tick(&inputs)?;
        Ok((prepared, start.elapsed().as_secs_f64(), engine.answer(problem)?))
    })?;
    let length = answer.length(problem);
    let TickSolution { status, ran, factored, sweeps, omega, residual, .. } = answer;
    let TickSolution { u, flux, force, active, bound, no_bound, certified, .. } = answer;
    let single = completed(&problem.scene).scalar == Some(Precision::F32);
    Ok(Solution {
        scalar: if single { ScalarKind::F32 } else { ScalarKind::F64 },
        status,
        sweeps,
        conjugate: 0,
        ran,
        factored,
        units: Units::default(),
        scaled: None,
        algebraic_residual: residual,
        omega,
        mismatch: 0.0,
        contact_force: force,
        contact_length: length,
        contact_active: active.iter().filter(|active| **active).count(),
        parts,
        bound,
        no_bound,
        certified,
        seconds: Seconds { assembly: prepared, solve: swept - prepared, ..Seconds::default() },
        u,
        flux,
    })
}
