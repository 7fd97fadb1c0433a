//! A level of the hierarchy: a matrix in f32 and its Gauss–Seidel sweeps.
//!
//! The sweep down begins at z = 0 and leaves the residual behind, in one pass over the matrix:
//! ```text
//!   i = 0, 1, …      z_i = w_i / a_ii,   w ← w − a_i z_i         w = b before, b − A z after
//!   i = …, 1, 0      z_i = (b_i − Σ_{j≠i} a_ij z_j) / a_ii       the sweep up: its mirror image
//! ```
//! Both and a symmetric coarse correction between them are a symmetric preconditioner. An unknown is held at 0 by 0 in
//! place of 1/a_ii.

use crate::sparse::Sparse;

/// An entry beside the diagonal, or a weight of a prolongation.
#[derive(Debug, Clone, Copy)]
struct Entry {
    column: u32,
    value: f32,
}

/// Compressed rows in f32.
#[derive(Debug)]
struct Rows {
    row_ptr: Vec<u32>,
    entries: Vec<Entry>,
}

impl Rows {
    fn of(sparse: &Sparse, keeps: impl Fn(usize, u32) -> bool) -> Self {
        let mut rows = Self { row_ptr: vec![0], entries: Vec::with_capacity(sparse.entries.len()) };
        for at in 0..sparse.rows() {
            let kept = sparse.row(at).iter().filter(|entry| keeps(at, entry.0));
            rows.entries.extend(kept.map(|&(column, value)| Entry { column, value: value as f32 }));
            rows.row_ptr.push(rows.entries.len() as u32);
        }
        rows
    }

    fn row_mut(&mut self, at: usize) -> &mut [Entry] {
        &mut self.entries[self.row_ptr[at] as usize..self.row_ptr[at + 1] as usize]
    }

    #[inline(always)]
    fn row(&self, at: usize) -> &[Entry] {
        &self.entries[self.row_ptr[at] as usize..self.row_ptr[at + 1] as usize]
    }
}

/// A matrix, the prolongation to it from the next coarser one, and a correction on it.
#[derive(Debug)]
pub(crate) struct Level {
    matrix: Rows,
    prolongation: Rows,
    restriction: Rows,
    diagonal: Vec<f32>,
    inverse: Vec<f32>,
    /// 1/a_ii, 0 where z_i is held at 0.
    relaxed: Vec<f32>,
    held: Vec<u32>,
    /// b; the last entry belongs to vertices that have no row.
    pub load: Vec<f32>,
    residual: Vec<f32>,
    /// z, with 0 in the last place.
    pub z: Vec<f32>,
    /// z of a first cycle, while a second one corrects it.
    kept: Vec<f32>,
}

impl Level {
    pub fn new(
        matrix: &Sparse,
        diagonal: &[f64],
        prolongation: &Sparse,
        restriction: &Sparse,
    ) -> Self {
        let inverse: Vec<f32> = diagonal.iter().map(|&entry| (1.0 / entry) as f32).collect();
        let n = matrix.rows();
        Self {
            matrix: Rows::of(matrix, |row, column| row != column as usize),
            prolongation: Rows::of(prolongation, |_, _| true),
            restriction: Rows::of(restriction, |_, _| true),
            diagonal: diagonal.iter().map(|&entry| entry as f32).collect(),
            relaxed: inverse.clone(),
            inverse,
            held: Vec::new(),
            load: vec![0.0; n + 1],
            residual: vec![0.0; n + 1],
            z: vec![0.0; n + 1],
            kept: vec![0.0; n + 1],
        }
    }

    /// Holds these unknowns at 0, and no others; the coarse rows that are others then.
    pub fn hold(&mut self, held: &[u32]) -> Vec<u32> {
        let mut before = std::mem::replace(&mut self.held, held.to_vec());
        before.iter().for_each(|&at| self.relaxed[at as usize] = self.inverse[at as usize]);
        held.iter().for_each(|&at| self.relaxed[at as usize] = 0.0);
        before.extend(held);
        before.sort_unstable();
        let toggled = before.chunk_by(|a, b| a == b).filter(|same| same.len() == 1);
        let near: Vec<u32> = toggled.flat_map(|at| self.with_neighbours(at[0])).collect();
        self.coarse_of(&near)
    }

