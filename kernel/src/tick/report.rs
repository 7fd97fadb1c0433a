//! How long a tick may go on, and what it says in the end.

use crate::certificate::{Certificate, Verdict};
use crate::real::Real;

/// When enough is enough; whichever comes first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits<R> {
    /// The certified error that is small enough; 0 leaves it to the others.
    pub error: R,
    /// What the algebraic part may be of the whole: below a tenth, more sweeps buy nothing. Where the mesh
    /// holds the solution exactly, all of the error is algebraic, and it ends where rounding hides it. 0
    /// leaves it to the others.
    pub share: R,
    /// Most sweeps of this call.
    pub sweeps: u32,
}

impl<R: Real> Default for Limits<R> {
    /// Until the algebraic part is a tenth of the whole, at most 10 000 sweeps.
    fn default() -> Self {
        Self { error: R::ZERO, share: R::ONE / R::from_count(10), sweeps: 10_000 }
    }
}

impl<R: Real> Limits<R> {
    pub(super) fn are_settled(&self, now: &Certificate<R>) -> bool {
        let hidden = self.share > R::ZERO && now.algebraic <= now.rounding;
        hidden || now.algebraic <= self.share * now.total
    }
}

/// Time left, in a unit of the caller's: the kernel reads no clock.
///
/// A sweep is begun only while `remaining()` covers it and a certificate after it, so that an answer
/// is late by at most what `remaining` misjudges. The costs are counted for a mesh once and for all
/// (`cargo xtask cost`); where even [`Deadline::certificate`] does not fit, the answer is late by it.
#[derive(Debug, Clone, Copy)]
pub struct Deadline<F> {
    /// Time left now.
    pub remaining: F,
    /// Most that a sweep takes: with an adaptive ω that of two sweeps more and of laying out the rows, all
    /// of which may follow one.
    pub sweep: u32,
    /// Most that a certificate and the report take; each may be followed by a measurement of the residual,
    /// which takes a sweep.
    pub certificate: u32,
}

impl Deadline<fn() -> u32> {
    /// All the time in the world.
    pub fn never() -> Self {
        Self { remaining: || u32::MAX, sweep: 0, certificate: 0 }
    }
}

impl<F: FnMut() -> u32> Deadline<F> {
    pub(super) fn allows_a_sweep(&mut self) -> bool {
        (self.remaining)() >= self.sweep.saturating_add(self.certificate)
    }

    /// Whether there is time for a certificate, a sweep and the certificate after it.
    pub(super) fn allows_to_look(&mut self) -> bool {
        let both = self.certificate.saturating_mul(2);
        (self.remaining)() >= self.sweep.saturating_add(both)
    }

    /// Sweeps that take as long as a certificate; 0 where nobody has told what either costs.
    pub(super) fn sweeps_a_certificate(&self) -> u32 {
        self.certificate.checked_div(self.sweep).unwrap_or(0)
    }
}

/// What ended a call of [`super::Running::advance`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// The certified error is small enough.
    Accurate,
    /// The algebraic part is a small share of the whole, or rounding keeps it from falling; also where there
    /// is no bound to tell, once the residual is down to rounding.
    Settled,
    /// The sweeps allowed are used up.
    OutOfSweeps,
    /// The time is used up.
    OutOfTime,
    /// The iterate, its fluxes or an output overflow: the data were too large for the scalar type.
    NotFinite,
}

/// An answer: the iterate is feasible in every case but [`Ended::NotFinite`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report<R> {
    /// What ended it.
    pub ended: Ended,
    /// Sweeps since the tick began.
    pub sweeps: u32,
    /// max |r_i|/K_ii over the unknowns, on contact edges |min(u_i − ψ_i, −r_i/K_ii)|.
    pub residual: R,
    /// Active contact edges, u_E = ψ_E.
    pub active: u32,
    /// Contact edges that became active or ceased to be since the report before.
    pub changes: u32,
    /// ∫_C (τ·n − q)
    pub force: R,
    /// How wrong it can be.
    pub verdict: Verdict<R>,
    /// The relaxation factor.
    pub omega: R,
}
