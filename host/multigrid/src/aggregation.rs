//! Aggregates of strongly coupled unknowns, each a coarse unknown (Vaněk, Mandel, Brezina).
//!
//! i and j are strongly coupled where
//! ```text
//!   a_ij² > θ² a_ii a_jj
//! ```
//! First an unknown none of whose strong neighbours is taken makes an aggregate with all of them. What is left joins the
//! aggregate that it is coupled to most, and what then is left makes aggregates among itself.

use crate::sparse::Sparse;

/// No aggregate: relaxation alone solves for an unknown whose row is nearly diagonal.
pub(crate) const NONE: u32 = u32::MAX;
/// A row is nearly diagonal where all it has beside the diagonal is at most this part of it.
const NEARLY_DIAGONAL: f64 = 0.02;

/// Strong couplings of a matrix.
pub(crate) struct Strength<'a> {
    matrix: &'a Sparse,
    diagonal: &'a [f64],
    square: f64,
}

impl<'a> Strength<'a> {
    pub fn new(matrix: &'a Sparse, diagonal: &'a [f64], threshold: f64) -> Self {
        Self { matrix, diagonal, square: threshold * threshold }
    }

    pub fn is_strong(&self, row: usize, (column, value): (u32, f64)) -> bool {
        let column = column as usize;
        column != row && value * value > self.square * self.diagonal[row] * self.diagonal[column]
    }

    fn neighbours(&self, row: usize) -> impl Iterator<Item = (usize, f64)> {
        let strong = self.matrix.row(row).iter().filter(move |&&entry| self.is_strong(row, entry));
        strong.map(|&(column, value)| (column as usize, value.abs()))
    }

    fn is_nearly_diagonal(&self, row: usize) -> bool {
        let entries = self.matrix.row(row).iter().filter(|entry| entry.0 as usize != row);
        entries.map(|entry| entry.1.abs()).sum::<f64>() <= NEARLY_DIAGONAL * self.diagonal[row]
    }
}

/// The aggregate of each unknown, and how many there are.
pub(crate) fn aggregates(strength: &Strength) -> (Vec<u32>, usize) {
    let n = strength.matrix.rows();
    let (mut of, mut count) = (vec![NONE; n], 0);
    let left_out: Vec<bool> = (0..n).map(|row| strength.is_nearly_diagonal(row)).collect();
    for row in 0..n {
        let is_free = |row: usize| of[row] == NONE && !left_out[row];
        if is_free(row) && strength.neighbours(row).all(|(column, _)| is_free(column)) {
            gather(strength, row, count as u32, &mut of, &left_out);
            count += 1;
        }
    }
    let first = of.clone();
    for row in (0..n).filter(|&row| first[row] == NONE && !left_out[row]) {
        let taken = strength.neighbours(row).filter(|&(column, _)| first[column] != NONE);
        if let Some((column, _)) =
            taken.reduce(|most, next| if next.1 > most.1 { next } else { most })
        {
            of[row] = first[column];
        }
    }
    for row in 0..n {
        if of[row] == NONE && !left_out[row] {
            gather(strength, row, count as u32, &mut of, &left_out);
            count += 1;
        }
    }
    (of, count)
}

/// Puts `row` and those of its strong neighbours that are in no aggregate yet into aggregate `number`.
fn gather(strength: &Strength, row: usize, number: u32, of: &mut [u32], left_out: &[bool]) {
    of[row] = number;
    for (column, _) in strength.neighbours(row) {
        if of[column] == NONE && !left_out[column] {
            of[column] = number;
        }
    }
}
