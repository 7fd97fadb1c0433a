//! The modes of a transfer coefficient as the target has them: units of their own, and what rounding makes of them.
//!
//! With U the unit of energy and T a power of 4 next to the largest change of the coefficient,
//! ```text
//!   t = δ/T,   α = √T U α/U,   β = √T β/U,   ν = T ν,   y = y/(√T U)
//! ```
//! so that Ŝ(t), b and y are of order 1 as Ŝ, x and r̂ are.
//!
//! What the certificate is told of Ŝ and B̂ holds for every t: sums of the sizes of all terms at the largest t, for 2 (n + m) + K + 40
//! roundings where it counts n + m + K + 4. The flux through the boundary is off its law by √t |Δa|, a_k = β_k·p + α_k·x rounded, and
//! by the a_k of the modes that were left out: both are counted in the columns of F_π.

#[cfg(test)]
mod tests;

use signorini_condense::ranges::split::Split;
use signorini_condense::{CondensedModel, LawsForm, ModalModel};
use signorini_contact::Condensed;
use signorini_contact::modes::Modal;
use signorini_problem::scalar::Scalar;

use super::bound::{Bound, Columns};
use crate::narrow::narrow;

/// Roundings of an entry of Ŝ(t) beside one a mode.
const FEW: usize = 16;

/// The modes of a condensed scene in the scalar `R`.
#[derive(Debug, Clone)]
pub struct Modes<R> {
    /// K
    pub count: usize,
    /// How many were left out.
    pub left_out: usize,
    pub(super) input: usize,
    pub(super) origin: [R; 2],
    pub(super) per_unit: R,
    pub(super) compliance: Vec<R>,
    pub(super) of_inputs: Vec<R>,
    pub(super) laws: Option<Columns<R>>,
    /// Whether Ŝ(t) as the target works it out is a nonsingular M-matrix for every t.
    pub(super) is_monotone: bool,
    /// The largest entry of its diagonals.
    pub(super) diagonal: f64,
}

impl<R: Scalar> Modes<R> {
    /// How the kernel has them, with their model.
    pub fn view<'a>(&'a self, model: &Condensed<'a, R>) -> Modal<'a, R> {
        Modal {
            model: *model,
            input: self.input,
            origin: self.origin,
            per_unit: self.per_unit,
            compliance: &self.compliance,
            of_inputs: &self.of_inputs,
            laws: self.laws.as_ref().map(Columns::view),
            is_monotone: self.is_monotone,
        }
    }
}

/// A model of modes in the units of the target, in f64.
#[derive(Debug)]
pub struct Scaled<'m> {
    of: &'m ModalModel,
    /// Its inputs are those of the scene, then y; α are columns of its loads.
    pub model: CondensedModel,
    /// x of the default inputs.
    pub x: Vec<f64>,
    /// T
    unit: f64,
    /// ν
    compliance: Vec<f64>,
    /// β by modes.
    of_inputs: Vec<Vec<f64>>,
    /// The largest g_k.
    gains: Vec<f64>,
}

/// How much an input changes the coefficient at most.
fn change(of: &ModalModel) -> f64 {
    let [lo, hi] = of.model.ranges[of.input];
    hi - lo
}

/// T: a power of 4, so that its root is one of 2.
fn unit_of_change(of: &ModalModel) -> f64 {
    let change = change(of);
    if change > 0.0 { 4_f64.powf(change.log(4.0).round()) } else { 1.0 }
}

/// What 1 stands for in amplitudes on the target.
pub fn unit_of_amplitudes(of: &ModalModel) -> f64 {
    unit_of_change(of).sqrt() * of.model.energy_unit
}

impl<'m> Scaled<'m> {
    /// In the units of the target.
    pub fn new(of: &'m ModalModel) -> Self {
        let (unit, change) = (unit_of_change(of), change(of));
        let (root, energy) = (unit.sqrt(), of.model.energy_unit);
        let scaled = |row: &Vec<f64>| row.iter().map(|a| root * a / energy).collect::<Vec<f64>>();
        let alphas: Vec<Vec<f64>> = of.of_contact.iter().map(scaled).collect();
        let now = of.in_own_scale(of.model.defaults[of.input]);
        let mut model = of.model.clone();
        model.scale_inputs(of.inputs..of.model.inputs, root * energy);
        model.load.truncate(of.inputs);
        model.spans.truncate(of.inputs);
        model.load.extend(alphas);
        let compliance: Vec<f64> = of.compliance.iter().map(|nu| unit * nu).collect();
        let most = change / unit;
        Self {
            of,
            model,
            x: now.solve(&now.defaults).unwrap_or_else(|_| vec![0.0; of.model.contact]),
            unit,
            gains: compliance.iter().map(|nu| most / (1.0 + most * nu)).collect(),
            compliance,
            of_inputs: of.of_inputs.iter().map(scaled).collect(),
        }
    }

    fn alphas(&self) -> &[Vec<f64>] {
        &self.model.load[self.of.inputs..]
    }

    /// |Ŝ_ij| and all that is added to it, in size.
    fn size(&self, i: usize, j: usize) -> f64 {
        let added = self.alphas().iter().zip(&self.gains).map(|(alpha, g)| g * alpha[i] * alpha[j]);
        self.model.matrix[i * self.model.contact + j].abs() + added.map(f64::abs).sum::<f64>()
    }

