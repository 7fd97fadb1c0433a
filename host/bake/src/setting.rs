//! What a module can have of a scene's `[setting]`, and what it cannot.

use signorini_device::tick::Progress;
use signorini_kernel::relaxation::Relaxation;

use super::range::refuse_inputs;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::{Quantity, Scene};
use signorini_scene::setting::{MathKind, Omega, Precision, Setting};
use signorini_solve::ScalarKind;

/// The scalar type of the module: the one that is asked for, else that of the setting, else f32.
///
/// # Errors
/// A setting that sweeps in f32 on residuals in f64.
pub fn scalar(scene: &Scene, asked: Option<ScalarKind>) -> Result<ScalarKind> {
    let own = scene.setting.and_then(|setting| setting.scalar);
    match (asked, own) {
        (Some(kind), _) => Ok(kind),
        (None, Some(Precision::F64)) => Ok(ScalarKind::F64),
        (None, Some(Precision::F32) | None) => Ok(ScalarKind::F32),
        (None, Some(Precision::Mixed)) => Err(InputError::new(
            "setting.scalar: a module has one scalar type, f32+f64 is for the host",
        )
        .file(&scene.path)
        .hint("scalar = \"f32\" or \"f64\", or --scalar on the command line")
        .into()),
    }
}

/// The setting, where a module in the scalar `R` can have it and hold the inputs; without one the default.
pub(super) fn checked<R: Scalar>(scene: &Scene) -> Result<Setting> {
    refuse_inputs::<R>(scene)?;
    let setting = scene.setting.unwrap_or_default();
    let wrong = |message: String| InputError::new(message).file(&scene.path);
    let bound = scene.outputs.iter().find(|output| output.quantity == Quantity::Bound);
    if let Some(output) = bound.filter(|_| !setting.certificate) {
        let message = "there is no bound to read: setting.certificate leaves it out";
        let error = scene.error(&output.name, message);
        return Err(error.hint("leave this output out too, or set certificate = true").into());
    }
    if setting.math == MathKind::Micromath && size_of::<R>() != size_of::<f32>() {
        let error = wrong(format!("setting.math: there is no micromath in {}", R::NAME));
        return Err(error.hint("math = \"libm\", or the scalar f32").into());
    }
    if let Omega::Fixed(omega) = setting.omega
        && Progress::new(Relaxation::Fixed(R::narrow(omega))).is_err()
    {
        let error = wrong(format!("setting.omega: {omega} is not inside (0, 2) in {}", R::NAME));
        return Err(error.hint("a number like 1.9, or \"auto\"").into());
    }
    Ok(setting)
}
