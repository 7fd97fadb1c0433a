//! The finest level: edges, with rows of a fixed width in f32.
//!
//! Its sweep up also gives K z. A row is solved for when the sweep passes it; afterwards only edges of lower numbers change,
//! by δ = z after − z before:
//! ```text
//!   (K z)_i = r_i + y_i,   y_i = Σ_{j<i} K_ij δ_j
//! ```
//! So a step of conjugate gradients passes twice over the matrix, and never for its product alone.

use crate::Problem;
use crate::hierarchy::Hierarchy;
use crate::vertex_matrix::{Numbering, galerkin};

/// Entries beside the diagonal, those that a row has fewer being 0 times itself.
#[derive(Debug, Clone, Copy)]
struct Row<const WIDTH: usize> {
    columns: [u32; WIDTH],
    values: [f32; WIDTH],
}

impl<const WIDTH: usize> Row<WIDTH> {
    /// Row `at` of K/`unit`, where `inverse` is 1/K_ii.
    ///
    /// Its least entry takes what the others are rounded by, so that K times a constant is what it is in f64. Cells of one shape are
    /// rounded alike: the product would be far from small where hardly anything holds a part.
    fn of(problem: &Problem, at: usize, unit: f64, inverse: f32) -> Self {
        let mut row = Self { columns: [at as u32; WIDTH], values: [0.0; WIDTH] };
        let (mut count, mut lost) = (0, -f64::from(inverse).recip());
        for (column, value) in problem.contact.row(at) {
            let scaled = value / unit;
            lost += scaled;
            if column != at && count < WIDTH {
                (row.columns[count], row.values[count]) = (column as u32, scaled as f32);
                lost -= f64::from(row.values[count]);
                count += 1;
            }
        }
        let least = row.values[..count].iter_mut().min_by(|a, b| a.abs().total_cmp(&b.abs()));
        least.into_iter().for_each(|least| *least += lost as f32);
        row
    }
}

/// K in f32, and the two-level preconditioner.
#[derive(Debug)]
pub(crate) struct Edges<const WIDTH: usize> {
    rows: Vec<Row<WIDTH>>,
    inverse: Vec<f32>,
    relaxed: Vec<f32>,
    ends: Vec<[u32; 2]>,
    count: usize,
    free: usize,
    hierarchy: Hierarchy,
    /// The largest K_ii, by which all of K is divided.
    pub unit: f64,
    /// r − K z after a sweep down; y after a sweep up.
    pub rest: Vec<f32>,
    pub z: Vec<f32>,
}

impl<const WIDTH: usize> Edges<WIDTH> {
    pub fn new(problem: &Problem) -> Self {
        let n = problem.unknowns();
        let unit = (0..n).map(|at| problem.diagonal(at)).fold(f64::MIN_POSITIVE, f64::max);
        let numbering = Numbering::of(problem);
        let hierarchy = Hierarchy::new(galerkin(problem, &numbering, 1.0 / unit));
        let inverse: Vec<f32> = (0..n).map(|at| (unit / problem.diagonal(at)) as f32).collect();
        Self {
            rows: (0..n).map(|at| Row::of(problem, at, unit, inverse[at])).collect(),
            relaxed: inverse.clone(),
            inverse,
            ends: numbering.ends,
            count: numbering.count,
            free: problem.contact.free(),
            hierarchy,
            unit,
            rest: vec![0.0; n],
            z: vec![0.0; n],
        }
    }

    /// Holds contact edges at 0 where `held` says so.
    pub fn hold(&mut self, held: impl Iterator<Item = bool>) {
        let mut vertices = Vec::new();
        for (at, is_held) in (self.free..).zip(held) {
            self.relaxed[at] = if is_held { 0.0 } else { self.inverse[at] };
            if is_held {
                vertices
                    .extend(self.ends[at].into_iter().filter(|&end| (end as usize) < self.count));
            }
        }
        vertices.sort_unstable();
        vertices.dedup();
        self.hierarchy.hold(&vertices);
    }

    /// z from `residual` r, of which a copy stands in [`Edges::rest`], and y in its place.
    pub fn precondition(&mut self, residual: &[f32]) {
        self.relax_down();
        self.correct();
        self.relax_up(residual);
    }

    fn relax_down(&mut self) {
        let Self { rows, relaxed, rest, z, .. } = self;
        for (at, ((row, z), relaxed)) in rows.iter().zip(z).zip(relaxed.iter()).enumerate() {
            let value = rest[at] * relaxed;
            *z = value;
            rest[at] = 0.0;
            for k in 0..WIDTH {
                rest[row.columns[k] as usize] -= row.values[k] * value;
            }
        }
    }

    fn correct(&mut self) {
        let load = self.hierarchy.load();
        load.fill(0.0);
        for (&[a, b], rest) in self.ends.iter().zip(&self.rest) {
            load[a as usize] += 0.5 * rest;
            load[b as usize] += 0.5 * rest;
        }
        let correction = self.hierarchy.cycle();
        for (&[a, b], z) in self.ends.iter().zip(&mut self.z) {
            *z += 0.5 * (correction[a as usize] + correction[b as usize]);
        }
    }

    fn relax_up(&mut self, residual: &[f32]) {
        let Self { rows, relaxed, rest, z, .. } = self;
        let data = rows.iter().zip(residual).zip(relaxed.iter()).enumerate();
        for (at, ((row, residual), relaxed)) in data.rev() {
            let mut others = 0.0;
            for k in 0..WIDTH {
                others += row.values[k] * z[row.columns[k] as usize];
            }
            let value = (residual - others) * relaxed;
            let change = value - z[at];
            z[at] = value;
            rest[at] = 0.0;
            for k in 0..WIDTH {
                rest[row.columns[k] as usize] += row.values[k] * change;
            }
        }
    }
}
