//! The hierarchy of PᵀKP by smoothed aggregation, and its W-cycle.
//!
//! It is built once, with all contact edges open. Where some touch, their vertices are held at 0, and on each coarser level
//! every unknown whose function is not 0 at what is held. What is left is the Galerkin matrix of functions that are 0 where
//! they have to be: a part of the one that was built, so that nothing is built anew.

use crate::coarsest::Coarsest;
use crate::level::Level;
use crate::prolongation::smoothed;
use crate::sparse::Sparse;

/// Unknowns that a dense factor takes.
const DENSE: usize = 120;
/// A level that keeps more than this part of the unknowns is the last.
const LEAST_COARSENING: f64 = 0.7;
/// θ of the first level; each further one takes half of it.
const THRESHOLD: f64 = 0.08;

/// Levels from the vertices down, and the coarsest matrix.
#[derive(Debug)]
pub(crate) struct Hierarchy {
    levels: Vec<Level>,
    coarsest: Coarsest,
    load: Vec<f32>,
    sum: Sum,
}

impl Hierarchy {
    pub fn new(mut matrix: Sparse) -> Self {
        let (mut levels, mut threshold) = (Vec::new(), THRESHOLD);
        let widest = matrix.rows();
        while matrix.rows() > DENSE {
            let diagonal = matrix.diagonal();
            let prolongation = smoothed(&matrix, &diagonal, threshold);
            let restriction = prolongation.transposed();
            levels.push(Level::new(&matrix, &diagonal, &prolongation, &restriction));
            let stalls = prolongation.columns as f64 > LEAST_COARSENING * matrix.rows() as f64;
            if stalls && prolongation.columns > DENSE {
                matrix = Sparse::with_columns(0);
                break;
            }
            matrix = restriction.times(&matrix.times(&prolongation));
            threshold *= 0.5;
        }
        let load = vec![0.0; matrix.rows() + 1];
        let sum = Sum::new(widest);
        Self { levels, coarsest: Coarsest::new(&matrix), load, sum }
    }

    /// Holds these vertices at 0, and no others.
    pub fn hold(&mut self, vertices: &[u32]) {
        let Some(finest) = self.levels.first_mut() else {
            return self.coarsest.hold(vertices);
        };
        let mut rows = finest.hold(vertices);
        for at in 0..self.levels.len() {
            let (fine, coarse) = self.levels.split_at_mut(at + 1);
            let fine = &fine[at];
            for &row in &rows {
                self.sum.clear();
                fine.coarse_row(row, |column, value| self.sum.add(column, value));
                match coarse.first_mut() {
                    Some(coarse) => coarse.set_row(row, |column| self.sum.of(column)),
                    None => self.coarsest.set_row(row, |column| self.sum.of(column)),
                }
            }
            rows = coarse.first().map_or(Vec::new(), |coarse| coarse.coarse_of(&rows));
        }
        self.coarsest.hold(&[]);
    }

    /// Where the load of the vertices goes; the last entry is for those that have no row.
    pub fn load(&mut self) -> &mut [f32] {
        match self.levels.first_mut() {
            Some(finest) => &mut finest.load,
            None => &mut self.load,
        }
    }

    /// Approximates (PᵀKP)⁻¹ times the load, which is overwritten.
    pub fn cycle(&mut self) -> &[f32] {
        self.visit(0);
        self.levels.first().map_or(&self.load, |finest| &finest.z)
    }

    /// A cycle from level `at` down: each level below it is visited twice, the second time for what the first left.
    fn visit(&mut self, at: usize) {
        if at == self.levels.len() {
            return self.solve_coarsest();
        }
        let (fine, coarse) = self.levels.split_at_mut(at + 1);
        fine[at].relax_down();
        let load = coarse.first_mut().map_or(&mut self.load, |level| &mut level.load);
        if load.len() > 1 {
            fine[at].restrict(load);
        }
        self.visit(at + 1);
        if at + 1 < self.levels.len() {
            self.levels[at + 1].keep();
            self.visit(at + 1);
            self.levels[at + 1].add_kept();
        }
        let (fine, coarse) = self.levels.split_at_mut(at + 1);
        let correction = coarse.first().map_or(&self.load, |level| &level.z);
        if correction.len() > 1 {
            fine[at].prolong(correction);
        }
        fine[at].relax_up();
    }

    fn solve_coarsest(&mut self) {
        let count = self.load.len() - 1;
        self.coarsest.solve(&mut self.load[..count]);
        if let Some(last) = self.load.last_mut() {
            *last = 0.0;
        }
    }
}

/// A row that is added up, column by column.
#[derive(Debug)]
struct Sum {
    values: Vec<f64>,
    columns: Vec<u32>,
}

impl Sum {
    fn new(columns: usize) -> Self {
        Self { values: vec![0.0; columns], columns: Vec::new() }
    }

    fn clear(&mut self) {
        self.columns.drain(..).for_each(|column| self.values[column as usize] = 0.0);
    }

    fn add(&mut self, column: u32, value: f64) {
        self.columns.push(column);
        self.values[column as usize] += value;
    }

    fn of(&self, column: u32) -> f64 {
        self.values[column as usize]
    }
}
