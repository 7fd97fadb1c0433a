//! The cells among the elements: corners resolved, each cell once.

use super::draft::{Draft, Element, Parsed};
use super::index::NodeIndex;

/// An element with the places of its nodes in the file.
pub(super) struct Resolved<'a> {
    pub(super) element: &'a Element,
    corners: [u32; 4],
}

impl<'a> Resolved<'a> {
    pub(super) fn new(draft: &Draft, index: &NodeIndex, element: &'a Element) -> Parsed<Self> {
        Ok(Self { element, corners: index.resolve(draft, element)? })
    }

    pub(super) fn corners(&self) -> &[u32] {
        &self.corners[..self.element.kind.corners()]
    }

    /// The corners in ascending order.
    fn key(&self) -> [u32; 4] {
        let mut key = [u32::MAX; 4];
        key[..self.corners().len()].copy_from_slice(self.corners());
        key.sort_unstable();
        key
    }
}

/// The cells without repetition, in order, and for each cell its number among them.
///
/// Strictly convex cells with the same corners are the same cell.
pub(super) fn distinct<'c, 'a>(cells: &'c [Resolved<'a>]) -> (Vec<&'c Resolved<'a>>, Vec<u32>) {
    let mut sorted: Vec<_> = cells.iter().map(Resolved::key).zip(0u32..).collect();
    sorted.sort_unstable();
    let mut first = vec![0; cells.len()];
    for equal in sorted.chunk_by(|a, b| a.0 == b.0) {
        for &(_, cell) in equal {
            first[cell as usize] = equal[0].1;
        }
    }
    let mut distinct = Vec::with_capacity(cells.len());
    let mut number = vec![0; cells.len()];
    for (cell, &first) in first.iter().enumerate() {
        if first as usize == cell {
            number[cell] = distinct.len() as u32;
            distinct.push(&cells[cell]);
        } else {
            number[cell] = number[first as usize];
        }
    }
    (distinct, number)
}
