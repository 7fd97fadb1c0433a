//! Sparse matrices in compressed rows, with the two operations that make a coarse matrix PᵀAP: product and transpose.

/// A matrix in compressed rows; the columns of a row are in any order.
#[derive(Debug, Clone, Default)]
pub(crate) struct Sparse {
    pub row_ptr: Vec<usize>,
    pub entries: Vec<(u32, f64)>,
    pub columns: usize,
}

impl Sparse {
    /// No rows yet, of `columns` entries at most.
    pub fn with_columns(columns: usize) -> Self {
        Self { row_ptr: vec![0], entries: Vec::new(), columns }
    }

    pub fn rows(&self) -> usize {
        self.row_ptr.len() - 1
    }

    pub fn row(&self, at: usize) -> &[(u32, f64)] {
        &self.entries[self.row_ptr[at]..self.row_ptr[at + 1]]
    }

    /// Ends the row that the last entries belong to.
    pub fn end_row(&mut self) {
        self.row_ptr.push(self.entries.len());
    }

    /// The diagonal, 0 where it is not stored.
    pub fn diagonal(&self) -> Vec<f64> {
        let own = |at: usize| self.row(at).iter().find(|entry| entry.0 as usize == at);
        (0..self.rows()).map(|at| own(at).map_or(0.0, |entry| entry.1)).collect()
    }

    pub fn transposed(&self) -> Self {
        let mut next = vec![0; self.columns + 1];
        for &(column, _) in &self.entries {
            next[column as usize + 1] += 1;
        }
        for at in 0..self.columns {
            next[at + 1] += next[at];
        }
        let row_ptr = next.clone();
        let mut entries = vec![(0, 0.0); self.entries.len()];
        for row in 0..self.rows() {
            for &(column, value) in self.row(row) {
                let place = &mut next[column as usize];
                entries[*place] = (row as u32, value);
                *place += 1;
            }
        }
        Self { row_ptr, entries, columns: self.rows() }
    }

    /// `self` times `other`.
    pub fn times(&self, other: &Self) -> Self {
        let mut product = Self::with_columns(other.columns);
        let mut sum = RowSum::new(other.columns);
        for row in 0..self.rows() {
            for &(inner, factor) in self.row(row) {
                for &(column, value) in other.row(inner as usize) {
                    sum.add(&mut product, column, factor * value);
                }
            }
            product.end_row();
        }
        product
    }
}

/// Adds up entries of the last row of a matrix, column by column.
pub(crate) struct RowSum {
    /// Where the entry of a column stands, if it is behind the start of the last row.
    place: Vec<usize>,
}

impl RowSum {
    pub fn new(columns: usize) -> Self {
        Self { place: vec![usize::MAX; columns] }
    }

    pub fn add(&mut self, matrix: &mut Sparse, column: u32, value: f64) {
        let start = matrix.row_ptr[matrix.row_ptr.len() - 1];
        let place = &mut self.place[column as usize];
        match matrix.entries.get_mut(*place) {
            Some(entry) if *place >= start => entry.1 += value,
            _ => {
                *place = matrix.entries.len();
                matrix.entries.push((column, value));
            }
        }
    }
}
