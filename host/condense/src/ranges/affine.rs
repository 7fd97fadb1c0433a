//! Outputs of solutions as affine functions of (p, x), with intervals for factors.

use super::interval::{Interval, dot};
use crate::CondensedModel;

/// y = a·p + c·x, for solutions.
#[derive(Debug, Clone)]
pub(super) struct AffineOutput {
    /// a
    pub of_inputs: Vec<Interval>,
    /// c
    pub of_contact: Vec<Interval>,
}

impl AffineOutput {
    /// 0
    pub fn none(model: &CondensedModel) -> Self {
        Self {
            of_inputs: vec![Interval::ZERO; model.inputs],
            of_contact: vec![Interval::ZERO; model.contact],
        }
    }

    /// Row `at` of Sx − Bp.
    pub fn row(model: &CondensedModel, at: usize) -> Self {
        let mut row = Self::none(model);
        row.add(model, at, 1.0);
        row
    }

    /// Where it lies for p and x within these.
    pub fn within(&self, p: &[Interval], x: &[Interval]) -> Interval {
        let of_inputs = dot(self.of_inputs.iter().copied(), p.iter().copied());
        of_inputs + dot(self.of_contact.iter().copied(), x.iter().copied())
    }

    /// Adds μ times an end of row `at` of Sx − Bp: 0 for the lower one, 1 for the upper one.
    pub fn add_end(&mut self, model: &CondensedModel, at: usize, end: usize, weight: f64) {
        if weight == 0.0 || !model.is_limited() {
            return;
        }
        let factors = &model.end_columns(at)[end];
        for (sum, &factor) in self.of_inputs.iter_mut().zip(factors).filter(|(_, f)| **f != 0.0) {
            *sum = *sum + Interval::point(weight) * Interval::point(factor);
        }
    }

    /// Adds μ times row `at` of Sx − Bp.
    pub fn add(&mut self, model: &CondensedModel, at: usize, weight: f64) {
        if weight == 0.0 {
            return;
        }
        let weight = Interval::point(weight);
        for (sum, column) in self.of_inputs.iter_mut().zip(&model.load) {
            *sum = *sum - weight * Interval::point(column[at]);
        }
        let row = &model.matrix[at * model.contact..][..model.contact];
        for (sum, &entry) in self.of_contact.iter_mut().zip(row) {
            *sum = *sum + weight * Interval::point(entry);
        }
    }
}

impl CondensedModel {
    /// Where the least and the greatest r̂ of an edge lie, for p within these.
    pub(super) fn ends_within(&self, at: usize, p: &[Interval]) -> [Interval; 2] {
        self.end_columns(at).map(|end| match end[0].is_finite() {
            true => dot(end.into_iter().map(Interval::point), p.iter().copied()),
            false => Interval::point(end[0]),
        })
    }
}
