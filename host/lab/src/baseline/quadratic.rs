//! A row of contact problems with one matrix, as every solver takes it.
//!
//! ```text
//!   minimise ½ uᵀKu − b(t)ᵀu   over u_i ≥ ψ_i(t) on the last n_c unknowns,   t = 0, 1, 2, …
//!                              with limits at the cost m_i(t) max(ψ_i − u_i, 0) instead
//! ```
//! m_i ≥ 0 is how far it is from the least flux, which b contains, to the limit; where there is no least flux m_i = −∞, and
//! u_i ≤ ψ_i.
//! Their answers are known beforehand, from the host's active set at full accuracy: the error of a
//! solver is ‖u − u*‖_K, which is the energy distance ‖A^½∇_h(u − u*)‖ of the fields.

use serde::Serialize;
use signorini_reference::{Factor, Problem};
use signorini_scene::Result;

use super::failed;

/// K with both triangles, and what changes from tick to tick.
pub(super) struct Quadratic {
    pub matrix: Matrix,
    pub ticks: Vec<QuadraticLoads>,
    /// u* of each tick.
    pub answers: Vec<Vec<f64>>,
    /// For each contact unknown whether contact alone holds its part.
    pub floating: Vec<bool>,
}

/// A matrix in compressed rows, or by columns, as OSQP's process is told one.
#[derive(Debug, Clone, Default, Serialize)]
pub(super) struct Matrix {
    #[serde(rename = "starts")]
    pub row_ptr: Vec<u32>,
    #[serde(rename = "rows")]
    pub col_idx: Vec<u32>,
    pub values: Vec<f64>,
}

#[derive(Debug, Clone)]
pub(super) struct QuadraticLoads {
    pub load: Vec<f64>,
    /// ψ of the contact unknowns, which come last.
    pub lower: Vec<f64>,
    /// m of the contact unknowns; nothing where all are ∞.
    pub spans: Vec<f64>,
}

impl QuadraticLoads {
    /// With spans of either sign, those of the ends that `load` contains; where such an end is the limit and the other one
    /// finite, the load contains that one afterwards.
    pub fn new(mut load: Vec<f64>, lower: Vec<f64>, mut spans: Vec<f64>) -> Self {
        let free = load.len() - lower.len();
        for (load, span) in load[free..].iter_mut().zip(&mut spans) {
            if *span < 0.0 && span.is_finite() {
                (*load, *span) = (*load + *span, -*span);
            }
        }
        Self { load, lower, spans }
    }

    pub fn span(&self, contact: usize) -> f64 {
        self.spans.get(contact).copied().unwrap_or(f64::INFINITY)
    }
}

impl Matrix {
    pub fn new() -> Self {
        Self { row_ptr: vec![0], ..Self::default() }
    }

    pub fn order(&self) -> usize {
        self.row_ptr.len() - 1
    }

    pub fn push(&mut self, entries: impl IntoIterator<Item = (usize, f64)>) {
        for (column, value) in entries {
            self.col_idx.push(column as u32);
            self.values.push(value);
        }
        self.row_ptr.push(self.values.len() as u32);
    }

    /// (column, value) of row `row`.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + Clone + '_ {
        let range = self.row_ptr[row] as usize..self.row_ptr[row + 1] as usize;
        let columns = self.col_idx[range.clone()].iter().map(|&column| column as usize);
        columns.zip(self.values[range].iter().copied())
    }

    /// ‖d‖_K
    fn norm(&self, d: &[f64]) -> f64 {
        let product = |i: usize| self.row(i).map(|(j, value)| value * d[j]).sum::<f64>();
        (0..d.len()).map(|i| d[i] * product(i)).sum::<f64>().max(0.0).sqrt()
    }
}

impl Quadratic {
    /// Factors K and solves every tick, up to the first that has no solution.
    pub fn new(
        matrix: Matrix,
        floating: Vec<bool>,
        ticks: Vec<QuadraticLoads>,
    ) -> Result<(Self, Factor)> {
        let mut quadratic = Self { matrix, ticks, answers: Vec::new(), floating };
        let factor = Factor::new(&quadratic.reference(0)).map_err(failed)?;
        for tick in &quadratic.ticks {
            match factor.solve_between(&tick.load, &tick.lower, &tick.spans, None) {
                Ok(solution) => quadratic.answers.push(solution.u),
                Err(error) if quadratic.answers.is_empty() => return Err(failed(error)),
                Err(_) => break,
            }
        }
        quadratic.ticks.truncate(quadratic.answers.len());
        Ok((quadratic, factor))
    }

    pub fn contact(&self) -> usize {
        self.ticks[0].lower.len()
    }

    pub fn free(&self) -> usize {
        self.matrix.order() - self.contact()
    }

    /// The problem of a tick in the words of the host's solver.
    pub fn reference(&self, tick: usize) -> Problem<'_> {
        Problem {
            row_ptr: &self.matrix.row_ptr,
            col_idx: &self.matrix.col_idx,
            values: &self.matrix.values,
            load: &self.ticks[tick].load,
            spans: &self.ticks[tick].spans,
            lower: &self.ticks[tick].lower,
            floating: &self.floating,
        }
    }

    /// ‖u − u*‖_K; infinite where u is not a number.
    pub fn distance(&self, tick: usize, u: &[f64]) -> f64 {
        let d: Vec<f64> = u.iter().zip(&self.answers[tick]).map(|(u, exact)| u - exact).collect();
        let norm = self.matrix.norm(&d);
        if norm.is_finite() && d.iter().all(|d| d.is_finite()) { norm } else { f64::INFINITY }
    }
}
