//! The best s for every column: free vertex values and bubbles by least squares.
//!
//! s is fixed on D and on C; what it is inside minimises |Gs − Tτ|, which is linear in the column. The
//! normal matrix GᵀG has the pattern of P1 or Q1 and one factorisation serves all columns.

use std::collections::BTreeMap;

use super::block::Block;
use signorini_reference::{LinearFactor, ReferenceError};

/// Numbers for each column, those of one place together.
#[derive(Debug, Clone)]
pub(super) struct Table {
    pub columns: usize,
    pub values: Vec<f64>,
}

impl Table {
    pub fn new(places: usize, columns: usize) -> Self {
        Self { columns, values: vec![0.0; places * columns] }
    }

    /// Of columns with a number for each place.
    pub fn of_columns<'c>(places: usize, columns: impl IntoIterator<Item = &'c Vec<f64>>) -> Self {
        let columns: Vec<_> = columns.into_iter().collect();
        let mut table = Self::new(places, columns.len());
        for (column, numbers) in columns.into_iter().enumerate() {
            for (place, number) in numbers.iter().enumerate() {
                table.row_mut(place)[column] = *number;
            }
        }
        table
    }

    /// The numbers of each column together.
    fn by_columns(&self) -> Vec<f64> {
        let column = |at: usize| self.values.iter().skip(at).step_by(self.columns).copied();
        (0..self.columns).flat_map(column).collect()
    }

    pub fn row(&self, place: usize) -> &[f64] {
        &self.values[place * self.columns..][..self.columns]
    }

    pub fn row_mut(&mut self, place: usize) -> &mut [f64] {
        &mut self.values[place * self.columns..][..self.columns]
    }
}

/// Adds `factor` times the start of another row.
fn add(row: &mut [f64], factor: f64, other: &[f64]) {
    row.iter_mut().zip(other).for_each(|(to, from)| *to += factor * from);
}

impl Block {
    /// The rows of `s` and of `fluxes` that `row` is a sum of, each with its factor, and its own entries of p.
    fn terms<'t>(
        &'t self,
        row: &'t [f64],
        s: &'t Table,
        fluxes: &'t Table,
    ) -> (impl Iterator<Item = (&'t [f64], f64)>, &'t [f64]) {
        let (of_functions, rest) = row.split_at(self.functions.len());
        let (of_fluxes, of_inputs) = rest.split_at(self.edges.len());
        let of_s = self.functions.iter().map(|&at| s.row(at as usize)).zip(of_functions);
        let of_tau = self.edges.iter().map(|&at| fluxes.row(at as usize)).zip(of_fluxes);
        (of_s.chain(of_tau).map(|(columns, &factor)| (columns, factor)), of_inputs)
    }

    /// Row `row` of Gs − Tτ in every column: `s` and `fluxes` hold the columns of both, and column j
    /// is that of p_j as far as there are patterns.
    pub fn residual(&self, row: &[f64], s: &Table, fluxes: &Table, sum: &mut [f64]) {
        sum.fill(0.0);
        let (terms, of_inputs) = self.terms(row, s, fluxes);
        terms.chain([(of_inputs, 1.0)]).for_each(|(columns, factor)| add(sum, factor, columns));
    }

    /// Σ |terms| of that.
    pub fn sizes(&self, row: &[f64], s: &Table, fluxes: &Table, sum: &mut [f64]) {
        sum.fill(0.0);
        let (terms, of_inputs) = self.terms(row, s, fluxes);
        for (columns, factor) in terms.chain([(of_inputs, 1.0)]) {
            sum.iter_mut().zip(columns).for_each(|(sum, entry)| *sum += (factor * entry).abs());
        }
    }

    /// The part of the fluxes alone.
    pub fn of_fluxes(&self, row: &[f64], fluxes: &Table, sum: &mut [f64]) {
        sum.fill(0.0);
        for (&edge, &factor) in self.edges.iter().zip(&row[self.functions.len()..]) {
            add(sum, factor, fluxes.row(edge as usize));
        }
    }
}

/// Fills in the functions of s that are not `fixed`; those in `s` must be 0.
///
/// # Errors
/// A normal matrix that is not positive definite.
pub(super) fn complete(
    blocks: &[Block],
    fixed: &[bool],
    fluxes: &Table,
    s: &mut Table,
) -> Result<(), ReferenceError> {
    let numbers = numbers(fixed);
    let free = fixed.iter().filter(|&&fixed| !fixed).count();
    let mut right = Table::new(free, s.columns);
    let mut sum = vec![0.0; s.columns];
    for block in blocks {
        for row in &block.rows {
            block.residual(row, s, fluxes, &mut sum);
            for (&function, &factor) in block.functions.iter().zip(row) {
                if let Some(number) = numbers[function as usize] {
                    add(right.row_mut(number), -factor, &sum);
                }
            }
        }
    }
    let best = solve(blocks, &numbers, free, &right.by_columns())?;
    for (function, number) in numbers.iter().enumerate() {
        let Some(number) = *number else { continue };
        let values = best.iter().skip(number).step_by(free);
        s.row_mut(function).iter_mut().zip(values).for_each(|(to, from)| *to = *from);
    }
    Ok(())
}

/// The position of each free function among them.
fn numbers(fixed: &[bool]) -> Vec<Option<usize>> {
    let mut next = 0..;
    fixed.iter().map(|&fixed| if fixed { None } else { next.next() }).collect()
}

/// (GᵀG)⁻¹ applied to the columns of `right`.
fn solve(
    blocks: &[Block],
    numbers: &[Option<usize>],
    free: usize,
    right: &[f64],
) -> Result<Vec<f64>, ReferenceError> {
    let mut rows = vec![BTreeMap::<u32, f64>::new(); free];
    for block in blocks {
        let number = |function: u32| numbers[function as usize];
        for row in &block.rows {
            for (&i, a) in block.functions.iter().zip(row) {
                let Some(i) = number(i) else { continue };
                for (&j, b) in block.functions.iter().zip(row) {
                    let Some(j) = number(j) else { continue };
                    *rows[i].entry(j as u32).or_default() += a * b;
                }
            }
        }
    }
    LinearFactor::new(rows)?.solve(right)
}
