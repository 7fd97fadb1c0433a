//! Gauss–Seidel sweeps over the edges, with rows of a fixed width in f32; lines of edges are solved for at once ([`crate::lines`]).
//!
//! The sweep up also gives K z. A row is solved for when the sweep passes it; afterwards only edges of earlier places change,
//! by δ = z after − z before:
//! ```text
//!   (K z)_i = r_i + y_i,   y_i = Σ_{j<i} K_ij δ_j
//! ```
//! So a step of conjugate gradients passes twice over the matrix, and never for its product alone. On a line K = L D Lᵀ, by
//! ```text
//!   l_k = e_k / d_{k−1},   d_k = K_kk − l_k e_k,   e_k between edge k of the line and the one before
//! ```
//! This rounds what is nearly constant along a line, so that the rest of a line is measured, where an edge leaves none.

use std::ops::Range;

use crate::Problem;
use crate::lines::Lines;
use crate::row::Row;

/// K in f32 with what relaxes it.
#[derive(Debug)]
pub(crate) struct Relaxation<const WIDTH: usize> {
    rows: Vec<Row<WIDTH>>,
    /// 1/K_ii, on lines 1/d_k.
    inverse: Vec<f32>,
    /// The same, 0 where an edge is held.
    relaxed: Vec<f32>,
    /// l_k and K_kk on lines.
    lower: Vec<f32>,
    diagonal: Vec<f32>,
    lines: Vec<Range<usize>>,
    /// Changes of the edges of a line.
    change: Vec<f32>,
}

impl<const WIDTH: usize> Relaxation<WIDTH> {
    /// K/`unit` in the order of `lines`.
    pub fn new(problem: &Problem, unit: f64, lines: Lines) -> Self {
        let scaled = |&at: &u32| problem.diagonal(at as usize) / unit;
        let inverse: Vec<f32> = lines.order.iter().map(|at| scaled(at).recip() as f32).collect();
        let mut own: Vec<f64> = inverse.iter().map(|&entry| f64::from(entry).recip()).collect();
        let (lower, mut diagonal) = (vec![0.0; own.len()], vec![0.0; own.len()]);
        for at in lines.lines.iter().cloned().flatten() {
            diagonal[at] = scaled(&lines.order[at]) as f32;
            own[at] = f64::from(diagonal[at]);
        }
        let rows = Row::all(problem, &lines.order, unit, &own);
        let (lines, change, relaxed) = (lines.lines, Vec::new(), Vec::new());
        let mut new = Self { rows, inverse, relaxed, lower, diagonal, lines, change };
        for line in new.lines.clone() {
            new.factor(line);
        }
        new.relaxed.clone_from(&new.inverse);
        new
    }

    fn factor(&mut self, line: Range<usize>) {
        let mut pivot = f64::INFINITY;
        for at in line {
            let coupling = if pivot.is_finite() { self.rows[at].entry(at - 1) } else { 0.0 };
            let lower = coupling / pivot;
            let own = f64::from(self.diagonal[at]);
            // What rounding leaves of a pivot stays positive.
            pivot = (own - lower * coupling).max(f64::from(f32::EPSILON) * own);
            (self.lower[at], self.inverse[at]) = (lower as f32, pivot.recip() as f32);
        }
    }

    /// Holds an edge that is in no line at 0, or lets it go.
    pub fn hold(&mut self, at: usize, is_held: bool) {
        self.relaxed[at] = if is_held { 0.0 } else { self.inverse[at] };
    }

    /// The sweep from z = 0: `rest` r becomes r − K z.
    pub fn down(&self, rest: &mut [f32], z: &mut [f32]) {
        let mut start = 0;
        for line in &self.lines {
            self.edges_down(start..line.start, rest, z);
            self.line_down(line.clone(), rest, z);
            start = line.end;
        }
        self.edges_down(start..self.rows.len(), rest, z);
    }

    fn edges_down(&self, edges: Range<usize>, rest: &mut [f32], z: &mut [f32]) {
        let (rows, relaxed) = (&self.rows[edges.clone()], &self.relaxed[edges.clone()]);
        let data = z[edges.clone()].iter_mut().zip(rows).zip(relaxed);
        for (((z, row), relaxed), at) in data.zip(edges) {
            *z = rest[at] * relaxed;
            rest[at] = 0.0;
            row.scatter(-*z, rest);
        }
    }

    fn line_down(&self, line: Range<usize>, rest: &mut [f32], z: &mut [f32]) {
        let own = &mut z[line.clone()];
        own.copy_from_slice(&rest[line.clone()]);
        self.solve(line.clone(), own);
        for (at, z) in line.zip(own) {
            rest[at] -= self.diagonal[at] * *z;
            self.rows[at].scatter(-*z, rest);
        }
    }

    /// The sweep back for the residual r of z = 0, which leaves y in `rest`.
    pub fn up(&mut self, residual: &[f32], rest: &mut [f32], z: &mut [f32]) {
        let mut end = self.rows.len();
        for at in (0..self.lines.len()).rev() {
            let line = self.lines[at].clone();
            self.edges_up(line.end..end, residual, rest, z);
            end = line.start;
            self.line_up(line, residual, rest, z);
        }
        self.edges_up(0..end, residual, rest, z);
    }

    fn edges_up(&self, edges: Range<usize>, residual: &[f32], rest: &mut [f32], z: &mut [f32]) {
        let (rows, relaxed) = (&self.rows[edges.clone()], &self.relaxed[edges.clone()]);
        let data = rows.iter().zip(relaxed).zip(&residual[edges.clone()]);
        for (((row, relaxed), residual), at) in data.zip(edges).rev() {
            let value = (residual - row.times(z)) * relaxed;
            let change = value - z[at];
            z[at] = value;
            rest[at] = 0.0;
            row.scatter(change, rest);
        }
    }

    fn line_up(&mut self, line: Range<usize>, residual: &[f32], rest: &mut [f32], z: &mut [f32]) {
        let mut change = std::mem::take(&mut self.change);
        change.clear();
        change.extend(
            line.clone()
                .map(|at| residual[at] - self.diagonal[at] * z[at] - self.rows[at].times(z)),
        );
        rest[line.clone()].iter_mut().zip(&change).for_each(|(rest, left)| *rest = -left);
        self.solve(line.clone(), &mut change);
        for (at, &change) in line.zip(&change) {
            z[at] += change;
            rest[at] += self.diagonal[at] * change;
            self.rows[at].scatter(change, rest);
        }
        self.change = change;
    }

    /// Solves for a line; its load becomes the solution.
    fn solve(&self, line: Range<usize>, x: &mut [f32]) {
        let lower = &self.lower[line.clone()];
        let mut last = 0.0;
        for (x, lower) in x.iter_mut().zip(lower) {
            *x -= lower * last;
            last = *x;
        }
        let mut from_next = 0.0;
        for ((x, lower), inverse) in x.iter_mut().zip(lower).zip(&self.inverse[line]).rev() {
            *x = *x * inverse - from_next;
            from_next = lower * *x;
        }
    }
}
