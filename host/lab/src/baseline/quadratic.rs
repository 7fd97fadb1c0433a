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
//!
//! Solvers that know neither three sides nor kinks take a tick as a quadratic program whose bounds are rows:
//! ```text
//!   minimise ½ uᵀKu − bᵀu + Σ m_i s_i   over s_i ≥ 0,  u_i + s_i ≥ ψ_i      0 < m_i < ∞:  λ_i lies between 0 and m_i
//!                                       over           u_i       ≥ ψ_i      m_i = ∞
//!                                       over          −u_i       ≥ −ψ_i     m_i = −∞
//! ```
//! z = (u, s), and C z ≥ r. An edge of m_i = 0 has a given flux and no row. Without limits z is u, and C takes the contact
//! unknowns out of it.

use super::failed;
use serde::Serialize;
use signorini_reference::{Factor, Problem};
use signorini_scene::Result;

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

/// The part that all ticks of a [`Quadratic`] have in common; its matrices by columns.
#[derive(Debug, Clone)]
pub(super) struct Program {
    /// The upper triangle of K, and empty columns for s.
    pub matrix: Matrix,
    /// C
    pub constraints: Matrix,
    /// Rows of C: first those of ψ, then s ≥ 0.
    pub count: usize,
    held: Vec<HeldEdge>,
}

/// A contact edge that has a row.
#[derive(Debug, Clone, Copy)]
struct HeldEdge {
    contact: usize,
    /// 1 for u_i ≥ ψ_i, −1 for −u_i ≥ −ψ_i.
    sign: f64,
    is_soft: bool,
}

impl Program {
    /// Of all ticks.
    ///
    /// # Errors
    /// An edge with a limit in some ticks alone.
    pub fn new(quadratic: &Quadratic) -> Result<Self> {
        let edges = (0..quadratic.contact()).map(|contact| HeldEdge::of(quadratic, contact));
        let held: Vec<HeldEdge> =
            edges.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect();
        let (mut matrix, mut constraints) = (upper(&quadratic.matrix), Matrix::new());
        (0..quadratic.free()).for_each(|_| constraints.push([]));
        let mut rows = held.iter().enumerate().peekable();
        for contact in 0..quadratic.contact() {
            let own = rows.next_if(|(_, edge)| edge.contact == contact);
            constraints.push(own.map(|(row, edge)| (row, edge.sign)));
        }
        let mut count = held.len();
        for (row, _) in held.iter().enumerate().filter(|(_, edge)| edge.is_soft) {
            constraints.push([(row, 1.0), (count, 1.0)]);
            matrix.push([]);
            count += 1;
        }
        Ok(Self { matrix, constraints, count, held })
    }

    /// The linear part of the cost: −b, and m of each s.
    pub fn cost(&self, tick: &QuadraticLoads) -> Vec<f64> {
        let soft = self.held.iter().filter(|edge| edge.is_soft);
        let spans = soft.map(|edge| tick.span(edge.contact));
        tick.load.iter().map(|b| -b).chain(spans).collect()
    }

    /// r
    pub fn least(&self, tick: &QuadraticLoads) -> Vec<f64> {
        let of_edge = |edge: &HeldEdge| edge.sign * tick.lower[edge.contact];
        let mut least: Vec<f64> = self.held.iter().map(of_edge).collect();
        least.resize(self.count, 0.0);
        least
    }
}

impl HeldEdge {
    /// Nothing for a given flux.
    fn of(quadratic: &Quadratic, contact: usize) -> Result<Option<Self>> {
        let spans = || quadratic.ticks.iter().map(|tick| tick.span(contact));
        let is_soft = spans().all(f64::is_finite);
        if !is_soft && spans().any(|span| span != quadratic.ticks[0].span(contact)) {
            return Err(failed(format!("contact edge {contact} has a limit in some ticks alone")));
        }
        if spans().all(|span| span == 0.0) {
            return Ok(None);
        }
        let sign = if spans().any(|span| span < 0.0) { -1.0 } else { 1.0 };
        Ok(Some(Self { contact, sign, is_soft }))
    }
}

/// The upper triangle of a symmetric matrix by columns, rows ascending.
fn upper(matrix: &Matrix) -> Matrix {
    let mut upper = Matrix::new();
    for column in 0..matrix.order() {
        let mut above: Vec<_> = matrix.row(column).filter(|&(row, _)| row <= column).collect();
        above.sort_unstable_by_key(|&(row, _)| row);
        upper.push(above);
    }
    upper
}
