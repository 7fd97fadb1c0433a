//! Bounds on all answers of a controller, known before any tick.

use signorini_certify::Column;

/// Facts on all answers of a controller.
#[derive(Debug, Clone, Copy, Default)]
pub struct Answers<'a> {
    /// How far s is above ψ at least at the ends of the contact edges that are open in all answers, in the order of the edges and in
    /// the unit of u; nothing where nothing is known.
    pub open: &'a [Option<[f64; 2]>],
    /// No more than ∫_E (τ·n − lo) on the contact edges that touch in all answers, 0 on all others; nothing where nothing is known.
    pub pressed: &'a [f64],
    /// The columns that s and τ are sums of, with each transfer coefficient at either end of its range: of no columns, of one or of two
    /// such sets.
    pub columns: &'a [Vec<Column>],
    /// A total as answers have it.
    pub total: f64,
    /// Whether all equations but those on contact edges hold, for all answers: those of a condensed model.
    pub are_balanced: bool,
}
