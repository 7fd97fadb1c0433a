//! The condensed model in f64: what the target does, without its haste.

use faer::{MatRef, Side};

use super::ends::nearest;
use super::{CondensedModel, Measure};
use signorini_contact::candidate::Candidate;
use signorini_contact::dense::ranges::Given;
use signorini_kernel::flux_range::Spans;
use signorini_reference::ReferenceError;

impl CondensedModel {
    /// x of the solution for the inputs `p` (m numbers, the first one 1): exactly 0 on active edges.
    ///
    /// # Errors
    /// Inputs of another number or with a limit below the flux, loads that pull a part away from its contact.
    pub fn solve(&self, p: &[f64]) -> Result<Vec<f64>, ReferenceError> {
        if p.len() != self.inputs {
            return Err(ReferenceError::Malformed("p must hold the constant 1 and every input"));
        }
        let n = self.contact;
        let matrix = MatRef::from_row_major_slice(&self.matrix, n, n);
        self.check_ends(p)?;
        let (load, spans) = (self.load_of(p), self.span_of(p));
        signorini_reference::minimise_between(matrix, &self.held_by_contact, &load, &spans)
    }

    /// 1/λ_min(Ŝ); 0 where contact alone holds a part, whose matrix is singular and solved so, and where there is no contact.
    pub fn inverse_norm(&self) -> f64 {
        if self.contact == 0 || !self.held_by_contact.is_empty() {
            return 0.0;
        }
        let matrix = MatRef::from_row_major_slice(&self.matrix, self.contact, self.contact);
        let values = matrix.self_adjoint_eigenvalues(Side::Lower).unwrap_or_default();
        let least = values.into_iter().fold(f64::INFINITY, f64::min);
        // Rounding may leave it negative; a failure tells nothing good either.
        if least.is_finite() { 1.0 / least.max(0.0) } else { f64::INFINITY }
    }

    /// B̂p
    pub fn load_of(&self, p: &[f64]) -> Vec<f64> {
        let mut load = vec![0.0; self.contact];
        for (column, p) in self.load.iter().zip(p) {
            load.iter_mut().zip(column).for_each(|(sum, entry)| *sum += p * entry);
        }
        load
    }

    /// r̂ = Ŝx − B̂p
    pub fn residual(&self, p: &[f64], x: &[f64]) -> Vec<f64> {
        let rows = self.matrix.chunks(self.contact.max(1));
        rows.zip(self.load_of(p)).map(|(row, load)| dot(row, x) - load).collect()
    }

    /// ∫_C (τ·n − lo) of any x within its sides, τ within the law of contact; ∫(hi − τ·n) where lo is infinite.
    pub fn force(&self, p: &[f64], x: &[f64]) -> f64 {
        let edges =
            self.residual(p, x).into_iter().zip(x).zip(self.ends_of(p)).zip(&self.multiplier);
        edges.fold(0.0, |sum, (((r, &x), [least, greatest]), multiplier)| {
            let tau = nearest(r, x, [least, greatest]);
            let pressed = if least.is_finite() { tau - least } else { greatest - tau };
            sum + multiplier * pressed
        })
    }

    /// Values of the unknowns, in the order of the contact edges.
    pub fn by_edge(&self, x: &[f64]) -> Vec<f64> {
        let mut by_edge = vec![0.0; self.contact];
        self.edges.iter().zip(x).for_each(|(&edge, &x)| by_edge[edge] = x);
        by_edge
    }

    /// The declared outputs of any x within its sides; `None` where there is no bound.
    pub fn outputs(&self, p: &[f64], x: &[f64]) -> Vec<Option<f64>> {
        let (residual, spans) = (self.residual(p, x), self.span_of(p));
        let ranges = Given::between(&[], Spans::baked(&spans, 0.0), &[]).ranges;
        let answer = Candidate { inputs: p, x, residual: &residual, ranges };
        let value = |measure: &Measure| match measure {
            Measure::Bound => self.bound(p, x),
            of_answer => of_answer.view().value(&answer, None).ok(),
        };
        self.outputs.iter().map(value).collect()
    }
}

/// Σ a_i b_i
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
