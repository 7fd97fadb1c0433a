//! Packed rows: the matrix as a sweep wants it, divided by its diagonal and times ω beforehand.
//!
//! ```text
//!   row i:   ω b_i / K_ii  |  ω K_ij / K_ii for each j ≠ i  |  position of each u_j in bytes
//! ```
//! An edge has two cells and each lends its other sides, so a row has room for [`TRIANGLES`] = 4
//! entries where all cells are triangles and for [`QUADS`] = 6 elsewhere; what it has less is filled
//! up with zeros times its own u. A sweep then needs no row pointer, no division and no shift of an
//! index: on a Cortex-M4 that is worth a factor 4 over CSR (`host/bake/records/cost.txt` has the record).
//!
//! Rows are filled from CSR ([`Rows::set`]) or, where memory is dear, straight from the element
//! matrices ([`Rows::gather`]), with the same bits. A new ω, matrix or load asks for them anew.

use crate::csr::Csr;
use crate::error::{Array, Error, same_length};
use crate::index::{Index, read, write};
use crate::mesh::edges::{EdgeCounts, Edges};
use crate::system::System;
use crate::{Real, features};

/// Room in a row where all cells are triangles.
pub const TRIANGLES: usize = 4;
/// Room in a row where some cells are quads.
pub const QUADS: usize = 6;

mod gather;
mod owned;

pub use owned::{LayOut, OwnedRows};

/// One row, as memory that the caller owns; its contents are the business of [`Rows`].
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Row<R, I, const WIDTH: usize> {
    load: R,
    entries: [R; WIDTH],
    offsets: [I; WIDTH],
}

impl<R: Real, I: Index, const WIDTH: usize> Row<R, I, WIDTH> {
    /// A row of zeros.
    pub const EMPTY: Self =
        Self { load: R::ZERO, entries: [R::ZERO; WIDTH], offsets: [I::FIRST; WIDTH] };

    /// ω b_i / K_ii
    #[inline(always)]
    pub(crate) fn load(&self) -> R {
        self.load
    }

    /// ω K_ij / K_ii
    #[inline(always)]
    pub(crate) fn entries(&self) -> &[R; WIDTH] {
        &self.entries
    }

    /// Positions of u_j in bytes: multiples of the size of `R`, inside of u.
    #[inline(always)]
    pub(crate) fn offsets(&self) -> &[I; WIDTH] {
        &self.offsets
    }

    /// ω / K_ii of a contact edge, 0 in a build without limits. It stands behind the entries that such an edge has.
    #[inline(always)]
    pub(crate) fn softness(&self) -> R {
        if features::LIMITED { read(&self.entries, WIDTH / 2) } else { R::ZERO }
    }

    fn soften(&mut self, softness: R) {
        write(&mut self.entries, WIDTH / 2, softness);
    }

    /// Takes b_i and K_ij times `scale` = ω / K_ii; what has no entry stays.
    #[inline(always)]
    fn put<const N: usize>(&mut self, entries: [R; N], load: R, scale: R) {
        self.load = load * scale;
        self.entries.iter_mut().zip(entries).for_each(|(place, entry)| *place = entry * scale);
    }
}

impl<R: Real, I: Index, const WIDTH: usize> Default for Row<R, I, WIDTH> {
    fn default() -> Self {
        Self::EMPTY
    }
}

/// The rows of all unknowns, in the order of [`Edges`] (borrowed).
///
/// Every offset in them was computed here from a validated numbering and names an entry of an array
/// over `counts.edges()` edges, or was found to do so in memory that they own; nothing else can write an offset.
/// [`crate::psor`] relies on it.
#[derive(Debug)]
pub struct Rows<'a, R, I, const WIDTH: usize> {
    rows: &'a mut [Row<R, I, WIDTH>],
    counts: EdgeCounts,
    omega: R,
}

impl<'a, R: Real, I: Index, const WIDTH: usize> Rows<'a, R, I, WIDTH> {
    /// Symbolic pass: takes one row an unknown and writes where its neighbours stand. The values are
    /// zeros until they are set.
    ///
    /// # Errors
    /// A wrong number of rows, more neighbours than a row has room for (half of it on contact edges,
    /// which have one cell), more edges than `I` can address: 16 383 in `f32` and 8 191 in `f64` for `u16`.
    pub fn new(edges: &Edges<I>, rows: &'a mut [Row<R, I, WIDTH>]) -> Result<Self, Error> {
        let neighbours = |i| edges.neighbours(i).map(Index::at);
        Self::lay_out(edges.counts(), rows, neighbours)
    }

