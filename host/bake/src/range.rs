//! What a scalar type cannot hold of a scene, or not compute with.
//!
//! With T the smallest normal number and ε the rounding of the scalar, numbers near 2^k are
//! ```text
//!   held with all their digits, 2^−20 to 2^20 of them as well,      where |k| ≤ −log₂ T − 20,
//!   fit for sums of squares, roundings of them as well: ε² 4^k ≥ T, where |k| ≤ (−log₂ T + 2 log₂ ε)/2,
//! ```
//! 1e±32 and 1e±12 in f32.

use signorini_condense::CondensedModel;
use signorini_contact::dense::blocks::padded;
use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;

/// What is near 1 may be 2^−20 or 2^20.
const NEAR: f64 = 20.0;

/// Refuses a scene whose answers a program in `R` could not give in the scene's own units: `units` are near them.
pub fn refuse_answers<R: Scalar>(scene: &Scene, units: &Units) -> Result<()> {
    refuse::<R>(scene, units, "hold", -R::TINY.wide().log2() - NEAR)
}

/// Refuses a scene that a program in `R` could not solve and certify in the scene's own units.
pub fn refuse_squares<R: Scalar>(scene: &Scene, units: &Units) -> Result<()> {
    let room = R::EPSILON.wide().log2() - 0.5 * R::TINY.wide().log2();
    refuse::<R>(scene, units, "square", room)
}

/// Refuses what is not within 2^−`room` and 2^`room`.
fn refuse<R: Scalar>(scene: &Scene, units: &Units, what: &str, room: f64) -> Result<()> {
    const OF_U: &str = "value, gap, ambient, flux and f";
    const OF_A: &str = "conductivity, coefficient, flux and f";
    // Energy norms U √α lie between the two.
    let sizes =
        [("u is", units.u, units.u, OF_U), ("fluxes are", units.flux(), units.conductivity, OF_A)];
    let far = sizes.into_iter().find(|(_, size, ..)| size.log2().abs() > room);
    let Some((of, size, unit, data)) = far else { return Ok(()) };
    let [size, unit] = [size, unit].map(|unit| unit.log10().round());
    let message = format!("{of} near 1e{size}, which {} cannot {what} with all digits", R::NAME);
    let hint =
        format!("state the scene in other units: {data} divided by 1e{unit}{}", wider::<R>());
    Err(InputError::new(message).file(&scene.path).hint(hint).into())
}

/// Refuses a mesh whose edges a program in `R` could not hold the lengths of.
pub fn refuse_lengths<R: Scalar>(problem: &Problem) -> Result<()> {
    let room = -R::TINY.wide().log2() - NEAR;
    let length = |edge| {
        let [a, b] = problem.segment(edge);
        (b[0] - a[0]).hypot(b[1] - a[1])
    };
    let mut lengths = (0..problem.topology.counts.edges()).map(length);
    let Some(far) = lengths.find(|length| length.log2().abs() > room) else { return Ok(()) };
    let size = far.log10().round();
    let message =
        format!("the mesh has edges near 1e{size}, which {} cannot hold with all digits", R::NAME);
    let hint = format!("state lengths in another unit{}", wider::<R>());
    Err(InputError::new(message).file(&problem.scene.path).hint(hint).into())
}

/// Refuses defaults and ranges of inputs that would not be what the scene says.
pub fn refuse_inputs<R: Scalar>(scene: &Scene) -> Result<()> {
    let ranges = scene.inputs.iter().filter_map(|input| input.range.as_ref());
    let is_held = |end: f64| R::narrow(end).finite();
    for range in ranges {
        if !range.value.into_iter().all(is_held) {
            let message = format!("{} cannot hold its ends", R::NAME);
            return Err(scene.error(range, message).hint(narrower::<R>()).into());
        }
    }
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

/// Refuses ranges of inputs whose loads `R` could not solve for: what the kernel asks of ‖b‖ in every tick, asked of Σ|b|.
pub fn refuse_loads<R: Scalar>(scene: &Scene, condensate: &CondensedModel) -> Result<()> {
    let size = |(range, column): (&[f64; 2], &Vec<f64>)| {
        let most = range[0].abs().max(range[1].abs());
        most * column.iter().map(|b| b.abs()).sum::<f64>()
    };
    let loads: Vec<f64> = condensate.ranges.iter().zip(&condensate.load).map(size).collect();
    let inputs = scene.inputs.iter().zip(loads.iter().skip(1));
    let declared = inputs.filter_map(|(input, load)| Some((input.range.as_ref()?, *load)));
    let total: f64 = declared.clone().map(|(_, load)| load).sum();
    let largest = declared.max_by(|a, b| a.1.total_cmp(&b.1));
    let terms = padded(condensate.contact).max(1) as f64;
    match largest {
        Some((range, _)) if !R::narrow(total * terms / R::EPSILON.wide()).finite() => {
            let message = format!("its loads are too large for {} to solve for", R::NAME);
            Err(scene.error(range, message).hint(narrower::<R>()).into())
        }
        _ => Ok(()),
    }
}

fn narrower<R: Scalar>() -> String {
    format!("narrow it to what the input can be{}", wider::<R>())
}

/// What a hint ends in where there is a wider scalar type.
pub fn wider<R: Scalar>() -> &'static str {
    if size_of::<R>() < size_of::<f64>() { ", or use --scalar f64" } else { "" }
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_problem::fixtures::{self, SMOOTH};
    use signorini_scene::mesh::structured::{Cells, grid};

    #[test]
    fn lengths_that_f32_cannot_hold_are_refused() -> Result<()> {
        for (unit, is_held) in
            [(1e-40, false), (1e-30, true), (1.0, true), (1e30, true), (1e36, false)]
        {
            let mut mesh = grid(2, Cells::Mixed);
            mesh.vertices.iter_mut().flatten().for_each(|x| *x *= unit);
            let text = SMOOTH.replace("x^2*y + y^2 + x^3", "1").replace("x^3", "0");
            let (_, problem) = fixtures::on_grid(&text, mesh)?;
            assert_eq!(refuse_lengths::<f32>(&problem).is_ok(), is_held, "{unit}");
            refuse_lengths::<f64>(&problem)?;
        }
        Ok(())
    }
}
