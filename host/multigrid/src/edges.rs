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

/// The part of the diagonal entry below which an entry takes nothing of what others are rounded by.
const LARGE: f64 = 0.01;

/// Entries beside the diagonal, those that a row has fewer being 0 times itself.
#[derive(Debug, Clone, Copy)]
struct Row<const WIDTH: usize> {
    columns: [u32; WIDTH],
    values: [f32; WIDTH],
}

impl<const WIDTH: usize> Row<WIDTH> {
    /// Row `at` of K/`unit`, where `diagonal` is 1/(1/K_ii) in f32, and what rounding takes from the sum of its entries.
    ///
    /// An entry takes what the others are rounded by, and `lost`, the same of the row before. So K times a constant is what it is in
    /// f64, over any piece of the mesh: cells of one shape are rounded alike, and a part that hardly anything holds would be held by
    /// what they are rounded by. It is the least entry that hardly changes by it: K stays symmetric to six digits.
    fn of(problem: &Problem, at: usize, unit: f64, diagonal: f64, lost: f64) -> (Self, f64) {
        let mut row = Self { columns: [at as u32; WIDTH], values: [0.0; WIDTH] };
        let is_rounding = lost.abs() <= f64::from(f32::EPSILON) * diagonal;
        let (mut count, mut lost) = (0, if is_rounding { lost - diagonal } else { -diagonal });
        for (column, value) in problem.contact.row(at) {
            lost += value / unit;
            if column != at && count < WIDTH {
                (row.columns[count], row.values[count]) = (column as u32, (value / unit) as f32);
                lost -= f64::from(row.values[count]);
                count += 1;
            }
        }
        let entries = row.values[..count].iter_mut();
        let large = entries.filter(|entry| f64::from(entry.abs()) >= LARGE * diagonal);
        let least = large.min_by(|a, b| a.abs().total_cmp(&b.abs()));
        if let Some(least) = least {
            let before = std::mem::replace(least, *least + lost as f32);
            lost -= f64::from(*least) - f64::from(before);
        }
        (row, lost)
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
        let mut lost = 0.0;
        let row = |(at, &inverse): (usize, &f32)| {
            let row;
            (row, lost) = Row::of(problem, at, unit, f64::from(inverse).recip(), lost);
            row
        };
        let rows = inverse.iter().enumerate().map(row).collect();
        Self {
            rows,
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
