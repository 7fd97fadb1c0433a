//! Report of a tick to a controller, whatever model of a scene it solves.
//!
//! ```text
//!   condensed::Condensed::tick ──► Report
//!   full::Full::tick ───────────► Report with figures of its sweeps ──► Report
//! ```
//! One type: firmware that reads it need not know which model `signorini bake` has chosen.

use crate::real::Real;
use crate::verdict::{Certificate, Verdict};

crate::codes! {
    /// A cause that ends a tick.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    Ended {
        /// The solution of the discrete problem, but for rounding.
        /// By exchanges, by a factor, or since nothing is in contact.
        Exact = 0 c"EXACT",
        /// The certified error is small enough.
        Accurate = 1 c"ACCURATE",
        /// More sweeps would hardly change the answer.
        /// On a mesh the algebraic part is a small share of the whole, or rounding keeps it from falling, or the residual
        /// is down to rounding where there is no bound to tell; in a condensed model complementarity holds to its
        /// tolerance.
        Settled = 2 c"SETTLED",
        /// The sweeps allowed are used up.
        /// Before them the exchanges, where there are any.
        OutOfSweeps = 3 c"OUT_OF_SWEEPS",
        /// The time is used up.
        OutOfTime = 4 c"OUT_OF_TIME",
        /// The answer overflows: do not use it.
        /// The iterate, its fluxes or an output: the data were too large for the scalar type.
        NotFinite = 5 c"NOT_FINITE",
    }
}

/// An answer's report: the iterate is feasible in every case but [`Ended::NotFinite`]. `F` is what else a model knows:
/// nothing, or the figures of sweeps on a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report<R, F = ()> {
    /// The cause that ended the tick.
    pub ended: Ended,
    /// Edges that changed sides, one by one, on the way to the exact solution; 0 where there are sweeps alone.
    pub exchanges: u32,
    /// Sweeps; 0 where the exact method or a factor came to its end.
    pub sweeps: u32,
    /// Contact edges that touch, u = ψ.
    pub active: u32,
    /// How wrong the answer can be, or why there is no bound.
    pub verdict: Verdict<R>,
    /// More about the solve.
    pub figures: F,
}

impl<R: Real, F> Report<R, F> {
    /// The bound on the error, where there is one; [`Report::verdict`] says why there is none.
    pub fn certificate(&self) -> Option<&Certificate<R>> {
        self.verdict.certificate()
    }

    /// The report with other figures.
    pub fn with<G>(self, figures: G) -> Report<R, G> {
        let Self { ended, exchanges, sweeps, active, verdict, .. } = self;
        Report { ended, exchanges, sweeps, active, verdict, figures }
    }
}