    /// Packed rows of any matrix with a row for each of the unknowns.
    ///
    /// # Errors
    /// As for [`Rows::new`], and columns that are no edges.
    pub fn of_matrix(
        matrix: &Csr<R, I>,
        counts: EdgeCounts,
        rows: &'a mut [Row<R, I, WIDTH>],
    ) -> Result<Self, Error> {
        same_length(Array::RowPointers, matrix.rows(), counts.unknowns())?;
        let mut given = matrix.iter();
        Self::lay_out(counts, rows, |_| {
            let row = given.next().into_iter();
            row.flat_map(|row| row.entries().skip(1).map(|(column, _)| column))
        })
    }

    fn lay_out<N: Iterator<Item = usize>>(
        counts: EdgeCounts,
        rows: &'a mut [Row<R, I, WIDTH>],
        mut neighbours: impl FnMut(usize) -> N,
    ) -> Result<Self, Error> {
        const { assert!(WIDTH.is_multiple_of(2), "two offsets are read as one word") };
        same_length(Array::Rows, rows.len(), counts.unknowns())?;
        let limit = (I::LIMIT - 1) / size_of::<R>();
        if counts.edges() > limit {
            return Err(Error::Capacity { of: Array::Edges, needed: counts.edges(), limit });
        }
        let stray = Error::OutOfRange { of: Array::ColumnIndices, at: 0 };
        let offset = |edge: usize| {
            let inside = (edge < counts.edges()).then_some(edge * size_of::<R>());
            inside.and_then(I::new).ok_or(stray)
        };
        for (i, row) in rows.iter_mut().enumerate() {
            *row = Row { offsets: [offset(i)?; WIDTH], ..Row::EMPTY };
            let mut needed = 0;
            for edge in neighbours(i) {
                let offset = offset(edge)?;
                if let Some(place) = row.offsets.get_mut(needed) {
                    *place = offset;
                }
                needed += 1;
            }
            // A contact edge lies on the boundary: a sweep reads half of its row.
            let limit = if i < counts.free { WIDTH } else { WIDTH / 2 };
            if needed > limit {
                return Err(Error::Capacity { of: Array::Rows, needed, limit });
            }
        }
        Ok(Self { rows, counts, omega: R::ONE })
    }

    /// Numeric pass from CSR: the rows of `system`, which must be numbered by the same edges.
    ///
    /// # Errors
    /// A system of another size.
    pub fn set(&mut self, system: &System<R, I>, omega: R) -> Result<(), Error> {
        same_length(Array::Rows, self.rows.len(), system.counts().unknowns())?;
        self.omega = omega;
        let given = system.matrix().iter().zip(system.load()).enumerate();
        for (row, (i, (of_matrix, &load))) in self.rows.iter_mut().zip(given) {
            let mut entries = [R::ZERO; WIDTH];
            let others = of_matrix.entries().skip(1);
            entries.iter_mut().zip(others).for_each(|(place, (_, value))| *place = value);
            row.put(entries, load, omega / of_matrix.diagonal());
            if features::LIMITED && i >= self.counts.free {
                row.soften(omega / of_matrix.diagonal());
            }
        }
        Ok(())
    }

    /// The factor ω that the rows hold.
    pub fn omega(&self) -> R {
        self.omega
    }

    /// Sizes of the blocks of u.
    pub fn counts(&self) -> EdgeCounts {
        self.counts
    }

    /// b_i / K_ii
    pub fn loads(&self) -> impl Iterator<Item = R> {
        let per_omega = R::ONE / self.omega;
        self.rows.iter().map(move |row| row.load * per_omega)
    }

    /// The rows of free edges.
    pub(crate) fn free(&self) -> &[Row<R, I, WIDTH>] {
        self.rows.get(..self.counts.free).unwrap_or(&[])
    }

    /// The rows of contact edges.
    pub(crate) fn contact(&self) -> &[Row<R, I, WIDTH>] {
        self.rows.get(self.counts.free..).unwrap_or(&[])
    }
}