    fn with_neighbours(&self, row: u32) -> impl Iterator<Item = u32> {
        std::iter::once(row).chain(self.matrix.row(row as usize).iter().map(|entry| entry.column))
    }

    /// The coarse rows that these rows take part in.
    pub fn coarse_of(&self, rows: &[u32]) -> Vec<u32> {
        let weights = rows.iter().flat_map(|&row| self.prolongation.row(row as usize));
        let mut coarse: Vec<u32> = weights.map(|weight| weight.column).collect();
        coarse.sort_unstable();
        coarse.dedup();
        coarse
    }

    /// Row `at` of PᵀAP, without what is held; some columns more than once.
    pub fn coarse_row(&self, at: u32, mut add: impl FnMut(u32, f64)) {
        for to in self.restriction.row(at as usize) {
            let row = to.column as usize;
            if self.relaxed[row] == 0.0 {
                continue;
            }
            let own = Entry { column: to.column, value: self.diagonal[row] };
            for entry in std::iter::once(&own).chain(self.matrix.row(row)) {
                if self.relaxed[entry.column as usize] != 0.0 {
                    let factor = f64::from(to.value) * f64::from(entry.value);
                    for from in self.prolongation.row(entry.column as usize) {
                        add(from.column, factor * f64::from(from.value));
                    }
                }
            }
        }
    }

    /// Puts other values into a row; a row of 0 holds its unknown.
    pub fn set_row(&mut self, at: u32, value: impl Fn(u32) -> f64) {
        let row = at as usize;
        for entry in self.matrix.row_mut(row) {
            entry.value = value(entry.column) as f32;
        }
        let diagonal = value(at) as f32;
        self.diagonal[row] = diagonal;
        self.inverse[row] = if diagonal > 0.0 { 1.0 / diagonal } else { 0.0 };
        self.relaxed[row] = self.inverse[row];
    }

    /// The sweep down, from z = 0.
    pub fn relax_down(&mut self) {
        let Self { matrix, relaxed, load, residual, z, .. } = self;
        residual.copy_from_slice(load);
        for (row, (z, relaxed)) in z.iter_mut().zip(relaxed.iter()).enumerate() {
            *z = residual[row] * relaxed;
            residual[row] = 0.0;
            for entry in matrix.row(row) {
                residual[entry.column as usize] -= entry.value * *z;
            }
        }
    }

    /// Adds Pᵀ times the residual to the `load` of the coarse level.
    pub fn restrict(&self, load: &mut [f32]) {
        load.fill(0.0);
        for (row, &residual) in self.residual[..self.relaxed.len()].iter().enumerate() {
            if self.relaxed[row] == 0.0 {
                continue;
            }
            for weight in self.prolongation.row(row) {
                load[weight.column as usize] += weight.value * residual;
            }
        }
    }

    /// Adds P times the `correction` of the coarse level to z.
    pub fn prolong(&mut self, correction: &[f32]) {
        let count = self.relaxed.len();
        for (row, z) in self.z[..count].iter_mut().enumerate() {
            if self.relaxed[row] == 0.0 {
                continue;
            }
            let weights = self.prolongation.row(row).iter();
            *z += weights
                .map(|weight| weight.value * correction[weight.column as usize])
                .sum::<f32>();
        }
    }

    /// The sweep up.
    pub fn relax_up(&mut self) {
        for row in (0..self.relaxed.len()).rev() {
            let entries = self.matrix.row(row).iter();
            let others: f32 =
                entries.map(|entry| entry.value * self.z[entry.column as usize]).sum();
            self.z[row] = (self.load[row] - others) * self.relaxed[row];
        }
    }

    /// Keeps z, and leaves its residual as the load.
    pub fn keep(&mut self) {
        let Self { matrix, diagonal, load, z, kept, .. } = self;
        kept.copy_from_slice(z);
        for (row, (load, diagonal)) in load.iter_mut().zip(diagonal.iter()).enumerate() {
            let others: f32 =
                matrix.row(row).iter().map(|entry| entry.value * z[entry.column as usize]).sum();
            *load -= diagonal * z[row] + others;
        }
    }

    /// Adds what was kept to z.
    pub fn add_kept(&mut self) {
        self.z.iter_mut().zip(&self.kept).for_each(|(z, kept)| *z += kept);
    }
}
