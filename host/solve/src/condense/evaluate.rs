//! The condensed model in f64: what the target does, without its haste.

use faer::{MatRef, Side};

use super::{CondensedModel, Form, Measure};
use crate::reference::{self, ReferenceError};

/// An excess this far below 0 against the size of its terms is rounding of its sum.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

impl CondensedModel {
    /// x of the solution for the inputs `p` (m numbers, the first one 1): exactly 0 on active edges.
    ///
    /// # Errors
    /// Inputs of another number, loads that pull a part away from its contact.
    pub fn solve(&self, p: &[f64]) -> Result<Vec<f64>, ReferenceError> {
        if p.len() != self.inputs {
            return Err(ReferenceError::Malformed("p must hold the constant 1 and every input"));
        }
        let n = self.contact;
        let matrix = MatRef::from_row_major_slice(&self.matrix, n, n);
        reference::minimise(matrix, &self.held_by_contact, &self.load_of(p))
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

    /// The spans for these inputs; none where no flux has a limit.
    pub fn span_of(&self, p: &[f64]) -> Vec<f64> {
        let mut spans = self.spans.first().cloned().unwrap_or_default();
        for (column, p) in self.spans.iter().zip(p).skip(1) {
            spans.iter_mut().zip(column).for_each(|(sum, entry)| *sum += p * entry);
        }
        spans
    }

    /// Whether an input changes a span.
    pub fn is_varying(&self) -> bool {
        self.spans.iter().skip(1).flatten().any(|&entry| entry != 0.0)
    }

    /// r̂ = Ŝx − B̂p
    pub fn residual(&self, p: &[f64], x: &[f64]) -> Vec<f64> {
        let rows = self.matrix.chunks(self.contact.max(1));
        rows.zip(self.load_of(p)).map(|(row, load)| dot(row, x) - load).collect()
    }

    /// ∫_C (τ·n − q) of any x ≥ 0, within the law of contact.
    pub fn force(&self, p: &[f64], x: &[f64]) -> f64 {
        pressed(&self.multiplier, x, &self.residual(p, x))
    }

    /// What belongs to the unknowns, in the order of the contact edges.
    pub fn by_edge(&self, x: &[f64]) -> Vec<f64> {
        let mut by_edge = vec![0.0; self.contact];
        self.edges.iter().zip(x).for_each(|(&edge, &x)| by_edge[edge] = x);
        by_edge
    }

    /// The declared outputs of any x ≥ 0; `None` where there is no bound.
    pub fn outputs(&self, p: &[f64], x: &[f64]) -> Vec<Option<f64>> {
        let residual = self.residual(p, x);
        let value = |measure: &Measure| match measure {
            Measure::Linear { of_inputs, of_contact } => {
                Some(dot(of_inputs, p) + dot(of_contact, x))
            }
            Measure::Flux { of_inputs, of_contact, of_reaction } => {
                let elsewhere = dot(of_inputs, p) + dot(of_contact, x);
                Some(elsewhere + pressed(of_reaction, x, &residual))
            }
            Measure::Length { always, of_contact } => {
                let touching = of_contact.iter().zip(x).filter(|&(_, &x)| x == 0.0);
                Some(touching.fold(*always, |sum, (length, _)| sum + length))
            }
            Measure::Saturated { always, of_contact } => {
                let beyond = of_contact.iter().zip(x).filter(|&(_, &x)| x < 0.0);
                Some(beyond.fold(*always, |sum, (length, _)| sum + length))
            }
            Measure::Bound => self.bound(p, x),
        };
        self.outputs.iter().map(value).collect()
    }

    /// The guaranteed bound of ‖A^½∇_h(u − u_h)‖ for any x ≥ 0; `None` where there is none.
    pub fn bound_of_u(&self, p: &[f64], x: &[f64]) -> Option<f64> {
        let form = self.certificate.as_ref().ok()?;
        let jump = form.norm(form.jump.as_ref().unwrap_or(&form.factor), p, x);
        Some(self.bound(p, x)? + self.energy_unit * jump)
    }

    /// The guaranteed bound of (p, x) for any x ≥ 0, in the unit of ‖A^½∇u‖; `None` where there is none.
    pub fn bound(&self, p: &[f64], x: &[f64]) -> Option<f64> {
        let form = self.certificate.as_ref().ok()?;
        self.bound_with(form.norm(&form.factor, p, x), p, x)
    }

    /// The same, `norm` being that of the residual A^½∇s − A^{−½}τ.
    pub(super) fn bound_with(&self, norm: f64, p: &[f64], x: &[f64]) -> Option<f64> {
        let form = self.certificate.as_ref().ok()?;
        let mut residual = self.residual(p, x);
        let slack = form.stability * form.mend(&self.opening, &mut residual, x)?;
        let gap = norm + slack;
        let (mut square, mut moved) = (gap.powi(2), 0.0);
        for corner in &form.corners {
            let excess = dot(&corner.excess, p);
            let size: f64 = corner.excess.iter().zip(p).map(|(a, p)| (a * p).abs()).sum();
            if excess < -ROUNDING * size {
                return None;
            }
            if x[corner.edge] == 0.0 {
                square += excess.max(0.0) * residual[corner.edge];
            }
            moved += excess.min(0.0).abs() * corner.energy;
        }
        let oscillation: f64 = form.oscillation.iter().zip(p).map(|(osc, p)| osc * p.abs()).sum();
        let oscillation = oscillation + moved;
        Some(self.energy_unit * (oscillation + (square + oscillation * oscillation).sqrt()))
    }
}

impl Form {
    /// d of (p, x): what brings e to 0 beside active edges, and up to 0 elsewhere.
    pub fn correction(&self, x: &[f64]) -> Vec<f64> {
        let correction = |vertex: &super::Vertex| {
            let [a, b] = vertex.edges;
            let e = vertex.weights[0] * x[a] + vertex.weights[1] * x[b];
            let active = vertex.beside.iter().any(|&edge| x[edge] == 0.0);
            if active || e < 0.0 { -e } else { 0.0 }
        };
        self.vertices.iter().map(correction).collect()
    }

