//! The contact problem on a mesh as arrays.

use signorini_reference::Problem as Contact;

/// K, b and the law of contact, with given values eliminated, and which vertices the edges join.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a> {
    /// The arrays; the first entry of a row is its own.
    pub contact: Contact<'a>,
    /// The vertices of each edge, unknowns first, then edges with given values.
    pub ends: &'a [[u32; 2]],
    /// Number of vertices.
    pub vertices: usize,
    /// The least and the largest given value: gaps and u are seen on this scale.
    pub given: [f64; 2],
    /// max |b_i|/K_ii as b was before given values were eliminated: the other part of that scale.
    pub loaded: f64,
}

impl Problem<'_> {
    /// The arrays fit each other.
    pub(crate) fn fits(&self) -> bool {
        let n = self.unknowns();
        let begins_with_its_own =
            |row: usize| self.contact.row(row).next().is_some_and(|(at, k)| at == row && k > 0.0);
        self.contact.check().is_ok()
            && n <= self.ends.len()
            && self.ends.as_flattened().iter().all(|&end| (end as usize) < self.vertices)
            && (0..n).all(begins_with_its_own)
    }

    /// How many edges have no given value.
    pub(crate) fn unknowns(&self) -> usize {
        self.contact.load.len()
    }

    /// The most entries that a row has beside its own.
    pub(crate) fn width(&self) -> usize {
        let widths = self.contact.row_ptr.windows(2).map(|pair| pair[1] - pair[0]);
        widths.max().unwrap_or(1) as usize - 1
    }

    /// K_ii
    pub(crate) fn diagonal(&self, row: usize) -> f64 {
        self.contact.values[self.contact.row_ptr[row] as usize]
    }

    /// (b − Ku) of one row.
    pub(crate) fn residual(&self, row: usize, u: &[f64]) -> f64 {
        let load = self.contact.load[row];
        self.contact.row(row).fold(load, |rest, (column, value)| rest - value * u[column])
    }
}
