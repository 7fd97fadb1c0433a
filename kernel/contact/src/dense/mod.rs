//! A dense contact problem, small and exact: x ≥ 0, Sx − b ≥ 0, xᵀ(Sx − b) = 0 with S scaled to a diagonal of 1, or more where a
//! transfer coefficient adds to it.
//!
//! It is what is left of a problem where everything but the contact edges has been eliminated: on the host
//! ([`crate`]) or by a sparse factor (`signorini_device::sparse`).
//!
//! [`blocks`] hold S, and `outer` makes it follow a transfer coefficient; [`sor`] sweeps over them; [`tableau`] and
//! [`pivoting`] solve exactly.

pub mod blocks;
mod correction;
mod falling;
#[cfg(feature = "transfer")]
pub mod outer;
pub mod pivoting;
pub mod ranges;
pub mod rule;
pub mod sizes;
pub mod sor;
pub mod tableau;

/// Arrays that a solve works on, with [`blocks::padded`] entries each (borrowed).
#[derive(Debug)]
pub struct Iterate<'a, R> {
    /// Where it starts; becomes x ≥ 0, or of any sign that its range allows, whatever ends the solve.
    pub x: &'a mut [R],
    /// Becomes Sx − b, less what the load of its side has beyond b ([`ranges`]).
    pub residual: &'a mut [R],
    /// Scratch.
    pub scratch: &'a mut [R],
    /// Becomes true where x is not 0.
    pub open: &'a mut [bool],
}

impl<R> Iterate<'_, R> {
    /// Borrows these arrays again.
    pub(crate) fn reborrow(&mut self) -> Iterate<'_, R> {
        Iterate { x: self.x, residual: self.residual, scratch: self.scratch, open: self.open }
    }
}
