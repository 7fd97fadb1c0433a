//! Contact edges whose side is known before anything is eliminated: they are no unknowns.
//!
//! One that is always open is as free as an edge inside, and its flux is q. One that always touches has u = ψ. What a residual of 1 on an
//! unknown is mended by goes through neither:
//! ```text
//!   w_i = Σ_j (Ŝ_UT)⁻¹_ji τ_j,    i in U, j in U and T,      Ŝ_UT the matrix as if T were unknown as well
//! ```

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

use super::Pieces;
use super::best::Table;
use super::elimination::Field;
use super::form::FormData;

/// Contact edges that no step puts on another side, counted from the first contact edge.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Settled {
    /// Always open.
    pub open: Vec<usize>,
    /// Always touching.
    pub touching: Vec<usize>,
}

impl Settled {
    /// Whether an edge is an unknown.
    pub fn keeps(&self, edge: usize) -> bool {
        !self.open.contains(&edge) && !self.touching.contains(&edge)
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.open.len() + self.touching.len()
    }
}

impl FormData<'_> {
    /// Fluxes of the w_i; nothing where Ŝ_UT is singular to rounding.
    pub(super) fn mending(&self) -> Option<Table> {
        let Pieces { problem, edges, settled, patterns, .. } = self.columns.pieces;
        let (n, free) = (edges.len(), problem.topology.counts.free);
        let rows: Vec<usize> = edges.iter().chain(&settled.touching).map(|at| free + at).collect();
        let own = self.columns.fields[patterns.len()..].iter().cloned();
        let touching = self.touching.iter().zip(&rows[n..]).map(|(field, &row)| {
            let mut field = field.clone();
            field.scale(field.flux[row].sqrt().recip());
            field
        });
        let fields: Vec<Field> = own.chain(touching).collect();
        // The flux of each column through its own edge is 1/d.
        let entry = |i: usize, j: usize| fields[j].flux[rows[i]] / fields[i].flux[rows[i]];
        let matrix = Mat::from_fn(rows.len(), rows.len(), |i, j| {
            if i == j { 1.0 } else { 0.5 * (entry(i, j) + entry(j, i)) }
        });
        let units = Mat::from_fn(rows.len(), n, |i, j| f64::from(u8::from(i == j)));
        let factors = matrix.llt(Side::Lower).ok()?.solve(units);
        let mut table = Table::new(problem.ends.len(), n);
        for (j, field) in fields.iter().enumerate() {
            for (edge, flux) in field.flux.iter().enumerate() {
                let to = table.row_mut(edge).iter_mut().enumerate();
                to.for_each(|(i, to)| *to += factors[(j, i)] * flux);
            }
        }
        Some(table)
    }
}
