//! One solve in the scene's own setting, for `signorini solve`.

use std::time::Instant;

use super::{Answer, completed, with};
use crate::error::Result;
use crate::problem::{Parts, Problem};
use crate::scene::Scene;
use crate::setting::Precision;
use crate::solve::{ScalarKind, Seconds, Solution};

/// Solves `scene` cold, for its default inputs.
///
/// # Errors
/// As for [`with`].
pub fn solve(scene: &Scene, problem: &Problem) -> Result<Solution> {
    let parts = Parts::examine(scene, problem)?.counts;
    let start = Instant::now();
    let inputs: Vec<f64> = scene.inputs.iter().map(|input| input.default).collect();
    let (prepared, swept, answer) = with(scene, problem, |engine| {
        let prepared = start.elapsed().as_secs_f64();
        engine.tick(&inputs)?;
        Ok((prepared, start.elapsed().as_secs_f64(), engine.answer(problem)?))
    })?;
    let length = answer.length(problem);
    let Answer { status, sweeps, omega, residual, u, flux, force, active, bound, certified } =
        answer;
    let single = completed(scene).scalar == Some(Precision::F32);
    Ok(Solution {
        scalar: if single { ScalarKind::F32 } else { ScalarKind::F64 },
        status,
        sweeps,
        conjugate: 0,
        algebraic_residual: residual,
        omega,
        mismatch: 0.0,
        contact_force: force,
        contact_length: length,
        contact_active: active.iter().filter(|active| **active).count(),
        parts,
        bound,
        certified,
        seconds: Seconds { assembly: prepared, solve: swept - prepared, ..Seconds::default() },
        u,
        flux,
    })
}
