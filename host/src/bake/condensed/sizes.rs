//! What a condensed model takes of a device, from its sizes alone.

use signorini_kernel::condensed::blocks::{count, padded};

use super::arrays::{Baked, Solver};
use crate::bake::full::Sizes;
use crate::scalar::Scalar;

/// Bytes of a block of the matrix, in numbers.
const BLOCK: usize = 64;

/// RAM of the `Controller` and flash of its data, exact but for alignment and lengths of slices.
pub fn sizes<R: Scalar>(baked: &Baked<R>) -> Sizes {
    let (n, scalar) = (padded(baked.contact), baked.scalar());
    let columns = baked.columns();
    let tableau = match baked.solver() {
        Solver::Exchanges(_) => (BLOCK * count(baked.contact) + 2 * n) * scalar + n,
        _ => 0,
    };
    let outputs = baked.outputs.len() * (baked.inputs + baked.contact);
    let bound = baked.bound.as_ref().map_or(0, |bound| {
        let corners: usize = bound.corners.iter().map(|(_, excess)| excess.len() + 1).sum();
        let numbers = bound.columns.len() + columns + corners + bound.floating.len();
        (numbers + 2 * baked.inputs) * scalar + bound.vertices.len() * (8 + 2 * scalar)
    });
    Sizes {
        ram: (4 * n + 2 * columns) * scalar + n + tableau,
        flash: (BLOCK * (baked.matrix.len() + baked.start.blocks.len()) + n) * scalar
            + baked.start.exchanged.len()
            + (baked.load.len() + outputs) * scalar
            + bound,
    }
}
