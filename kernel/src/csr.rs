//! Compressed sparse rows over the unknowns, the diagonal first in every row.
//!
//! ```text
//!   row i:  values[row_ptr[i]] = K_ii,  then up to row_ptr[i + 1] the other sides of i's cells
//!           columns run over *all* edges: those of Dirichlet edges multiply u_D, which stands in
//!           u behind the unknowns, so that a new u_D changes neither matrix nor load.
//! ```

use crate::Real;
use crate::error::{Array, Error, all_finite, same_length};
use crate::index::{Index, read};

/// A matrix with one row an unknown and one column an edge (borrowed, validated).
#[derive(Debug, Clone, Copy)]
pub struct Csr<'a, R, I> {
    row_ptr: &'a [u32],
    col_idx: &'a [I],
    values: &'a [R],
}

impl<'a, R: Real, I: Index> Csr<'a, R, I> {
    /// Takes a matrix with `columns` columns.
    ///
    /// # Errors
    /// Row pointers that decrease or do not end at the number of entries, columns out of range, a
    /// row that does not start with a positive diagonal, numbers that are not finite.
    pub fn new(
        row_ptr: &'a [u32],
        col_idx: &'a [I],
        values: &'a [R],
        columns: usize,
    ) -> Result<Self, Error> {
        same_length(Array::MatrixValues, values.len(), col_idx.len())?;
        if let Some(at) = col_idx.iter().position(|column| column.at() >= columns) {
            return Err(Error::OutOfRange { of: Array::ColumnIndices, at });
        }
        all_finite(Array::MatrixValues, values)?;
        let matrix = Self { row_ptr, col_idx, values };
        let mut end = 0;
        for (at, pointer) in row_ptr.iter().enumerate() {
            let start = *pointer as usize;
            let last = at + 1 == row_ptr.len();
            let rises = if at == 0 { start == 0 } else { start > end };
            let ends = if last { start == values.len() } else { start < values.len() };
            let own = last || read(col_idx, start).at() == at && read(values, start) > R::ZERO;
            if !(rises && ends && own) {
                return Err(Error::OutOfRange { of: Array::RowPointers, at });
            }
            end = start;
        }
        if row_ptr.is_empty() {
            return Err(Error::Length { of: Array::RowPointers, found: 0, expected: 1 });
        }
        Ok(matrix)
    }

    /// Number of rows, that is unknowns.
    pub fn rows(&self) -> usize {
        self.row_ptr.len().saturating_sub(1)
    }

    /// Start of each row, and the number of entries.
    pub fn row_ptr(&self) -> &'a [u32] {
        self.row_ptr
    }

    /// The column of each entry.
    pub fn col_idx(&self) -> &'a [I] {
        self.col_idx
    }

    /// The entries.
    pub fn values(&self) -> &'a [R] {
        self.values
    }

    /// Row `at`, or an empty one where there are fewer.
    pub fn row(&self, at: usize) -> Row<'a, R, I> {
        let range = match (self.row_ptr.get(at), self.row_ptr.get(at + 1)) {
            (Some(&start), Some(&end)) => start as usize..end as usize,
            _ => 0..0,
        };
        Row {
            columns: self.col_idx.get(range.clone()).unwrap_or(&[]),
            values: self.values.get(range).unwrap_or(&[]),
        }
    }

    /// The rows in order.
    #[inline(always)]
    pub fn iter(&self) -> impl Iterator<Item = Row<'a, R, I>> + Clone + use<'a, R, I> {
        let (col_idx, values) = (self.col_idx, self.values);
        let ends = self.row_ptr.get(1..).unwrap_or(&[]);
        self.row_ptr.iter().zip(ends).map(move |(&start, &end)| {
            let range = start as usize..end as usize;
            Row {
                columns: col_idx.get(range.clone()).unwrap_or(&[]),
                values: values.get(range).unwrap_or(&[]),
            }
        })
    }
}

/// One row; its first entry is the diagonal.
#[derive(Debug, Clone, Copy)]
pub struct Row<'a, R, I> {
    columns: &'a [I],
    values: &'a [R],
}

impl<'a, R: Real, I: Index> Row<'a, R, I> {
    /// K_ii
    #[inline(always)]
    pub fn diagonal(&self) -> R {
        read(self.values, 0)
    }

    /// (column, value) of each entry.
    #[inline(always)]
    pub fn entries(&self) -> impl Iterator<Item = (usize, R)> + use<'a, R, I> {
        self.columns.iter().zip(self.values).map(|(column, &value)| (column.at(), value))
    }

    /// Σ_j K_ij u_j
    #[inline(always)]
    pub fn dot(&self, u: &[R]) -> R {
        self.entries().fold(R::ZERO, |sum, (column, value)| sum + value * read(u, column))
    }
}
