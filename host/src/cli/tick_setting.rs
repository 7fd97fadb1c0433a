//! What ticks can follow: the length of a step, and the settings of a scene.

use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;
use signorini_scene::setting::{Method, ModelKind, Precision, Setting};

/// The length of a step, as the command line has it.
pub(super) fn length_of_step(text: &str) -> std::result::Result<f64, String> {
    match super::solve::tolerance(text) {
        Ok(step) if step > 0.0 => Ok(step),
        _ => Err("expected a finite number > 0, such as 0.1".to_owned()),
    }
}

/// Refuses the first key of `[setting]` that the scene's own ticks, full and swept, cannot follow, instead of
/// answering for another setting; `scalar_given` where the command line has a scalar of its own.
///
/// ```text
///   refine, cells, element,
///   error                     every command: they are the mesh and its basis
///   scalar                    every command; f32+f64 solve and trade alone
///   the rest                  solve, bake, trade, tick --baked
/// ```
///
/// # Errors
/// Such a key.
pub(super) fn check_ticks(scene: &Scene, scalar_given: bool) -> Result<()> {
    let Some(setting) = scene.setting else { return Ok(()) };
    let is_mixed = !scalar_given && setting.scalar == Some(Precision::Mixed);
    let scalar = is_mixed.then_some("scalar").into_iter();
    let mut keys =
        scalar.chain(setting.of_method().into_iter().filter(|key| !follows(key, &setting)));
    let Some(key) = keys.next() else { return Ok(()) };
    let message = format!(
        "setting.{key}: `tick` cannot follow it: it sweeps the full model, certified, in one scalar"
    );
    let hint =
        "add --baked for the controller that `bake` writes for this setting, or remove the key";
    Err(InputError::new(message).file(scene.file()).hint(hint).into())
}

/// Whether ticks do what this value of a method's key says, in any case.
fn follows(key: &str, setting: &Setting) -> bool {
    match key {
        "model" => setting.model == Some(ModelKind::Full),
        "solver" => setting.solver == Some(Method::Sweeps),
        _ => false,
    }
}
