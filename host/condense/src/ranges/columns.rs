//! The form of the error bound in the variables that are left: F M = Q F′, and what that loses to rounding.

use faer::Mat;

use crate::Form;

/// M, row by row.
pub(super) struct Columns {
    pub rows: Vec<Vec<f64>>,
    /// By how much its entries may be off.
    pub noise: Vec<Vec<f64>>,
    /// How many.
    pub width: usize,
}

impl Columns {
    /// F′ of F, both upper triangles by columns.
    pub fn of(&self, factor: &[f64]) -> Vec<f64> {
        let order = self.rows.len();
        let column = |j: usize| &factor[j * (j + 1) / 2..(j + 1) * (j + 2) / 2];
        let mut product = Mat::<f64>::zeros(order.max(self.width), self.width);
        for (j, row) in self.rows.iter().enumerate() {
            for (k, &weight) in row.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
                for (i, entry) in column(j).iter().enumerate() {
                    product[(i, k)] += weight * entry;
                }
            }
        }
        let r = product.qr().thin_R().to_owned();
        (0..self.width).flat_map(|j| (0..=j).map(move |i| (i, j))).map(|at| r[at]).collect()
    }

    /// What rounding may hide of the columns of F′.
    pub fn lost(&self, form: &Form, left: &[f64]) -> Vec<f64> {
        let order = self.rows.len();
        // Sums of `order` products, and the rotations of as many rows.
        let share = 8.0 * (order + self.width) as f64 * f64::EPSILON;
        let norm = |factor: &[f64], j: usize| {
            let column = &factor[j * (j + 1) / 2..(j + 1) * (j + 2) / 2];
            column.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
        };
        let largest = |j: usize| {
            let of_jump = form.jump.as_ref().map_or(0.0, |jump| norm(jump, j));
            norm(&form.factor, j).max(of_jump)
        };
        let mut lost = vec![0.0; self.width];
        for (j, (row, noise)) in self.rows.iter().zip(&self.noise).enumerate() {
            let largest = largest(j);
            let size = form.lost[j] + share * largest;
            for ((lost, weight), noise) in lost.iter_mut().zip(row).zip(noise) {
                *lost += size * weight.abs() + largest * noise;
            }
        }
        lost.iter_mut().zip(left).for_each(|(lost, left)| *lost += form.stability * left);
        lost
    }
}
