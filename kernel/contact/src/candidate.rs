//! A condensed answer as outputs and certificate read it: inputs, openings, residuals, and the ranges of these.

use crate::dense::ranges::Ranges;

/// An answer to judge (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Candidate<'a, R> {
    /// p, the constant 1 first.
    pub inputs: &'a [R],
    /// x ≥ 0, or of any sign that its range allows.
    pub x: &'a [R],
    /// Sx − b, less what the load of its side has beyond b.
    pub residual: &'a [R],
    /// Ranges of r.
    pub ranges: Ranges<'a, R>,
}
