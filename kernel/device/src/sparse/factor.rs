//! K_II = L D Lᵀ and the Schur complement on the contact edges, row by row.
//!
//! Row k of L is the solution of a triangular system with the rows above it:
//! ```text
//!   y = K_k·;   for each column j of row k, in the order of elimination:
//!       y_i ← y_i − L_ij y_j for the rows i < k that column j has,    L_kj = y_j / D_j
//!   D_k = y_k − Σ_j L_kj y_j
//! ```
//! For a contact row k the same loop leaves row k of S = K_CC − K_CI K_II⁻¹ K_IC in y. Each entry of L is
//! written once, at the end of its column, and nothing is searched for.

use super::elimination::Pattern;
use signorini_contact::dense::blocks::{Block, SIDE, count};
use signorini_kernel::Real;
use signorini_kernel::csr::Csr;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::index::{Index, read, write};
use signorini_kernel::mesh::edges::EdgeCounts;

/// Memory for a [`Factor`].
#[derive(Debug)]
pub struct FactorBuffers<'a, R, I> {
    /// Becomes the row of each entry of L: [`Pattern::entries`].
    pub rows: &'a mut [I],
    /// Becomes the entries of L.
    pub values: &'a mut [R],
    /// Becomes 1/D, one entry a free unknown.
    pub inverse: &'a mut [R],
    /// Becomes the end of each column, one entry a free unknown.
    pub ends: &'a mut [u32],
    /// Scratch, one entry a free unknown.
    pub path: &'a mut [I],
    /// Scratch, one entry a free unknown.
    pub visited: &'a mut [I],
    /// Scratch, one entry an unknown.
    pub row: &'a mut [R],
}

/// L and D (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Factor<'a, R, I> {
    places: &'a [I],
    pointers: &'a [u32],
    rows: &'a [I],
    values: &'a [R],
    inverse: &'a [R],
    counts: EdgeCounts,
}

/// A pivot may fall to this many ε of the diagonal that it began as: below, rounding has eaten it.
const EATEN: u32 = 16;

impl<'a, R: Real, I: Index> Factor<'a, R, I> {
    /// Factors `matrix`; `schur` becomes S as the lower triangle of its blocks
    /// ([`signorini_contact::dense::blocks`]), padded with zeros.
    ///
    /// `None` where a pivot vanishes: K_II is singular as far as the scalar can tell.
    ///
    /// # Errors
    /// Memory of the wrong length, a matrix of another pattern.
    pub fn new(
        matrix: &Csr<R, I>,
        pattern: Pattern<'a, I>,
        buffers: FactorBuffers<'a, R, I>,
        schur: &mut [Block<R>],
    ) -> Result<Option<Self>, Error> {
        let counts = pattern.counts();
        same_length(Array::RowPointers, matrix.rows(), counts.unknowns())?;
        same_length(Array::MatrixValues, buffers.rows.len(), pattern.entries())?;
        same_length(Array::MatrixValues, buffers.values.len(), pattern.entries())?;
        let FactorBuffers { rows, values, inverse, ends, path, visited, row } = buffers;
        for length in [inverse.len(), ends.len(), path.len(), visited.len()] {
            same_length(Array::Scratch, length, counts.free)?;
        }
        same_length(Array::Scratch, row.len(), counts.unknowns())?;
        same_length(Array::MatrixValues, schur.len(), count(counts.contact))?;
        row.fill(R::ZERO);
        visited.fill(I::NONE);
        schur.fill([[R::ZERO; SIDE]; SIDE]);
        for (end, place) in ends.iter_mut().zip(0..) {
            *end = pattern.start(place) as u32;
        }
        let mut growing = Growing { pattern, rows, values, inverse, ends, path, visited, row };
        for k in 0..counts.unknowns() {
            let own = matrix.row(pattern.unknown(k));
            let first = growing.scatter(&own, k)?;
            let pivot = growing.eliminate(k, first)?;
            if k < counts.free {
                if !(pivot > R::from_count(EATEN) * R::EPSILON * own.diagonal()) {
                    return Ok(None);
                }
                write(growing.inverse, k, R::ONE / pivot);
            } else {
                growing.leave(k, pivot, schur);
            }
        }
        let Growing { rows, values, inverse, .. } = growing;
        let (places, pointers) = (pattern.places(), pattern.pointers());
        Ok(Some(Self { places, pointers, rows, values, inverse, counts }))
    }

    /// Takes what another machine has factored: the place of each free unknown, where the columns of L
    /// start (and end: one more), their rows and entries, and 1/D by places. Nothing is checked: wrong
    /// numbers make wrong answers and nothing worse.
    pub const fn baked(
        places: &'a [I],
        pointers: &'a [u32],
        rows: &'a [I],
        values: &'a [R],
        inverse: &'a [R],
        counts: EdgeCounts,
    ) -> Self {
        Self { places, pointers, rows, values, inverse, counts }
    }

    /// Sizes of the blocks of u.
    pub fn counts(&self) -> EdgeCounts {
        self.counts
    }

    /// The place of an unknown: of a contact unknown its number.
    pub fn place(&self, unknown: usize) -> usize {
        if unknown < self.counts.free { read(self.places, unknown).at() } else { unknown }
    }

    /// y = L⁻¹ r_I and b = r_C − L_CI y, in place. `y` has one entry an unknown, by places.
    pub fn eliminate(&self, y: &mut [R]) {
        for j in 0..self.counts.free {
            let own = read(y, j);
            for (row, value) in self.column(j) {
                if let Some(entry) = y.get_mut(row) {
                    *entry -= value * own;
                }
            }
        }
    }