    /// |F(p, x, d)| for one of the forms.
    pub(super) fn norm(&self, factor: &[f64], p: &[f64], x: &[f64]) -> f64 {
        let z: Vec<f64> = p.iter().chain(x).copied().chain(self.correction(x)).collect();
        let mut rows = vec![0.0; z.len()];
        let mut start = 0;
        for (j, z) in z.iter().enumerate() {
            let column = &factor[start..=start + j];
            rows.iter_mut().zip(column).for_each(|(row, entry)| *row += entry * z);
            start += j + 1;
        }
        rows.iter().map(|row| row * row).sum::<f64>().sqrt()
    }

    /// Mends the residual r̂ and returns |δ|; `None` where what is left over has no way out.
    ///
    /// What is mended must be 0 on inactive edges and ≥ 0 on active ones. Where contact alone holds a
    /// part, the sum of all that was taken there leaves through its edge that is pressed most.
    pub(super) fn mend(&self, openings: &[f64], residual: &mut [f64], x: &[f64]) -> Option<f64> {
        let (mut square, mut surplus) = (0.0, 0.0);
        let mut deltas = vec![0.0; residual.len()];
        for ((residual, &x), delta) in residual.iter_mut().zip(x).zip(&mut deltas) {
            *delta = if x == 0.0 { residual.min(0.0) } else { *residual };
            *residual -= *delta;
            square += *delta * *delta;
        }
        self.floating.iter().for_each(|&edge| surplus += deltas[edge] / openings[edge]);
        if self.floating.iter().any(|&edge| deltas[edge] != 0.0) {
            let force = |edge: usize| residual[edge] / openings[edge];
            let touching = self.floating.iter().copied().filter(|&edge| x[edge] == 0.0);
            let out = touching.max_by(|&i, &j| force(i).total_cmp(&force(j)))?;
            let change = openings[out] * surplus;
            residual[out] += change;
            square += change * change;
            if residual[out] < 0.0 {
                return None;
            }
        }
        Some(square.sqrt())
    }
}

/// Σ weights · r over the edges with x = 0 and r > 0.
fn pressed(weights: &[f64], x: &[f64], residual: &[f64]) -> f64 {
    let edges = weights.iter().zip(x).zip(residual);
    let touching = edges.filter(|((_, x), _)| **x == 0.0);
    touching.fold(0.0, |sum, ((weight, _), r)| sum + weight * r.max(0.0))
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
