//! A column of s and τ, where these are sums over inputs and unknowns.

use super::CertifiedFields;
use signorini_problem::Problem;

/// A column of s and τ.
#[derive(Debug, Clone)]
pub struct Column {
    /// The problem in which this column is left alone.
    pub problem: Problem,
    /// s and τ.
    pub certified: CertifiedFields,
    /// The flux of each transfer law, ∫h (u_ext − u), where a coefficient changes: in a sum of columns that is ∫τ·n. Else nothing.
    pub laws: Vec<f64>,
}