    /// At most how far above 0 Ŝ(t) may be before it is rounded, and then becomes 0; nothing where it may be by more.
    fn slack(&self) -> Option<f64> {
        let out = &self.of.left_out.of_contact;
        let most = out.iter().fold(0.0, |most: f64, a| most.max(*a));
        let [lo, hi] = self.of.model.ranges[self.of.input];
        let left_out = (hi - lo) * most * out.iter().sum::<f64>();
        Some(self.of.slack? + left_out / self.model.energy_unit.powi(2))
    }

    /// Whether Ŝ(t) is one, rounded and without positive entries off the diagonal: it is not below Ŝ, less what rounding makes of
    /// it, and what is not below a nonsingular M-matrix, with such signs, is one.
    fn is_monotone<R: Scalar>(&self) -> bool {
        let (Some(slack), n) = (self.slack(), self.model.contact) else { return false };
        let roundings = (self.compliance.len() + FEW) as f64 * R::EPSILON.wide();
        let least = |(at, entry): (usize, &f64)| {
            R::narrow(*entry).wide() - roundings * self.size(at / n, at % n) - slack
        };
        let least: Vec<f64> = self.model.matrix.iter().enumerate().map(least).collect();
        n > 0 && Split::new(&least, n).is_some_and(|split| split.has_all_signs())
    }

    /// The modes in the scalar of the target.
    pub fn modes<R: Scalar>(&self, is_certified: bool) -> Modes<R> {
        let (of, n) = (self.of, self.model.contact);
        let near = R::narrow(of.origin);
        let rest = R::narrow(of.origin - near.wide());
        let diagonal = (0..n).map(|i| self.size(i, i)).fold(1.0, f64::max);
        let laws = of.of_laws.as_ref().filter(|_| is_certified);
        Modes {
            count: self.compliance.len(),
            left_out: of.left_out.count,
            input: of.input,
            origin: [near, rest],
            per_unit: R::narrow(1.0 / self.unit),
            compliance: narrow(&self.compliance),
            of_inputs: self.of_inputs.iter().flat_map(|row| narrow(row)).collect(),
            laws: laws.map(|laws| self.laws(laws)),
            is_monotone: self.is_monotone::<R>(),
            diagonal,
        }
    }

    /// F_π, with all that the flux through the boundary may be off its law.
    fn laws<R: Scalar>(&self, laws: &LawsForm) -> Columns<R> {
        let (m, modes) = (self.of.inputs, self.compliance.len());
        let (n, root) = (self.model.contact, self.unit.sqrt());
        let energy = self.model.energy_unit;
        let vertices = laws.lost.len() - m - modes - n;
        let of_column = |j: usize| if (m..m + modes).contains(&j) { root * energy } else { 1.0 };
        let order = laws.lost.len();
        let columns = (0..order).flat_map(|j| (0..=j).map(move |_| j)).zip(&laws.factor);
        let factor: Vec<f64> = columns.map(|(j, entry)| root * of_column(j) * entry).collect();
        // The roundings of a_k and g_k in the scalar, and in f64 those of α, β and ν themselves.
        let roundings = 0.5 * R::EPSILON.wide() * (n + m + 2 * FEW) as f64 + 64.0 * f64::EPSILON;
        let off = |rows: &[Vec<f64>], j: usize, left_out: f64| {
            roundings * rows.iter().map(|row| row[j] * row[j]).sum::<f64>().sqrt()
                + root * left_out / energy
        };
        let out = &self.of.left_out;
        let of_inputs = (0..m).map(|j| off(&self.of_inputs, j, out.of_inputs[j]));
        let of_contact = (0..n).map(|i| off(self.alphas(), i, out.of_contact[i]));
        let more = of_inputs.chain(vec![0.0; modes]).chain(of_contact).chain(vec![0.0; vertices]);
        let lost = laws.lost.iter().enumerate().map(|(j, lost)| root * of_column(j) * lost);
        let lost: Vec<f64> = lost.zip(more).map(|(lost, more)| lost + more).collect();
        Columns::new(&factor, &lost, order)
    }

    /// What the certificate is told of Ŝ(t) and B̂(t): that of Ŝ and B̂ with all that is added, and as many roundings as that takes.
    pub fn tell<R: Scalar>(&self, bound: &mut Bound<R>) {
        let (n, m, modes) = (self.model.contact, self.of.inputs, self.compliance.len());
        let counted = (n + m + modes + 4) as f64;
        let times = 2.0 + 2.0 * FEW as f64 / counted;
        let row = |i: usize| (0..n).map(|j| self.size(i, j)).sum::<f64>();
        let clamped = self.slack().unwrap_or(0.0) / (0.5 * R::EPSILON.wide() * counted);
        bound.row_sum = R::narrow(times * (0..n).map(row).fold(0.0, f64::max) + clamped);
        let largest = |j: usize| {
            let entry = |i: usize| {
                let terms = self.alphas().iter().zip(&self.of_inputs).zip(&self.gains);
                let added = terms.map(|((alpha, beta), g)| (g * alpha[i] * beta[j]).abs());
                self.model.load[j][i].abs() + added.sum::<f64>()
            };
            times * (0..n).map(entry).fold(R::TINY.wide(), f64::max)
        };
        let none = vec![0.0; modes];
        bound.largest_load = narrow(&(0..m).map(largest).chain(none).collect::<Vec<_>>());
    }
}
