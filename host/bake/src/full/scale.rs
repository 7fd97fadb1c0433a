//! A module whose numbers are far from 1 works in other units; who calls it keeps the scene's.
//!
//! ```text
//!   input p:       its pattern is in the module's units, p as it is
//!   limits:        error / (U √α)
//!   outputs:       u times U, fluxes and forces times U α, bounds times U √α, lengths as they are
//!   report:        residual times U, force times U α, certificate times U √α
//! ```
//! All of it by powers of two, exact but for what leaves the range of the scalar; [`super::rescaling`] writes the same
//! into the module.

use signorini_bound::certificate::{Certificate, Verdict};
use signorini_device::tick::{Limits, Report};

use super::output::Output;
use crate::range::refuse_answers;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;

/// What 1 stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale<R> {
    pub units: Units,
    /// U
    pub u: R,
    /// U α
    pub flux: R,
    /// U √α
    pub energy: R,
}

impl<R: Scalar> Scale<R> {
    /// That of a scene in `units`.
    ///
    /// # Errors
    /// Answers that the scalar type cannot hold in the scene's own units.
    pub fn new(scene: &Scene, units: Units) -> Result<Self> {
        refuse_answers::<R>(scene, &units)?;
        let [u, flux, energy] = [units.u, units.flux(), units.energy()].map(R::narrow);
        Ok(Self { units, u, flux, energy })
    }

    /// `limits`, in the module's units.
    pub fn limits(&self, limits: Limits<R>) -> Limits<R> {
        Limits { error: limits.error / self.energy, ..limits }
    }

    /// Outputs and report in the scene's units.
    pub fn answer(&self, of: &[Output<R>], outputs: &mut [R], report: Report<R>) -> Report<R> {
        let report = self.report(report);
        for (output, of) in outputs.iter_mut().zip(of) {
            *output = match (self.unit(of), report.verdict.certificate()) {
                (Some(unit), _) => *output * unit,
                (None, Some(certificate)) => certificate.total,
                (None, None) => *output,
            };
        }
        report
    }

    /// The unit of an output; a bound has that of the certificate.
    pub fn unit(&self, of: &Output<R>) -> Option<R> {
        match of {
            Output::Flux(_) | Output::Force(_) => Some(self.flux),
            Output::Length(_) | Output::Saturated(_) => Some(R::ONE),
            Output::Probe(_) => Some(self.u),
            Output::Bound => None,
        }
    }

    fn report(&self, report: Report<R>) -> Report<R> {
        let verdict = match report.verdict {
            Verdict::Certified(of) => Verdict::Certified(Certificate {
                duality_gap: of.duality_gap * self.energy,
                algebraic: of.algebraic * self.energy,
                oscillation: of.oscillation * self.energy,
                rounding: of.rounding * self.energy,
                // Next to underflow a product is less than it should be.
                total: (of.total * self.energy).or_larger(R::TINY),
                of_u: (of.of_u * self.energy).or_larger(R::TINY),
            }),
            other => other,
        };
        let (residual, force) = (report.residual * self.u, report.force * self.flux);
        Report { residual, force, verdict, ..report }
    }
}
