//! By how much a model of modes differs from itself at another value of its coefficient.
//!
//! With g_k(δ) = δ/(1 + δν_k) and a_k = β_k·p + U α_k·x, between two values of δ
//! ```text
//!   rows of Ŝx − B̂p   differ by Σ_k Δg_k α_ki a_k / U,        outputs differ by Σ_k f_k Δg_k a_k.
//! ```
//! g_k grows with δ, so that |Δg_k| is largest at an end. Modes that are left out, and rounding of all sums, are added.

use super::interval::{Interval, dot};
use crate::{Measure, ModalModel};

/// Roundings of a gain, and of a sum beside those of its terms.
const FEW: f64 = 8.0;

/// How far a model may be from the one at another value, for p and x within intervals.
pub(super) struct Change<'c> {
    modes: &'c ModalModel,
    p: &'c [Interval],
    x: &'c [Interval],
    /// |Δg_k|
    steps: Vec<f64>,
    /// g_k at most.
    gains: Vec<f64>,
    /// |a_k|
    amplitudes: Vec<f64>,
    /// δ at most.
    most: f64,
}

impl<'c> Change<'c> {
    /// From the model at `value` to those at any value of the coefficient's input in `range`, which holds it.
    pub fn new(
        modes: &'c ModalModel,
        value: f64,
        range: [f64; 2],
        [p, x]: [&'c [Interval]; 2],
    ) -> Self {
        let [here, least, gains] = [value, range[0], range[1]].map(|value| modes.gains(value));
        let step = |k: usize| {
            let step = (gains[k] - here[k]).max(here[k] - least[k]).max(0.0);
            step + FEW * f64::EPSILON * gains[k]
        };
        let of = |row: &[f64], numbers: &[Interval]| {
            dot(row.iter().copied().map(Interval::point), numbers.iter().copied())
        };
        let rows = modes.of_inputs.iter().zip(&modes.of_contact);
        Self {
            steps: (0..gains.len()).map(step).collect(),
            amplitudes: rows.map(|(beta, alpha)| (of(beta, p) + of(alpha, x)).size()).collect(),
            most: range[1] - modes.origin,
            gains,
            modes,
            p,
            x,
        }
    }

    /// Row `at` of Ŝx − B̂p, in size.
    pub fn of_row(&self, at: usize) -> f64 {
        let unit = self.modes.model.energy_unit;
        let of_modes = |weights: &[f64]| -> f64 {
            let rows = self.modes.of_contact.iter().zip(weights).zip(&self.amplitudes);
            rows.map(|((alpha, weight), a)| weight * alpha[at].abs() * a).sum::<f64>()
                / unit.powi(2)
        };
        let terms = self.steps.len() + self.modes.inputs + self.modes.model.contact;
        let rounding = (terms as f64 + FEW) * f64::EPSILON;
        let all = self.own_terms(at) + of_modes(&self.gains);
        of_modes(&self.steps) + self.left_out(at) + rounding * all
    }

    /// An output, in size; 0 of a length, which is none of (p, y, x).
    pub fn of_output(&self, measure: &Measure) -> f64 {
        match measure {
            Measure::Linear { of_inputs, .. } | Measure::Flux { of_inputs, .. } => {
                let of_modes = of_inputs.iter().skip(self.modes.inputs);
                let terms = of_modes.zip(&self.steps).zip(&self.amplitudes);
                terms.map(|((factor, step), a)| factor.abs() * step * a).sum()
            }
            Measure::Length { .. } | Measure::Saturated { .. } | Measure::Bound => 0.0,
        }
    }

    /// The sizes of all terms of a row where δ = 0.
    fn own_terms(&self, at: usize) -> f64 {
        let model = &self.modes.model;
        let row = &model.matrix[at * model.contact..][..model.contact];
        let of_contact: f64 = row.iter().zip(self.x).map(|(s, x)| s.abs() * x.size()).sum();
        let load = model.load.iter().zip(self.p);
        of_contact + load.map(|(column, p)| column[at].abs() * p.size()).sum::<f64>()
    }

    /// Largest contribution to a row of the modes that are left out.
    fn left_out(&self, at: usize) -> f64 {
        let out = &self.modes.left_out;
        let sum = |of: &[f64], numbers: &[Interval]| -> f64 {
            of.iter().zip(numbers).map(|(of, number)| of * number.size()).sum()
        };
        let all = sum(&out.of_inputs, self.p) + sum(&out.of_contact, self.x);
        self.most * out.of_contact[at] * all / self.modes.model.energy_unit.powi(2)
    }
}