    /// z_I = L⁻ᵀ (D⁻¹ y − L_CIᵀ v), in place; v stands behind y.
    pub fn substitute(&self, y: &mut [R]) {
        for j in (0..self.counts.free).rev() {
            let start = read(y, j) * read(self.inverse, j);
            let sum = self.column(j).fold(start, |sum, (row, value)| sum - value * read(y, row));
            write(y, j, sum);
        }
    }

    /// (row, entry) of column j of L.
    fn column(&self, j: usize) -> impl Iterator<Item = (usize, R)> + use<'_, R, I> {
        let range = read(self.pointers, j) as usize..read(self.pointers, j + 1) as usize;
        let rows = self.rows.get(range.clone()).unwrap_or(&[]);
        let values = self.values.get(range).unwrap_or(&[]);
        rows.iter().zip(values).map(|(row, &value)| (row.at(), value))
    }
}

/// A factor with its rows up to some k; `row` is y, zeros between rows.
struct Growing<'a, R, I> {
    pattern: Pattern<'a, I>,
    rows: &'a mut [I],
    values: &'a mut [R],
    inverse: &'a mut [R],
    ends: &'a mut [u32],
    path: &'a mut [I],
    visited: &'a mut [I],
    row: &'a mut [R],
}

impl<R: Real, I: Index> Growing<'_, R, I> {
    /// y = K_k·, and the columns of row k in the order of elimination from `path[first]` on.
    fn scatter(
        &mut self,
        own: &signorini_kernel::csr::Row<R, I>,
        k: usize,
    ) -> Result<usize, Error> {
        let counts = self.pattern.counts();
        let limit = I::LIMIT;
        let row = I::new(k).ok_or(Error::Capacity { of: Array::Unknowns, needed: k + 1, limit })?;
        let mut first = counts.free;
        for (column, value) in own.entries().filter(|(column, _)| *column < counts.unknowns()) {
            let mut at = self.pattern.place(column);
            if at <= k {
                write(self.row, at, read(self.row, at) + value);
            }
            let mut length = 0;
            while at < counts.free.min(k) && read(self.visited, at) != row {
                write(self.visited, at, row);
                write(self.path, length, index(at));
                length += 1;
                at = self.pattern.parent(at);
            }
            // A path leads towards the root: put before the ones found so far, it keeps the order.
            while length > 0 && first > 0 {
                (first, length) = (first - 1, length - 1);
                write(self.path, first, read(self.path, length));
            }
        }
        Ok(first)
    }

    /// Row k of L; returns D_k.
    fn eliminate(&mut self, k: usize, first: usize) -> Result<R, Error> {
        let mut pivot = core::mem::take(self.row.get_mut(k).unwrap_or(&mut R::default()));
        for step in first..self.path.len() {
            let j = read(self.path, step).at();
            let own = core::mem::take(self.row.get_mut(j).unwrap_or(&mut R::default()));
            let (start, end) = (self.pattern.start(j), read(self.ends, j) as usize);
            let rows = self.rows.get(start..end).unwrap_or(&[]);
            for (row, &value) in rows.iter().zip(self.values.get(start..).unwrap_or(&[])) {
                if let Some(entry) = self.row.get_mut(row.at()) {
                    *entry -= value * own;
                }
            }
            let entry = own * read(self.inverse, j);
            pivot -= entry * own;
            if end >= self.pattern.start(j + 1) {
                return Err(Error::OutOfRange { of: Array::MatrixValues, at: end });
            }
            write(self.rows, end, index(k));
            write(self.values, end, entry);
            write(self.ends, j, end as u32 + 1);
        }
        Ok(pivot)
    }

    /// Moves row k of S out of y.
    fn leave(&mut self, k: usize, pivot: R, schur: &mut [Block<R>]) {
        let free = self.pattern.counts().free;
        let at = k - free;
        for (other, entry) in self.row.iter_mut().skip(free).take(at).enumerate() {
            let value = core::mem::take(entry);
            set(schur, at, other, value);
            if at / SIDE == other / SIDE {
                set(schur, other, at, value);
            }
        }
        set(schur, at, at, pivot);
    }
}

/// Sets entry (row, column) of the blocks.
fn set<R: Real>(blocks: &mut [Block<R>], row: usize, column: usize, value: R) {
    let position = count(row / SIDE * SIDE) + column / SIDE;
    let block = blocks.get_mut(position).and_then(|block| block.get_mut(row % SIDE));
    if let Some(entry) = block.and_then(|row| row.get_mut(column % SIDE)) {
        *entry = value;
    }
}

/// S to a diagonal of 1, `scale` to 1/√S_ii; false where an entry on the diagonal is not positive.
pub fn normalise<R: Real>(schur: &mut [Block<R>], scale: &mut [R], order: usize) -> bool {
    let mut positive = true;
    scale.fill(R::ZERO);
    for (row, scale) in scale.iter_mut().enumerate().take(order) {
        let position = count(row / SIDE * SIDE) + row / SIDE;
        let line = schur.get(position).and_then(|block| block.get(row % SIDE));
        let diagonal = line.map_or(R::ZERO, |line| read(line, row % SIDE));
        *scale = R::ONE / diagonal.rounded_sqrt();
        positive &= diagonal > R::ZERO && scale.finite();
    }
    let mut blocks = schur.iter_mut();
    for row in 0..order.div_ceil(SIDE) {
        for (column, block) in blocks.by_ref().take(row + 1).enumerate() {
            for (r, line) in block.iter_mut().enumerate() {
                for (c, entry) in line.iter_mut().enumerate() {
                    *entry *= read(scale, row * SIDE + r) * read(scale, column * SIDE + c);
                }
            }
        }
    }
    positive
}

/// A place that is below the limit, as the pattern has shown.
fn index<I: Index>(position: usize) -> I {
    I::new(position).unwrap_or(I::NONE)
}
