//! A module whose numbers are far from 1 works in other units: [`full::Units`].

use signorini_device::full;

use crate::range::refuse_answers;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;

/// Units in which the numbers of a problem are near 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale<R> {
    pub units: Units,
    /// Units as the kernel takes them.
    pub kernel: full::Units<R>,
}

impl<R: Scalar> Scale<R> {
    /// The units of a scene that is solved in `units`.
    ///
    /// # Errors
    /// Answers that the scalar type cannot hold in the scene's own units.
    pub fn new(scene: &Scene, units: Units) -> Result<Self> {
        refuse_answers::<R>(scene, &units)?;
        let [u, flux, energy] = [units.u, units.flux(), units.energy()].map(R::narrow);
        Ok(Self { units, kernel: full::Units { u, flux, energy } })
    }
}
