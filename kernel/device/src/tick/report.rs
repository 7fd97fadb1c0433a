//! What a tick on a mesh says in the end.

use signorini_kernel::report;

/// An answer's report with the figures of its sweeps, which are counted since the tick began.
pub type Report<R> = report::Report<R, Figures<R>>;

/// What sweeps on a mesh leave to say.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Figures<R> {
    /// max |r_i|/K_ii over the unknowns, on contact edges |min(u_i − ψ_i, −r_i/K_ii)|.
    pub residual: R,
    /// Contact edges that became active or ceased to be since the report before.
    pub changes: u32,
    /// ∫_C (τ·n − q) ≥ 0, τ within the law of contact at any stop ([`signorini_kernel::contact`]).
    pub force: R,
    /// The relaxation factor.
    pub omega: R,
}
