//! The controller that `bake` would write, on this machine.

use super::{Engine, condensed, full};
use crate::choice::{Choice, Model, Wanted};
use crate::setting;
use signorini_scene::error::Result;
use signorini_solve::problem::Problem;
use signorini_solve::scalar::Scalar;
use signorini_solve::solve::ScalarKind;

/// Lends the engine of the module that `bake` writes for `problem`, with the module's name in a few words: its
/// model, solver and scalar are chosen as there, `asked` being the scalar of the command line.
///
/// # Errors
/// Those of `bake`: no model that represents the scene or fits its target.
pub fn baked<T>(
    problem: &Problem,
    asked: Option<ScalarKind>,
    then: impl FnOnce(&mut dyn Engine, &str) -> Result<T>,
) -> Result<T> {
    match setting::scalar(&problem.scene, asked)? {
        ScalarKind::F32 => baked_in::<f32, T>(problem, then),
        ScalarKind::F64 => baked_in::<f64, T>(problem, then),
    }
}

fn baked_in<R: Scalar, T>(
    problem: &Problem,
    then: impl FnOnce(&mut dyn Engine, &str) -> Result<T>,
) -> Result<T> {
    let choice = Choice::<R>::new(problem, Wanted::default())?;
    let candidate = choice.candidate();
    let name = format!("{}, {}", candidate.name, R::NAME);
    match &candidate.model {
        Model::Condensed(_) => condensed::lend(problem, &choice, |engine| then(engine, &name)),
        Model::Full(baked) => full::lend(&problem.scene, baked, |engine| then(engine, &name)),
    }
}
