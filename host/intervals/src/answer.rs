//! Answers that intervals are worked out from.

use signorini_certify::{CertifiedFields, ErrorBound};
use signorini_solve::{ScalarKind, Solution};

/// An answer of a solve or a tick.
#[derive(Debug, Clone, Copy)]
pub struct Answered<'a> {
    /// s and τ.
    pub certified: &'a CertifiedFields,
    /// How wrong they may be.
    pub bound: Option<ErrorBound>,
    /// The scalar that they were worked out in.
    pub scalar: ScalarKind,
}

impl<'a> From<&'a Solution> for Answered<'a> {
    fn from(Solution { certified, bound, scalar, .. }: &'a Solution) -> Self {
        Self { certified, bound: *bound, scalar: *scalar }
    }
}
