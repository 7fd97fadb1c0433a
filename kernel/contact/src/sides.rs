//! Where s − ψ comes from at the ends of contact edges, for models whose fluxes have limits.

use signorini_kernel::{Real, features};

/// No vertex: s = ψ at this end.
pub const ON_GAP: u16 = u16::MAX;

/// Where s − ψ comes from at the ends of contact edges (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Sides<'a, R> {
    baked: Option<Baked<'a, R>>,
}

/// Numbers that the host has worked out for it.
#[derive(Debug, Clone, Copy)]
pub struct Baked<'a, R> {
    /// For both ends of every contact edge its number among the vertices; from there on that of a corner; or [`ON_GAP`].
    pub ends: &'a [[u16; 2]],
    /// U / d_i: values of s − ψ, in the unit of U, times this are in that of 1/r_i.
    pub scale: &'a [R],
    /// By how much |E| (hi − lo) may exceed its mean, in the unit of r.
    pub excess: R,
    /// The largest finite span of each input's column.
    pub largest: &'a [R],
}

impl<'a, R: Real> Sides<'a, R> {
    /// No flux has a limit.
    pub const UNLIMITED: Self = Self { baked: None };

    /// Some have.
    pub const fn new(baked: Baked<'a, R>) -> Self {
        Self { baked: Some(baked) }
    }

    #[inline(always)]
    pub(super) fn are_limited(&self) -> bool {
        self.baked().is_some()
    }

    #[inline(always)]
    pub(super) fn baked(&self) -> Option<&Baked<'a, R>> {
        if features::LIMITED { self.baked.as_ref() } else { None }
    }
}
