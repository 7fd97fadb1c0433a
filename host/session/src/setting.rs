//! A scene answered as its setting says: by the code that firmware runs, on this machine.

use std::fmt::Display;
use std::time::Instant;

use signorini_bake::full::Baked;
use signorini_problem::inputs::{InputSpace, drawn};
use signorini_problem::{Approach, Parts, Problem, Property};
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;
use signorini_scene::setting::{MathKind, Method, ModelKind, Precision, Setting, Start};
use signorini_solve::{Ending, ScalarKind, Seconds, Solution};

use crate::full::with_full;
use crate::module::{unlent, with_condensed};
use crate::solves::with_solves;
use crate::{Session, Then};

/// The setting of a scene with what is left open filled in: full, in f64.
pub fn completed(scene: &Scene) -> Setting {
    let setting = scene.setting.unwrap_or_default();
    Setting {
        scalar: setting.scalar.or(Some(Precision::F64)),
        model: setting.model_kind().or(Some(ModelKind::Full)),
        ..setting
    }
}

/// Calls `then` with the session of `problem` that its setting says.
///
/// # Errors
/// A setting that the scene does not allow for, numbers that the scalar cannot hold.
pub fn with_session<T>(
    problem: &Problem,
    then: impl FnOnce(&mut dyn Session) -> Result<T>,
) -> Result<T> {
    let (mut then, mut found) = (Some(then), None);
    lend_session(problem, &mut |session| {
        found = then.take().map(|then| then(session)).transpose()?;
        Ok(())
    })?;
    found.ok_or_else(unlent)
}

/// Lends the session of a setting, once.
fn lend_session(problem: &Problem, then: Then) -> Result<()> {
    let setting = completed(&problem.scene);
    let mixed = setting.scalar == Some(Precision::Mixed);
    let single = setting.scalar == Some(Precision::F32);
    let lack = Approach::Tick.lack(problem)?.map(|lack| lack.property);
    match (setting.model, lack) {
        (Some(ModelKind::Condensed), _) if mixed => {
            Err(no_mixed(&problem.scene, "a condensed model").into())
        }
        (Some(ModelKind::Condensed), _) if single => with_condensed::<f32>(problem, then),
        (Some(ModelKind::Condensed), _) => with_condensed::<f64>(problem, then),
        (_, Some(property)) => {
            refuse_tick_keys(problem, &setting, property)?;
            with_solves(problem, &setting, then)
        }
        _ if mixed => with_solves(problem, &setting, then),
        _ if single => with_full(&problem.scene, &Baked::<f32>::new(problem)?, then),
        _ => with_full(&problem.scene, &Baked::<f64>::new(problem)?, then),
    }
}

/// Refuses keys of the setting that mean the kernel's tick, where `property` leaves none.
fn refuse_tick_keys(problem: &Problem, setting: &Setting, property: Property) -> Result<()> {
    let scene = &problem.scene;
    let hint = match Approach::condensing(problem).treats(property) {
        true => "remove it, or take model = \"condensed\"",
        false => "remove it",
    };
    let refused = |key: &str, what: &str| {
        let message = format!("setting.{key}: {what} is not for {property}");
        InputError::new(message).file(&scene.path).hint(hint)
    };
    if setting.scalar == Some(Precision::Mixed) {
        return Err(no_mixed(scene, property).into());
    }
    if setting.solver == Some(Method::Factor) {
        return Err(refused("solver", "a factor").into());
    }
    if setting.math == MathKind::Micromath {
        return Err(refused("math", "micromath").into());
    }
    Ok(())
}

fn no_mixed(scene: &Scene, what: impl Display) -> InputError {
    InputError::new(format!("setting.scalar: f32+f64 is not for {what}"))
        .file(&scene.path)
        .hint("take f32 or f64")
}

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
/// As for [`with_session`].
pub fn solve(problem: &Problem) -> Result<Solution> {
    let problem = &problem.restated(Scene::clone(&problem.scene).at_rest());
    let parts = Parts::examine(problem)?.counts;
    let start = Instant::now();
    let inputs: Vec<f64> = problem.scene.inputs.iter().map(|input| input.default).collect();
    let (assembly, all, found) = with_session(problem, |session| {
        let assembly = start.elapsed().as_secs_f64();
        for earlier in earlier(&problem.scene) {
            session.tick(&earlier)?;
        }
        session.tick(&inputs)?;
        Ok((assembly, start.elapsed().as_secs_f64(), session.answer(problem)?))
    })?;
    let single = completed(&problem.scene).scalar == Some(Precision::F32);
    Ok(Solution {
        scalar: if single { ScalarKind::F32 } else { ScalarKind::F64 },
        status: Ending::Solve(found.status.of_solve()),
        parts,
        seconds: Seconds { assembly, solve: all - assembly, ..Seconds::default() },
        ..found
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_intervals::{Coverage, of_outputs};
    use signorini_problem::fixtures::scene;
    use signorini_scene::mesh::{Curve, Mesh};

    /// flux = limit = 0 lets nothing pass, whatever a condensed model rounds: a wall with next to no transfer makes it round at 1e11.
    #[test]
    fn a_flux_that_is_given_is_in_its_interval() -> Result<()> {
        let vertices = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let curve = |name: &str, edge| Curve { name: name.to_owned(), edges: vec![edge] };
        let mesh = Mesh {
            vertices,
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            curves: vec![curve("bot", [0, 1]), curve("top", [2, 3])],
            ..Mesh::default()
        };
        for coefficient in ["1e-11", "1e-9", "1e-6"] {
            let text = format!(
                "
mesh = \"grid\"
material.default.conductivity = \"1\"
source.f = \"sin(2*y)\"
boundary.bot = {{ kind = \"contact\", flux = \"0\", limit = \"0\" }}
boundary.top = {{ kind = \"contact\", flux = \"0\", limit = \"0\" }}
boundary.default = {{ kind = \"robin\", coefficient = \"{coefficient}\", ambient = \"0\" }}
output.q = {{ kind = \"flux\", of = \"bot\" }}
setting.model = \"condensed\"
"
            );
            let problem = Problem::new(&scene(&text)?, mesh.clone())?;
            let found = of_outputs(&problem, &solve(&problem)?, Coverage::Usual);
            let interval = found["q"].as_ref().expect("an interval");
            let (center, half) = (interval.center, interval.plus_minus);
            assert!(center.abs() <= half, "{coefficient}: {center:e} ± {half:e}");
        }
        Ok(())
    }
}
