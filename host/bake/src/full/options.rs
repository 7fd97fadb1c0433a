//! How the ticks of a baked scene are solved.

use signorini_device::tick::Limits;
use signorini_kernel::relaxation::Relaxation;
use signorini_problem::scalar::Scalar;
use signorini_scene::setting::{MathKind, Omega, Setting, Start};

use super::limits;

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
