//! A tick as a quadratic program whose bounds are rows, for solvers that know neither three sides nor kinks.
//!
//! ```text
//!   minimise ½ uᵀKu − bᵀu + Σ m_i s_i   over s_i ≥ 0,  u_i + s_i ≥ ψ_i      0 < m_i < ∞:  λ_i lies between 0 and m_i
//!                                       over           u_i       ≥ ψ_i      m_i = ∞
//!                                       over          −u_i       ≥ −ψ_i     m_i = −∞
//! ```
//! z = (u, s), and C z ≥ r. An edge of m_i = 0 has a given flux and no row. Without limits z is u, and C takes the contact
//! unknowns out of it.

use signorini_scene::Result;

use super::failed;
use super::quadratic::{Matrix, Quadratic, QuadraticLoads};

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
