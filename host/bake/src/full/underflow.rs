//! Patterns that the scalar type loses.

use super::data::Data;
use crate::range::wider;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_scene::scene::Scene;

/// A pattern that is nothing but underflow would leave its input without effect.
pub(super) fn refuse_faint<R: Scalar>(scene: &Scene, data: &Data<R>) -> Result<()> {
    for (input, pattern) in scene.inputs.iter().zip(&data.patterns) {
        let weights = pattern.weights();
        let most = weights.iter().fold(R::ZERO, |most, weight| most.or_larger(weight.magnitude()));
        if !weights.is_empty() && most < R::TINY {
            let message = format!("beside the other data too small for {}", R::NAME);
            let hint =
                format!("multiply it by a power of ten and divide the input by it{}", wider::<R>());
            return Err(scene.error(&input.pattern, message).hint(hint).into());
        }
    }
    Ok(())
}
