//! A fill-reducing elimination order that keeps the contact unknowns last.
//!
//! Approximate minimum degree orders the free block alone; the contact unknowns follow. The fill
//! towards C is not seen by the ordering, which costs little as C is a curve.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::perm::Perm;
use faer::sparse::linalg::amd;
use faer::sparse::{FaerError, SymbolicSparseColMatRef};

use super::problem::Matrix;

/// The order of elimination: position → unknown.
pub(super) fn contact_last(matrix: &Matrix) -> Result<Perm<u32>, FaerError> {
    let (n, free) = (matrix.unknowns(), matrix.free);
    let (col_ptr, row_idx) = free_block(matrix);
    let mut order: Box<[u32]> = (0..n as u32).collect();
    let mut position = order.clone();
    minimum_degree(&col_ptr, &row_idx, [&mut order[..free], &mut position[..free]])?;
    Ok(Perm::new_checked(order, position, n))
}

/// Approximate minimum degree on a symmetric pattern: `order` (position → unknown) and its inverse.
pub fn minimum_degree(
    col_ptr: &[u32],
    row_idx: &[u32],
    [order, position]: [&mut [u32]; 2],
) -> Result<(), FaerError> {
    let n = order.len();
    let pattern = SymbolicSparseColMatRef::new_unsorted_checked(n, n, col_ptr, None, row_idx);
    let scratch = amd::order_maybe_unsorted_scratch::<u32>(n, row_idx.len());
    let mut memory = MemBuffer::try_new(scratch).map_err(|_| FaerError::OutOfMemory)?;
    let (control, stack) = (amd::Control::default(), MemStack::new(&mut memory));
    amd::order_maybe_unsorted(order, position, pattern, control, stack).map(|_| ())
}

/// The pattern of K_FF: column starts and row indices.
fn free_block(matrix: &Matrix) -> (Vec<u32>, Vec<u32>) {
    let mut col_ptr = Vec::with_capacity(matrix.free + 1);
    let mut row_idx = Vec::with_capacity(matrix.col_idx.len());
    col_ptr.push(0);
    for unknown in 0..matrix.free {
        row_idx.extend(matrix.columns(unknown).iter().filter(|&&row| (row as usize) < matrix.free));
        col_ptr.push(row_idx.len() as u32);
    }
    (col_ptr, row_idx)
}
