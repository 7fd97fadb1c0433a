//! A model whose numbers are far from 1 works in other units; the controller's caller keeps the scene's.
//!
//! ```text
//!   input p:       its pattern is in the model's units, p as it is
//!   limits:        error / (U √α)
//!   outputs:       u times U, fluxes and forces times U α, bounds times U √α, lengths as they are
//!   report:        residual times U, force times U α, certificate times U √α
//! ```
//! Each is a power of two: products are exact but for what leaves the range of the scalar.

use super::Functional;
use crate::tick::{Figures, Report};
use signorini_kernel::Real;
use signorini_kernel::limits::Limits;
use signorini_kernel::verdict::{Certificate, Verdict};

/// What 1 stands for in a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units<R> {
    /// U
    pub u: R,
    /// U α
    pub flux: R,
    /// U √α
    pub energy: R,
}

impl<R: Real> Units<R> {
    /// `limits`, in the model's units.
    pub(super) fn limits(&self, limits: Limits<R>) -> Limits<R> {
        Limits { error: limits.error / self.energy, ..limits }
    }

    /// Outputs and report in the scene's units.
    pub(super) fn answer<I>(
        &self,
        of: &[Functional<R, I>],
        outputs: &mut [R],
        report: Report<R>,
    ) -> Report<R> {
        let report = self.report(report);
        for (output, of) in outputs.iter_mut().zip(of) {
            *output = match (of, report.certificate()) {
                (Functional::Flux(_) | Functional::Force(_), _) => *output * self.flux,
                (Functional::Probe(_), _) => *output * self.u,
                (Functional::Bound, certificate) => certificate.map_or(R::INFINITY, |of| of.total),
                _ => *output,
            };
        }
        report
    }

    fn report(&self, report: Report<R>) -> Report<R> {
        let verdict = match report.verdict {
            Verdict::Certified(of) if !(of.of_u * self.energy).finite() => Verdict::NotFinite,
            Verdict::Certified(of) => Verdict::Certified(Certificate {
                duality_gap: of.duality_gap * self.energy,
                algebraic: of.algebraic * self.energy,
                oscillation: of.oscillation * self.energy,
                rounding: of.rounding * self.energy,
                // Next to underflow a product is less than it should be.
                total: (of.total * self.energy).or_larger(R::TINY),
                of_u: (of.of_u * self.energy).or_larger(R::TINY),
                distance: of.distance * self.energy,
            }),
            other => other,
        };
        Report { verdict, ..report }
    }

    /// Figures of a report in the scene's units.
    pub fn figures(&self, of: Figures<R>) -> Figures<R> {
        let (residual, force) = (of.residual * self.u, of.force * self.flux);
        Figures { residual, force, ..of }
    }
}
