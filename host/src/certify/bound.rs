//! The bound of one solve, for reports.

use serde::Serialize;
use signorini_kernel::Error as KernelError;
use signorini_kernel::certificate::Certificate;

use super::{Answer, Certifier, Data};
use crate::problem::{Assembled, Parts, Problem};
use crate::scalar::Scalar;
use crate::scene::Scene;

/// How wrong s and τ can be, in the energy norm; see [`Certificate`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ErrorBound {
    /// oscillation + √(gap² + oscillation²) + rounding
    pub total: f64,
    /// The bound where f, g and q have no oscillation.
    pub gap: f64,
    /// What more sweeps would remove.
    pub algebraic: f64,
    /// What f, g and q leave out.
    pub oscillation: f64,
    /// What rounding can have hidden.
    pub rounding: f64,
}

impl ErrorBound {
    /// Wider by what rounding of very oblique element matrices can hide, `share` of it; less than a thousandth is
    /// far below what is counted as rounding anyhow.
    #[must_use]
    pub fn widened(self, share: f64) -> Self {
        if share < 1e-3 {
            return self;
        }
        let more = share * self.total;
        Self { total: self.total + more, rounding: self.rounding + more, ..self }
    }

    /// The same in other units.
    #[must_use]
    pub fn times(self, unit: f64) -> Self {
        let Self { total, gap, algebraic, oscillation, rounding } = self;
        let [total, gap, algebraic, oscillation, rounding] =
            [total, gap, algebraic, oscillation, rounding].map(|x| x * unit);
        Self { total, gap, algebraic, oscillation, rounding }
    }

    /// Widens the kernel's numbers.
    pub fn new<R: Scalar>(certificate: &Certificate<R>) -> Self {
        Self {
            total: certificate.total.wide(),
            gap: certificate.gap.wide(),
            algebraic: certificate.algebraic.wide(),
            oscillation: certificate.oscillation.wide(),
            rounding: certificate.rounding.wide(),
        }
    }
}

/// An iterate's bound and what it is the bound of.
#[derive(Debug, Clone)]
pub struct Certified {
    /// `None`: neither D nor R nor active contact edges can take the surplus of some part, or the data
    /// do not allow for it ([`Data::has_bound`]), or they overflow the scalar.
    pub bound: Option<ErrorBound>,
    /// s and τ; no guarantee where there is no bound.
    pub answer: Answer,
}

impl Certified {
    /// Certifies the iterate `u`.
    ///
    /// # Errors
    /// Never for data of this problem.
    pub fn new<R: Scalar>(
        scene: &Scene,
        problem: &Problem,
        parts: &Parts,
        assembled: &Assembled<R>,
        data: &Data<R>,
        u: &[R],
    ) -> Result<Self, KernelError> {
        let mut certifier = Certifier::new(scene, problem, parts, assembled)?;
        let certificate = certifier.certify(parts, assembled, data, u)?;
        let bound = certificate.as_ref().map(ErrorBound::new);
        Ok(Self { bound, answer: certifier.answer() })
    }
}
