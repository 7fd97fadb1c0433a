//! Verdict on how wrong an answer is, whatever model of a scene gave it.
//!
//! `signorini_bound::certificate` finds it on a mesh, `signorini_contact` in a problem of contact edges alone.

use crate::real::Real;

/// How wrong (s, τ) can be, in the energy norm.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Certificate<R> {
    /// The root of gap²: the bound where f, g and q have no oscillation.
    pub duality_gap: R,
    /// ‖A^{−½}(τ − σ_h)‖, with ∫_R ((τ − σ_h)·n)²/h where there is a Robin boundary: what more sweeps
    /// would remove. Early in a solve it may be more than the total: reports of ticks call that the total
    /// ([`Certificate::as_parts`]).
    pub algebraic: R,
    /// Oscillation that was given.
    pub oscillation: R,
    /// Part that rounding can have hidden.
    pub rounding: R,
    /// oscillation + √(gap² + oscillation²) + rounding: never less than the error of s and τ.
    pub total: R,
    /// total + ‖A^½∇_h(s − u_h)‖: never less than ‖A^½∇_h(u − u_h)‖, the error of the edge means in the energy norm,
    /// cell by cell. Where s lifts curved boundary data on distorted quads, the norm of that is added to that of the rest.
    pub of_u: R,
    /// Never more than ‖A^{−½}τ − A^½∇s‖, with its part on R: what of the gap is no matter of contact. 0 where nothing is said of it.
    pub distance: R,
}

impl<R: Real> Certificate<R> {
    /// The certificate with an algebraic part that is no more than the total it is a part of.
    #[must_use]
    pub fn as_parts(self) -> Self {
        if self.algebraic > self.total { Self { algebraic: self.total, ..self } } else { self }
    }
}

crate::codes! {
    /// Whether there is a bound on the error of an iterate, or why there is none.
    #[derive(Debug, Clone, Copy, PartialEq)]
    Verdict<R> {
        /// There is a bound.
        /// The error is at most its total.
        Certified(Certificate<R>) = 0 c"CERTIFIED",
        /// None: only contact edges can take the surplus of a part, and one would be pulled at.
        Pulled {
            /// That edge.
            edge: usize,
        } = 1 c"PULLED",
        /// None: contact alone holds the domain, and no edge is pressed hard enough.
        /// One would have to take the surplus of the domain.
        Unpressed = 2 c"UNPRESSED",
        /// None: a given value lies below the gap where they meet.
        /// No u has both.
        BelowGap = 3 c"BELOW_GAP",
        /// None, whatever the inputs: the data do not allow for one.
        /// u_D or ψ jumps, say, or a transfer coefficient nearly vanishes; `signorini bake` says which.
        Unavailable = 4 c"UNAVAILABLE",
        /// None: the numbers overflow.
        NotFinite = 5 c"BOUND_NOT_FINITE",
        /// None: the scene asks for none.
        /// The method of the tick is one without a bound.
        NotAsked = 6 c"NOT_ASKED",
    }
}

impl<R: Real> Verdict<R> {
    /// The verdict with [`Certificate::as_parts`].
    #[must_use]
    pub fn as_parts(self) -> Self {
        match self {
            Self::Certified(certificate) => Self::Certified(certificate.as_parts()),
            other => other,
        }
    }

    /// The certificate, where there is one.
    pub fn certificate(&self) -> Option<&Certificate<R>> {
        match self {
            Self::Certified(certificate) => Some(certificate),
            Self::Pulled { .. }
            | Self::Unpressed
            | Self::BelowGap
            | Self::Unavailable
            | Self::NotFinite
            | Self::NotAsked => None,
        }
    }
}
