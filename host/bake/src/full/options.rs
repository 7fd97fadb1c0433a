//! Units of a baked scene, and how its ticks are solved.

use signorini_device::full;
use signorini_device::tick::Limits;
use signorini_kernel::relaxation::Relaxation;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;
use signorini_scene::setting::{MathKind, Omega, Setting, Start};

use super::limits;
use crate::range::refuse_answers;

/// How its ticks are solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TickOptions<R> {
    pub relaxation: Relaxation<R>,
    pub limits: Limits<R>,
    pub certified: bool,
    /// Every tick starts anew.
    pub cold: bool,
    /// The search for ω takes the fast square root.
    pub fast: bool,
}

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

impl<R: Scalar> TickOptions<R> {
    /// As `setting` says, for so many unknowns.
    pub fn new(setting: &Setting, unknowns: usize) -> Self {
        Self {
            relaxation: match setting.omega {
                Omega::Fixed(omega) => Relaxation::Fixed(R::narrow(omega)),
                Omega::Auto => Relaxation::for_unknowns(unknowns),
            },
            limits: limits(setting),
            certified: setting.certificate,
            cold: setting.start == Start::Cold,
            fast: setting.math == MathKind::Micromath,
        }
    }
}
