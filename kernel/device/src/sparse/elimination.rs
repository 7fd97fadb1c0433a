//! The pattern of L: which entries elimination fills.
//!
//! Eliminating an unknown couples all that it was coupled with. The tree of elimination says it all: the
//! parent of place j is the first row below the diagonal in column j of L, and row k of L has the places on
//! the paths from the entries of K's row k towards the root (Liu). One walk along these paths counts the
//! entries of every column, in as much time as there are entries.
//!
//! Places 0..free are the free unknowns in the order of their elimination; contact unknowns keep their numbers
//! and are rows only.

use signorini_kernel::Real;
use signorini_kernel::csr::Csr;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::index::{Index, read, write};
use signorini_kernel::mesh::edges::EdgeCounts;

/// Memory for a [`Pattern`], one entry a free unknown each, and one more in `pointers`.
#[derive(Debug)]
pub struct PatternBuffers<'a, I> {
    /// Becomes the place of each free unknown.
    pub place: &'a mut [I],
    /// Becomes the tree.
    pub parent: &'a mut [I],
    /// Scratch.
    pub visited: &'a mut [I],
    /// Becomes the start of each column of L, and the number of its entries.
    pub pointers: &'a mut [u32],
}

/// Where the entries of L stand (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Pattern<'a, I> {
    order: &'a [I],
    place: &'a [I],
    parent: &'a [I],
    pointers: &'a [u32],
    counts: EdgeCounts,
}

impl<'a, I: Index> Pattern<'a, I> {
    /// The pattern of L for `matrix`, whose free unknowns are eliminated as `order` says: each of them once.
    ///
    /// # Errors
    /// An order that leaves an unknown out or names one twice; buffers of the wrong length; more entries
    /// than 32 bits count.
    pub fn new<R: Real>(
        matrix: &Csr<R, I>,
        counts: EdgeCounts,
        order: &'a [I],
        buffers: PatternBuffers<'a, I>,
    ) -> Result<Self, Error> {
        let PatternBuffers { place, parent, visited, pointers } = buffers;
        same_length(Array::RowPointers, matrix.rows(), counts.unknowns())?;
        for length in [order.len(), place.len(), parent.len(), visited.len()] {
            same_length(Array::Unknowns, length, counts.free)?;
        }
        same_length(Array::RowPointers, pointers.len(), counts.free + 1)?;
        invert(order, place)?;
        parent.fill(I::NONE);
        visited.fill(I::NONE);
        pointers.fill(0);
        let mut pattern = Growing { place, parent, visited, pointers };
        for k in 0..counts.unknowns() {
            let unknown = if k < counts.free { read(order, k).at() } else { k };
            let row = index::<I>(k)?;
            for (column, _) in matrix.row(unknown).entries() {
                pattern.walk(column, k, row);
            }
        }
        let Growing { place, parent, pointers, .. } = pattern;
        add_up(pointers)?;
        Ok(Self { order, place, parent, pointers, counts })
    }

    /// How many entries L has below its diagonal, rows of contact unknowns included.
    pub fn entries(&self) -> usize {
        self.pointers.last().map_or(0, |&entries| entries as usize)
    }

    /// Sizes of the blocks of u.
    pub fn counts(&self) -> EdgeCounts {
        self.counts
    }

    /// The unknown that is eliminated at `place`.
    pub(super) fn unknown(&self, place: usize) -> usize {
        if place < self.counts.free { read(self.order, place).at() } else { place }
    }

    /// The place of an unknown.
    pub(super) fn place(&self, unknown: usize) -> usize {
        if unknown < self.counts.free { read(self.place, unknown).at() } else { unknown }
    }

    /// The place of each free unknown.
    pub(super) fn places(&self) -> &'a [I] {
        self.place
    }

    /// Where the columns of L start; one more is where the last one ends.
    pub(super) fn pointers(&self) -> &'a [u32] {
        self.pointers
    }

    /// The next place on the way to the root.
    pub(super) fn parent(&self, place: usize) -> usize {
        read(self.parent, place).at()
    }

    /// Where column `place` of L begins.
    pub(super) fn start(&self, place: usize) -> usize {
        read(self.pointers, place) as usize
    }
}

/// A pattern whose rows are still being walked; `pointers` counts entries.
struct Growing<'a, I> {
    place: &'a mut [I],
    parent: &'a mut [I],
    visited: &'a mut [I],
    pointers: &'a mut [u32],
}

impl<I: Index> Growing<'_, I> {
    /// Adds row `k` to the columns between `column` and the root that do not have it yet.
    fn walk(&mut self, column: usize, k: usize, row: I) {
        let free = self.place.len();
        if column >= free {
            return;
        }
        let mut at = read(self.place, column).at();
        while at < free && at < k && read(self.visited, at) != row {
            write(self.visited, at, row);
            if let Some(count) = self.pointers.get_mut(at) {
                *count = count.saturating_add(1);
            }
            if read(self.parent, at) == I::NONE {
                write(self.parent, at, row);
            }
            at = read(self.parent, at).at();
        }
    }
}

/// `place[order[k]]` = k, for every k once.
fn invert<I: Index>(order: &[I], place: &mut [I]) -> Result<(), Error> {
    place.fill(I::NONE);
    for (at, unknown) in order.iter().enumerate() {
        let stray = Error::OutOfRange { of: Array::Unknowns, at };
        let entry = place.get_mut(unknown.at()).filter(|entry| **entry == I::NONE).ok_or(stray)?;
        *entry = index(at)?;
    }
    Ok(())
}

fn index<I: Index>(position: usize) -> Result<I, Error> {
    let limit = I::LIMIT;
    I::new(position).ok_or(Error::Capacity { of: Array::Unknowns, needed: position + 1, limit })
}

/// Counts become starts.
fn add_up(pointers: &mut [u32]) -> Result<(), Error> {
    let mut sum: u32 = 0;
    for pointer in pointers {
        let count = core::mem::replace(pointer, sum);
        let limit = u32::MAX as usize;
        sum = sum.checked_add(count).ok_or(Error::Capacity {
            of: Array::MatrixValues,
            needed: limit,
            limit,
        })?;
    }
    Ok(())
}
