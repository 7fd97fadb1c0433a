//! Report of a tick to a controller, whatever model of a scene it solves.
//!
//! ```text
//!   condensed::Condensed::tick ──► Report
//!   full::Full::tick ──► tick::Report, with figures of its sweeps ──► Report
//! ```
//! One type, so that who reads it need not know which model `signorini bake` has chosen.

use crate::real::Real;
use crate::verdict::{Certificate, Verdict};

/// Reason for the end of a tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// The solution of the discrete problem, but for rounding: by exchanges, by a factor, or since nothing is in contact.
    Exact,
    /// The certified error is small enough.
    Accurate,
    /// More sweeps would hardly change the answer. On a mesh the algebraic part is a small share of the whole, or
    /// rounding keeps it from falling, or the residual is down to rounding where there is no bound to tell; in a
    /// condensed model complementarity holds to its tolerance.
    Settled,
    /// The sweeps allowed are used up, and before them the exchanges, where there are any.
    OutOfSweeps,
    /// The time is used up.
    OutOfTime,
    /// The iterate, its fluxes or an output overflow: the data were too large for the scalar type.
    NotFinite,
}

/// An answer's report: the iterate is feasible in every case but [`Ended::NotFinite`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report<R> {
    /// Reason for its end.
    pub ended: Ended,
    /// Edges that changed sides, one by one, on the way to the exact solution; 0 where there are sweeps alone.
    pub exchanges: u32,
    /// Sweeps; 0 where the exact method or a factor came to its end.
    pub sweeps: u32,
    /// Contact edges that touch, u = ψ.
    pub active: u32,
    /// How wrong the answer can be, or why nobody can tell.
    pub verdict: Verdict<R>,
}

impl<R: Real> Report<R> {
    /// The bound on the error, where there is one; [`Report::verdict`] says why there is none.
    pub fn certificate(&self) -> Option<&Certificate<R>> {
        self.verdict.certificate()
    }
}
