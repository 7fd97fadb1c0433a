//! What a tick on a mesh says in the end.

use signorini_bound::certificate::Verdict;
use signorini_kernel::report::{self, Ended};

/// An answer with the figures of its sweeps: the iterate is feasible in every case but [`Ended::NotFinite`].
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
    /// ∫_C (τ·n − q) ≥ 0, τ within the law of contact at any stop ([`signorini_kernel::contact`]).
    pub force: R,
    /// How wrong it can be.
    pub verdict: Verdict<R>,
    /// The relaxation factor.
    pub omega: R,
}

impl<R> From<Report<R>> for report::Report<R> {
    /// What it has in common with every model; exchanges are known to [`crate::sparse::Exact::solved`].
    fn from(report: Report<R>) -> Self {
        let Report { ended, sweeps, active, verdict, .. } = report;
        Self { ended, exchanges: 0, sweeps, active, verdict }
    }
}
