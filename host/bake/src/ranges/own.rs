//! Sides that the answers of a stepped controller itself are proved to keep, with the states that it has and what its scalar rounds.

use super::why::of_steps;
use crate::narrow::narrow;
use signorini_condense::SteppedModel;
use signorini_condense::ranges::lasting::lasting;
use signorini_condense::ranges::sides::EdgeSide;
use signorini_problem::scalar::Scalar;

/// Roundings of all terms by which a row and a state may be off in a tick.
pub(super) const ROUNDINGS: f64 = 16.0;

/// A sentence on them.
pub(super) fn answers<R: Scalar>(of: &SteppedModel) -> String {
    let left_out = of.settled.count();
    if left_out > 0 {
        // Where its own answers lie follows from the limits that a tick keeps them in.
        return format!(
            "The {left_out} edges that it leaves out do in it what its bound asks for, wherever ticks are cut off: s ≥ ψ where they are open, and the flux presses where they touch.\n"
        );
    }
    let of = narrowed::<R>(of);
    let rounding = ROUNDINGS * R::EPSILON.wide();
    let proved = match lasting(&of, &of.memory(), rounding) {
        Ok(Ok(sides)) => {
            let [open, touching, saturated] =
                [EdgeSide::Open, EdgeSide::Touching, EdgeSide::Saturated].map(|of| sides.count(of));
            let at_limit = match of.model.is_limited() {
                true => format!(", {saturated} are always at their limit"),
                false => String::new(),
            };
            format!("{open} are always open, {touching} always touch{at_limit}")
        }
        Ok(Err(why)) => format!("nothing is proved: {}", of_steps(why)),
        Err(error) => format!("nothing is proved: {error}"),
    };
    format!(
        "In answers of the model itself, whose rows and states are off by no more than {ROUNDINGS} roundings of {}, {proved}.\n",
        R::NAME
    )
}

/// The numbers that the scalar has.
pub(super) fn narrowed<R: Scalar>(of: &SteppedModel) -> SteppedModel {
    let numbers = |of: &[f64]| narrow::<R>(of).into_iter().map(R::wide).collect::<Vec<f64>>();
    let rows = |of: &[Vec<f64>]| of.iter().map(|row| numbers(row)).collect::<Vec<_>>();
    let mut own = of.clone();
    own.model.matrix = numbers(&of.model.matrix);
    own.model.load = rows(&of.model.load);
    own.model.spans = rows(&of.model.spans);
    own.model.defaults = numbers(&of.model.defaults);
    (own.fading, own.of_inputs, own.gaps) =
        (numbers(&of.fading), rows(&of.of_inputs), rows(&of.gaps));
    own
}
