//! Modes that do not matter, and what it costs that they are no part of the model.

use signorini_problem::Problem;

/// (Σ over the modes left out of δ a_k²)^½ is at most √δ (Σ|p_j| of_inputs_j + Σ x_i of_contact_i).
#[derive(Debug, Clone)]
pub struct LeftOut {
    /// How many.
    pub count: usize,
    /// The norm of all their β_k, a number for each input.
    pub of_inputs: Vec<f64>,
    /// The norm of all their U α_k, a number for each contact edge.
    pub of_contact: Vec<f64>,
}

/// Weights of modes.
pub(super) struct Shares<'a> {
    /// The largest δ.
    pub change: f64,
    /// Columns by input, a number a mode.
    pub inputs: &'a [Vec<f64>],
    /// How large each input may be.
    pub sizes: &'a [f64],
    /// Columns by contact edge, a number a mode.
    pub contact: &'a [Vec<f64>],
    /// d of each contact edge where U = 1.
    pub openings: &'a [f64],
}

impl Shares<'_> {
    /// The share of a mode: that of the energy of unit openings, Ŝ having a diagonal of 1, or that of what all inputs make of
    /// all modes, the larger.
    pub fn of(&self, k: usize) -> f64 {
        let square = |k: usize| -> f64 {
            let terms = self.inputs.iter().zip(self.sizes);
            terms.map(|(of, size)| (of[k] * size).powi(2)).sum()
        };
        let modes = self.inputs.first().map_or(0, Vec::len);
        let all: f64 = (0..modes).map(square).sum();
        let contact = self.contact.iter().zip(self.openings);
        let contact: f64 = contact.map(|(of, d)| (of[k] * d).powi(2)).sum();
        (self.change * contact).max(if all > 0.0 { square(k) / all } else { 0.0 })
    }
}

/// How large the constant and every input may be: at the end of its range, or by its default where there is none.
pub(super) fn sizes(problem: &Problem) -> Vec<f64> {
    let of_inputs = problem.scene.inputs.iter().map(|input| {
        let most = input.interval().into_iter().fold(0.0, |most: f64, end| most.max(end.abs()));
        let default = if input.default == 0.0 { 1.0 } else { input.default.abs() };
        if most.is_finite() { most } else { default }
    });
    std::iter::once(1.0).chain(of_inputs).collect()
}

/// The norms of `count` columns.
pub(super) fn norms(rows: &[Vec<f64>], count: usize) -> Vec<f64> {
    let square = |j: usize| rows.iter().map(|row| row[j] * row[j]).sum::<f64>();
    (0..count).map(|j| square(j).sqrt()).collect()
}
