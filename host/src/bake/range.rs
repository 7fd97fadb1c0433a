//! What a scalar type cannot hold of a scene, whatever units its data are computed in: answers and inputs, which are
//! in the scene's own.

use crate::error::{Error, InputError, Result};
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::scene::units::Units;

/// What is near 1 may be 2^−20 or 2^20: so far from its limits the scalar must hold a unit.
const NEAR: f64 = 20.0;

/// Refuses answers that lose digits or overflow: u, fluxes and energy norms near `units`.
pub(crate) fn refuse_answers<R: Scalar>(scene: &Scene, units: &Units) -> Result<()> {
    let energy = ("energy norms are", units.energy());
    refuse::<R>(scene, units, [energy], NEAR)
}

/// Refuses as well what makes squares of energies do so, 2^−20 to 2^20 of them: for programs that compute in the scene's
/// units.
pub(crate) fn refuse_squares<R: Scalar>(scene: &Scene, units: &Units) -> Result<()> {
    let square = ("squares of energy norms are", units.energy() * units.energy());
    refuse::<R>(scene, units, [square], 2.0 * NEAR)
}

fn refuse<R: Scalar>(
    scene: &Scene,
    units: &Units,
    energy: [(&str, f64); 1],
    margin: f64,
) -> Result<()> {
    let room = -R::TINY.wide().log2() - margin;
    let is_far = |unit: f64| unit.log2().abs() > room;
    if is_far(units.u) {
        let data = "value, gap, ambient, flux and f";
        return Err(beyond::<R>(scene, ("u is", units.u), units.u, data));
    }
    let others = std::iter::once(("fluxes are", units.flux())).chain(energy);
    match others.into_iter().find(|(_, unit)| is_far(*unit)) {
        Some(far) => {
            let data = "conductivity, coefficient, flux and f";
            Err(beyond::<R>(scene, far, units.conductivity, data))
        }
        None => Ok(()),
    }
}

/// `what` is near `size`, and would be near 1 with `data` divided by `unit`.
fn beyond<R: Scalar>(scene: &Scene, (what, size): (&str, f64), unit: f64, data: &str) -> Error {
    let [size, unit] = [size, unit].map(|unit| unit.log10().round());
    let message = format!("{what} near 1e{size}, too far from 1 for {} to compute with", R::NAME);
    let hint =
        format!("state the scene in other units: {data} divided by 1e{unit}{}", wider::<R>());
    InputError::new(message).file(&scene.path).hint(hint).into()
}

/// Refuses defaults of inputs that would not be what the scene says.
pub(crate) fn refuse_inputs<R: Scalar>(scene: &Scene) -> Result<()> {
    let is_lost = |x: R, given: f64| !x.finite() || (given != 0.0 && x.magnitude() < R::TINY);
    match scene.inputs.iter().find(|input| is_lost(R::narrow(input.default), input.default)) {
        None => Ok(()),
        Some(input) => {
            let message = format!("{} cannot hold its default {:e}", R::NAME, input.default);
            let hint = format!(
                "divide it by a power of ten and multiply the pattern by it{}",
                wider::<R>()
            );
            Err(scene.error(&input.name, message).hint(hint).into())
        }
    }
}

/// What a hint ends in where there is a wider scalar type.
pub(crate) fn wider<R: Scalar>() -> &'static str {
    if size_of::<R>() < size_of::<f64>() { ", or use --scalar f64" } else { "" }
}
