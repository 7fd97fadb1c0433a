//! The bound over time, as controllers tell it.

/// The bound of the evolution until now: the root of the mean of ‖A^½∇(u − s)‖² + ∫_R h(u − s)², whose weights fade into the past.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window<R> {
    /// That root at most.
    pub energy: R,
    /// How far back the mean reaches, in the unit of time.
    pub seconds: R,
}
