//! What the state of a full model that steps in time is made of.
//!
//! ```text
//!   u │ s │ its bubbles │ openings │ B │ search for ω │ contact edges that were active        hash of the scene, checksum of all
//! ```
//! Rows, loads and fluxes are not among them: the next tick makes its own.

use super::Lengths;

/// The numbers that a search for ω leaves.
const OF_SEARCH: usize = 5;

impl Lengths {
    /// How many numbers one tick hands on to the next: the room of a [`super::State`].
    pub const fn handed_on(&self) -> usize {
        let [u, vertices, bubbles] = self.numbers.begin;
        let of_bound = self.numbers.openings + self.numbers.carried;
        u + vertices + bubbles + of_bound + OF_SEARCH + self.active
    }
}
