//! The bound of one solve, for reports.

use serde::Serialize;
use signorini_bound::certificate::Certificate;
use signorini_kernel::Error as KernelError;

use super::{CertifiedFields, Certifier, Data, NoBound};
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, Parts, Problem};

/// How wrong s and τ, and u_h, can be in the energy norm; see [`Certificate`].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct ErrorBound {
    /// oscillation + √(gap² + oscillation²) + rounding: never less than the error of s and τ.
    pub total: f64,
    /// Never less than ‖A^½∇_h(u − u_h)‖, the energy error of the edge means.
    pub of_u: f64,
    /// The bound where f, g and q have no oscillation.
    #[serde(rename = "gap")]
    pub duality_gap: f64,
    /// The part that more sweeps would remove, at most the total.
    pub algebraic: f64,
    /// Oscillation: the part of f, g and q that their means leave out.
    pub oscillation: f64,
    /// Parts of the oscillation that were enclosed and not resolved, and what A has above pieces of cells.
    pub unresolved: f64,
    /// The part that rounding can have hidden.
    pub rounding: f64,
}

impl ErrorBound {
    /// This bound in units in which `unit` stands for 1.
    #[must_use]
    pub fn times(self, unit: f64) -> Self {
        let Self { total, of_u, duality_gap: gap, algebraic, oscillation, unresolved, rounding } =
            self;
        let [total, of_u, gap, algebraic, oscillation, unresolved, rounding] =
            [total, of_u, gap, algebraic, oscillation, unresolved, rounding].map(|x| x * unit);
        Self { total, of_u, duality_gap: gap, algebraic, oscillation, unresolved, rounding }
    }

    /// What A has above what it is taken for: the total is oscillation + √((gap + open)² + oscillation²) + rounding.
    pub fn open(&self) -> f64 {
        let root = (self.total - self.oscillation - self.rounding).max(0.0);
        let gap = (root * root - self.oscillation * self.oscillation).max(0.0).sqrt();
        (gap - self.duality_gap).max(0.0)
    }

    /// Widens the kernel's numbers.
    pub fn new<R: Scalar>(certificate: &Certificate<R>) -> Self {
        let certificate = certificate.as_parts();
        Self {
            total: certificate.total.wide(),
            of_u: certificate.of_u.wide(),
            duality_gap: certificate.duality_gap.wide(),
            algebraic: certificate.algebraic.wide(),
            oscillation: certificate.oscillation.wide(),
            unresolved: 0.0,
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
    /// Why there is none.
    pub no_bound: Option<NoBound>,
    /// s and τ; no guarantee where there is no bound.
    pub answer: CertifiedFields,
}

impl Certified {
    /// Certifies the iterate `u`, with an s that is better than the average of u_h where that is worth it, unless it is to be
    /// the average.
    ///
    /// # Errors
    /// Never for data of this problem.
    pub fn new<R: Scalar>(
        problem: &Problem,
        parts: &Parts,
        assembled: &Assembled<R>,
        (data, averages): (&Data<R>, bool),
        u: &[R],
    ) -> Result<Self, KernelError> {
        let mut certifier = Certifier::new(problem, parts, assembled)?;
        let mut certificate = certifier.certify(parts, assembled, data, u)?;
        if let Some(found) = certificate.as_mut().filter(|_| !averages) {
            *found = certifier.relaxed(assembled, data, u, *found)?;
        }
        let bound = certificate.as_ref().map(|found| {
            let bound = ErrorBound::new(found);
            // Where all cells are seen by their own points, what is open is as small as rounding.
            let of_tensor = if problem.cuts().is_empty() { 0.0 } else { bound.open() };
            ErrorBound { unresolved: data.evaluated.unresolved + of_tensor, ..bound }
        });
        let no_bound = certifier.no_bound(data);
        Ok(Self { bound, no_bound, answer: certifier.answer() })
    }
}
