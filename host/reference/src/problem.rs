//! The contact problem as arrays, and the copy of its matrix that a factorisation keeps.

use super::ReferenceError;

/// K, b and ψ of the contact problem; Dirichlet unknowns are already eliminated.
///
/// K is symmetric and given with both triangles in compressed rows; columns within a row are in any
/// order, and each row holds its diagonal entry.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a> {
    /// Row starts, n + 1 of them.
    pub row_ptr: &'a [u32],
    /// Column of each entry.
    pub col_idx: &'a [u32],
    /// Value of each entry.
    pub values: &'a [f64],
    /// b, length n.
    pub load: &'a [f64],
    /// ψ on the contact unknowns, which are the last n_c; length n_c ≤ n.
    pub lower: &'a [f64],
    /// λ is between 0 and this on each contact unknown, of either sign: ∞ for u ≥ ψ, −∞ for u ≤ ψ; empty where all are ∞.
    pub spans: &'a [f64],
    /// For each contact unknown: its connected component has neither a Dirichlet nor a Robin part.
    /// Length n_c, or empty where there is no such component.
    pub floating: &'a [bool],
}

impl Problem<'_> {
    /// Everything that the solver relies on, except symmetry and definiteness.
    ///
    /// # Errors
    /// What is wrong, with the array's name.
    pub fn check(&self) -> Result<(), ReferenceError> {
        let (n, contact) = (self.load.len(), self.lower.len());
        let malformed = |what| Err(ReferenceError::Malformed(what));
        if self.row_ptr.len() != n + 1 || n > i32::MAX as usize {
            return malformed("row_ptr must hold one entry more than load, at most 2³¹");
        }
        if self.row_ptr[0] != 0 || self.row_ptr.windows(2).any(|pair| pair[0] > pair[1]) {
            return malformed("row_ptr must start at 0 and never decrease");
        }
        let entries = self.row_ptr[n] as usize;
        if self.col_idx.len() != entries || self.values.len() != entries {
            return malformed("col_idx and values must be as long as row_ptr says");
        }
        if self.col_idx.iter().any(|&column| column as usize >= n) {
            return malformed("col_idx holds a column outside the matrix");
        }
        if contact > n || !(self.floating.is_empty() || self.floating.len() == contact) {
            return malformed("lower must not exceed load; floating is empty or as long as lower");
        }
        if !(self.spans.is_empty() || self.spans.len() == contact)
            || self.spans.iter().any(|span| span.is_nan())
        {
            return malformed("spans are empty or as long as lower, and numbers");
        }
        check_finite("values", self.values)?;
        check_finite("load", self.load)?;
        check_finite("lower", self.lower)
    }

    /// n − n_c
    pub fn free(&self) -> usize {
        self.load.len() - self.lower.len()
    }

    /// The columns and values of a row.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> {
        let range = self.row_ptr[row] as usize..self.row_ptr[row + 1] as usize;
        let columns = self.col_idx[range.clone()].iter().map(|&column| column as usize);
        columns.zip(self.values[range].iter().copied())
    }

    /// The contact unknowns (numbered within C) of each connected component of the matrix graph with a `floating` one:
    /// nothing holds it but contact.
    pub fn floating_components(&self) -> Vec<Vec<usize>> {
        let floats = self.floating.contains(&true);
        let mut visited = vec![false; if floats { self.load.len() } else { 0 }];
        let seeds = self.floating.iter().enumerate().filter(|&(_, &floats)| floats);
        seeds
            .map(|(contact, _)| self.contact_reached_from(self.free() + contact, &mut visited))
            .filter(|component| !component.is_empty())
            .collect()
    }

    /// The unvisited contact unknowns that a walk through the graph of K reaches.
    fn contact_reached_from(&self, seed: usize, visited: &mut [bool]) -> Vec<usize> {
        let (mut reached, mut pending) = (Vec::new(), Vec::new());
        let mut visit = |unknown: usize, pending: &mut Vec<usize>| {
            if !std::mem::replace(&mut visited[unknown], true) {
                pending.push(unknown);
            }
        };
        visit(seed, &mut pending);
        while let Some(unknown) = pending.pop() {
            reached.extend(unknown.checked_sub(self.free()));
            self.row(unknown).for_each(|(neighbour, _)| visit(neighbour, &mut pending));
        }
        reached
    }
}

/// Names the first entry that is infinite or not a number.
pub(super) fn check_finite(array: &'static str, entries: &[f64]) -> Result<(), ReferenceError> {
    match entries.iter().position(|entry| !entry.is_finite()) {
        Some(index) => Err(ReferenceError::NotFinite { array, index }),
        None => Ok(()),
    }
}

/// The stiffness matrix, in compressed rows that are its compressed columns too.
pub(super) struct Matrix {
    pub row_ptr: Vec<u32>,
    pub col_idx: Vec<u32>,
    pub values: Vec<f64>,
    /// n − n_c.
    pub free: usize,
}

impl Matrix {
    pub fn of(problem: &Problem) -> Self {
        Self {
            row_ptr: problem.row_ptr.to_vec(),
            col_idx: problem.col_idx.to_vec(),
            values: problem.values.to_vec(),
            free: problem.free(),
        }
    }

    pub fn unknowns(&self) -> usize {
        self.row_ptr.len() - 1
    }

    pub fn contact(&self) -> usize {
        self.unknowns() - self.free
    }

    /// The positions of the entries of row `row`.
    pub fn row(&self, row: usize) -> std::ops::Range<usize> {
        self.row_ptr[row] as usize..self.row_ptr[row + 1] as usize
    }

    pub fn columns(&self, row: usize) -> &[u32] {
        &self.col_idx[self.row(row)]
    }

    /// Where K_ii stands; a row without it cannot be positive definite.
    pub fn diagonal(&self, row: usize) -> Result<usize, ReferenceError> {
        self.row(row)
            .find(|&entry| self.col_idx[entry] as usize == row && self.values[entry] > 0.0)
            .ok_or(ReferenceError::NotPositiveDefinite { unknown: row })
    }
}
