//! How many contact edges are on which side and how large the error bound is, for programs and in the module.

use signorini_image::chosen::Ranges;

use crate::Bakes;
use crate::choice::Origin;
use crate::condensed::Baked;
use signorini_condense::ranges::largest::LargestBound;
use signorini_condense::ranges::sides::EdgeSide;
use signorini_scene::scene::Scene;

/// What is proved of a condensed model for all inputs within their ranges.
pub fn found<R: Bakes>(baked: &Baked<R>, origin: &Origin) -> Ranges {
    let sides = &origin.sides;
    Ranges {
        contact: sides.of.len(),
        always_open: sides.count(EdgeSide::Open),
        always_touching: sides.count(EdgeSide::Touching),
        always_saturated: sides.count(EdgeSide::Saturated),
        may_change: sides.count(EdgeSide::MayChange),
        largest_error_bound: largest_bound(baked, origin).map(|bound| bound.proved),
    }
}

/// Where it is proved, and not much larger than what some inputs reach.
pub(super) fn largest_bound<R: Bakes>(baked: &Baked<R>, origin: &Origin) -> Option<LargestBound> {
    // What a step begins from has no range.
    if baked.without_bound().is_some() || baked.steps.is_some() {
        return None;
    }
    // Loads were finite when the sides were found.
    LargestBound::new(origin.model()).ok().flatten().filter(LargestBound::is_sharp)
}

/// Whether there is anything that holds for the ranges of a scene: it has no inputs, or some of them have a range.
pub fn declared(scene: &Scene) -> bool {
    scene.inputs.is_empty() || scene.inputs.iter().any(|of| of.range.is_some())
}

/// The counts as constants of the module; of a model that steps in time, with its states and those of the mesh.
pub fn constants(ranges: Ranges, states: Option<[usize; 2]>) -> String {
    let Ranges {
        always_open,
        always_touching,
        always_saturated,
        may_change,
        largest_error_bound,
        ..
    } = ranges;
    let (when, steps) = match states {
        None => ("for all inputs within `Inputs::RANGES`", String::new()),
        Some([own, all]) => (
            "in every step",
            format!(
                " Steps are exact ones on the scene's mesh, with its {all} states, whatever inputs within `Inputs::RANGES` have been. This
/// model has {own} of them: its own answers may differ by what it has dropped, and by rounding."
            ),
        ),
    };
    format!(
        "
/// Contact edges of the scene that are open {when}.{steps}
pub const ALWAYS_OPEN: usize = {always_open};
/// Contact edges of the scene that touch {when}.
pub const ALWAYS_TOUCHING: usize = {always_touching};
/// Contact edges of the scene whose flux is at its limit {when}.
pub const ALWAYS_SATURATED: usize = {always_saturated};
/// Contact edges of the scene that may change sides; all of them where nothing is proved. [`CONTACT`] has these, and others
/// that the error bound needs.
pub const MAY_CHANGE: usize = {may_change};
/// No exact solution of this model has a larger error bound while inputs are within `Inputs::RANGES`; none where that is not
/// proved. What a tick rounds in its scalar comes on top, and stands in the bound that it reports: where the domain is weakly
/// held, it may be most of it.
pub const LARGEST_ERROR_BOUND: Option<f64> = {largest_error_bound:?};
"
    )
}
