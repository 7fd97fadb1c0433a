//! What a baked module takes of a device, and the type of its positions.

use signorini_device::sparse::storage;
use signorini_kernel::Index;
use signorini_kernel::rows::{QUADS, TRIANGLES};

use super::arrays::Baked;
use super::listing::listed;
use crate::Bakes;
use signorini_problem::scalar::Scalar;

/// What the model takes of a device, code and stack aside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sizes {
    /// Bytes of the `Controller`.
    pub ram: usize,
    /// Bytes of the statics.
    pub flash: usize,
}

/// The sizes, exact but for alignment.
pub fn sizes<R: Bakes>(baked: &Baked<R>) -> Sizes {
    let ram = match baked.index() {
        "u16" => memory::<R, u16>(baked),
        _ => memory::<R, u32>(baked),
    };
    Sizes { ram, flash: listed(baked).bytes }
}

/// Bytes of the controller, in the index type `I`.
fn memory<R: Bakes, I: Index>(baked: &Baked<R>) -> usize {
    let lengths = baked.lengths();
    let own = match baked.width() {
        TRIANGLES => lengths.bytes::<R, I, TRIANGLES>(),
        _ => lengths.bytes::<R, I, QUADS>(),
    };
    let exchanges = baked.factored.as_ref().map(|_| storage::bytes::<R>(lengths.active));
    own + exchanges.unwrap_or(0)
}

impl<R: Scalar> Baked<R> {
    /// What the record of `cargo xtask size` calls scenes with the code of this one.
    pub fn code(&self) -> &'static str {
        match (&self.factored, &self.stored) {
            (Some(_), _) => ", by a factor",
            (None, Some(_)) => ", in time",
            (None, None) => ", on ",
        }
    }

    /// Room in a packed row.
    pub(super) fn width(&self) -> usize {
        if self.of_quads.is_empty() { TRIANGLES } else { QUADS }
    }

    /// The index type: the shorter one that can number everything.
    pub(super) fn index(&self) -> &'static str {
        let half_edges = 3 * self.of_triangles.len() + 4 * self.of_quads.len();
        let addressable = (u16::LIMIT - 1) / size_of::<R>();
        let ends = 2 * self.counts.contact.max(self.counts.dirichlet);
        let numbered = half_edges.max(self.vertices.len()).max(ends);
        let short = numbered < u16::LIMIT && self.counts.edges() <= addressable;
        if short { "u16" } else { "u32" }
    }
}
