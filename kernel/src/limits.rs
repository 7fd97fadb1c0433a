//! How long a tick may go on.

use crate::Real;
use crate::verdict::Certificate;

/// When a tick may stop: at this error, this share or this many sweeps, whichever is first.
///
/// `error` and `share` are about sweeps on a mesh. A condensed model takes no certificate on its way: it goes on to its
/// end, which is below any share, or until sweeps or time are used up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits<R> {
    /// The certified error that is small enough; 0 leaves it to the others.
    pub error: R,
    /// Part of the bound that its algebraic part may be: below a tenth, more sweeps buy nothing. Where the mesh
    /// holds the solution exactly, all of the error is algebraic, and it ends where rounding hides it. 0
    /// leaves it to the others.
    pub share: R,
    /// Most sweeps of this call; those of a condensed model follow where its exchanges do not suffice.
    pub sweeps: u32,
}

impl<R: Real> Default for Limits<R> {
    /// Until the algebraic part is a tenth of the whole, at most 10 000 sweeps.
    fn default() -> Self {
        Self { error: R::ZERO, share: R::ONE / R::from_count(10), sweeps: 10_000 }
    }
}

impl<R: Real> Limits<R> {
    /// Whether the algebraic part is small enough, or hidden by rounding.
    pub fn are_settled(&self, now: &Certificate<R>) -> bool {
        let hidden = self.share > R::ZERO && now.algebraic <= now.rounding;
        hidden || now.algebraic <= self.share * now.total
    }
}

/// Time left, in a unit of the caller's: the kernel reads no clock.
///
/// A sweep, or an exchange of a condensed model, is begun only while `remaining()` covers it and a certificate after it, so that an answer
/// is late by at most what `remaining` misjudges. The costs are counted for a mesh once and for all
/// (`cargo xtask cost`); where even [`Deadline::certificate`] does not fit, the answer is late by it.
#[derive(Debug, Clone, Copy)]
pub struct Deadline<F> {
    /// Time left now.
    pub remaining: F,
    /// Most that a sweep or an exchange takes: on a mesh with an adaptive ω that of two sweeps more and of laying out the rows, all
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
    /// Whether there is time for a sweep and the certificate after it.
    pub fn allows_a_sweep(&mut self) -> bool {
        (self.remaining)() >= self.sweep.saturating_add(self.certificate)
    }

    /// Whether there is time for a certificate, a sweep and the certificate after it.
    pub fn allows_to_look(&mut self) -> bool {
        let both = self.certificate.saturating_mul(2);
        (self.remaining)() >= self.sweep.saturating_add(both)
    }

    /// Sweeps that take as long as a certificate; 0 where nobody has told what either costs.
    pub fn sweeps_a_certificate(&self) -> u32 {
        self.certificate.checked_div(self.sweep).unwrap_or(0)
    }
}
