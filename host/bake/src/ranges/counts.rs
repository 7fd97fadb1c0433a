//! How many contact edges are on which side, for programs and in the module.

use signorini_image::chosen::Ranges;

use crate::choice::Origin;
use signorini_scene::scene::Scene;
use signorini_solve::ranges::sides::{EdgeSide, Sides};

/// Those of `sides`.
pub(super) fn of(sides: &Sides) -> Ranges {
    Ranges {
        contact: sides.of.len(),
        always_open: sides.count(EdgeSide::Open),
        always_touching: sides.count(EdgeSide::Touching),
        may_change: sides.count(EdgeSide::MayChange),
    }
}

/// Those of a condensed model; nothing where its scene has inputs and no range.
pub fn counts(scene: &Scene, origin: &Origin) -> Option<Ranges> {
    let is_declared = scene.inputs.is_empty() || scene.inputs.iter().any(|of| of.range.is_some());
    is_declared.then(|| of(&origin.sides))
}

/// The same as constants of the module.
pub fn constants(origin: &Origin) -> String {
    let Ranges { always_open, always_touching, may_change, .. } = of(&origin.sides);
    format!(
        "
/// Contact edges of the scene that are open for all inputs within `Inputs::RANGES`.
pub const ALWAYS_OPEN: usize = {always_open};
/// Contact edges of the scene that touch for all inputs within `Inputs::RANGES`.
pub const ALWAYS_TOUCHING: usize = {always_touching};
/// Contact edges of the scene that may do either; all of them where nothing is proved. [`CONTACT`] has these, and others
/// that the error bound needs.
pub const MAY_CHANGE: usize = {may_change};
"
    )
}
