//! A model of modes at one value of its coefficient: matrix, loads, outputs, bound.

use super::ModalModel;
use crate::evaluate::dot;
use crate::model::sum;
use crate::{CondensedModel, Measure};

impl ModalModel {
    /// p and y where the input of the coefficient is `value`, of any x of [`ModalModel::model`].
    pub fn amplitudes(&self, value: f64, p: &[f64], x: &[f64]) -> Vec<f64> {
        let rows = self.of_inputs.iter().zip(&self.of_contact);
        let sums = rows.map(|(beta, alpha)| dot(beta, p) + dot(alpha, x));
        let y = self.gains(value).into_iter().zip(sums).map(|(gain, sum)| gain * sum);
        p.iter().copied().chain(y.collect::<Vec<_>>()).collect()
    }

    /// The guaranteed bound of (p, x), x within its sides in [`ModalModel::model`], in the unit of ‖A^½∇u‖; `None` where there is none.
    pub fn bound(&self, value: f64, p: &[f64], x: &[f64]) -> Option<f64> {
        let p = self.amplitudes(value, p, x);
        self.model.bound_with(self.norm(value, &p, x)?, &p, x)
    }

    /// (|F(z)|² + δ |F_π(z)|²)^½, `p` with its amplitudes.
    pub(crate) fn norm(&self, value: f64, p: &[f64], x: &[f64]) -> Option<f64> {
        let (form, of_laws) = (self.model.certificate.as_ref().ok()?, self.of_laws.as_ref()?);
        let [own, laws] =
            [&form.factor, &of_laws.factor].map(|factor| self.model.norm(form, factor, p, x));
        let delta = (value - self.origin).max(0.0);
        Some((own * own + delta * laws * laws).sqrt())
    }

    /// g_k = δ/(1 + δν_k)
    pub fn gains(&self, value: f64) -> Vec<f64> {
        let delta = value - self.origin;
        self.compliance.iter().map(|nu| delta / (1.0 + delta * nu)).collect()
    }

    /// The model where the input of the coefficient is `value`; without an error bound, which is that of another coefficient.
    pub fn at(&self, value: f64) -> CondensedModel {
        let mut model = self.in_own_scale(value);
        model.normalise();
        model
    }

    /// Model at `value` with the x of [`ModalModel::model`]: its matrix has a diagonal of 1 or more.
    pub fn in_own_scale(&self, value: f64) -> CondensedModel {
        let (n, unit) = (self.model.contact, self.model.energy_unit);
        let gains = self.gains(value);
        let mut model = self.model.clone();
        for ((gain, alpha), beta) in gains.iter().zip(&self.of_contact).zip(&self.of_inputs) {
            let alpha: Vec<f64> = alpha.iter().map(|alpha| alpha / unit).collect();
            for (row, a) in model.matrix.chunks_mut(n.max(1)).zip(&alpha) {
                row.iter_mut().zip(&alpha).for_each(|(entry, b)| *entry += gain * a * b);
            }
            for (column, b) in model.load.iter_mut().zip(beta) {
                let changes = column.iter_mut().zip(&alpha);
                changes.for_each(|(entry, a)| *entry -= gain * a * b / unit);
            }
        }
        for measure in &mut model.outputs {
            self.follow(measure, &gains);
        }
        model.keep_inputs(self.inputs, "the bound of another coefficient");
        model.defaults[self.input] = value;
        model
    }

    /// y put into an output.
    fn follow(&self, measure: &mut Measure, gains: &[f64]) {
        let Some((of_inputs, of_contact, _)) = sum(measure) else { return };
        if of_inputs.len() <= self.inputs {
            return;
        }
        let of_modes = of_inputs.split_off(self.inputs);
        of_contact.resize(self.model.contact, 0.0);
        for (k, (factor, gain)) in of_modes.iter().zip(gains).enumerate() {
            let add = |to: &mut [f64], row: &[f64]| {
                to.iter_mut().zip(row).for_each(|(sum, entry)| *sum += factor * gain * entry);
            };
            add(of_inputs, &self.of_inputs[k]);
            add(of_contact, &self.of_contact[k]);
        }
    }
}

impl CondensedModel {
    /// To a unit diagonal: x_i √Ŝ_ii are the unknowns then.
    fn normalise(&mut self) {
        let n = self.contact;
        let roots: Vec<f64> = (0..n).map(|i| self.matrix[i * n + i].sqrt()).collect();
        for (row, root) in self.matrix.chunks_mut(n.max(1)).zip(&roots) {
            row.iter_mut().zip(&roots).for_each(|(entry, other)| *entry /= root * other);
        }
        let divide = |numbers: &mut [f64]| {
            numbers.iter_mut().zip(&roots).for_each(|(number, root)| *number /= root);
        };
        let multiply = |numbers: &mut [f64]| {
            numbers.iter_mut().zip(&roots).for_each(|(number, root)| *number *= root);
        };
        self.load.iter_mut().chain(&mut self.spans).for_each(|column| divide(column));
        divide(&mut self.opening);
        multiply(&mut self.multiplier);
        for (_, of_contact, of_reaction) in self.outputs.iter_mut().filter_map(sum) {
            divide(of_contact);
            multiply(of_reaction);
        }
    }
}
