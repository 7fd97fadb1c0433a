//! The energy unit U: a power of two, so that scaling rounds nothing. Where the defaults of the inputs make next to
//! nothing, what one unit of each input makes tells the size: a large input would overflow f32 otherwise.

use std::ops::Range;

use super::factor::column;
use super::model::sum;
use super::{CondensedModel, Form};

/// Answers at the defaults that are smaller than this part of what one input does are cancellation or 0.
const NEAR: f64 = 1e-6;

impl CondensedModel {
    /// Chooses U so that x and r̂ at the default inputs, or without contact the bound, are of order 1.
    pub(super) fn choose_unit(&mut self) {
        let (own, of_inputs) = (self.size(&self.defaults), self.size_of_inputs());
        let size = if own >= NEAR * of_inputs { own } else { of_inputs };
        let exponent = size.log2().round();
        if exponent.is_finite() {
            self.rescale(exponent.exp2());
        }
    }

    /// The largest load of one input alone, by its default or, where that is 0, by 1: what the inputs stand for where
    /// their defaults, or their sum, say nothing.
    fn size_of_inputs(&self) -> f64 {
        let forms = self.certificate.iter();
        let forms = forms.flat_map(|form| (0..self.inputs).map(|j| column(&form.factor, j)));
        let all = self.load.iter().map(Vec::as_slice).zip(&self.defaults);
        let sizes = all.chain(forms.zip(&self.defaults)).map(|(column, &default)| {
            let value = if default == 0.0 { 1.0 } else { default.abs() };
            value * largest(column)
        });
        sizes.filter(|size| size.is_finite()).fold(0.0, f64::max)
    }

    fn size(&self, p: &[f64]) -> f64 {
        match self.solve(p) {
            Ok(x) if self.contact > 0 => largest(&x).max(largest(&self.residual(p, &x))),
            Ok(x) => self.bound(p, &x).unwrap_or(1.0),
            Err(_) => 1.0,
        }
    }

    /// Multiplies columns that are no inputs of the scene by `unit`: what was one of them stands for that.
    pub fn scale_inputs(&mut self, columns: Range<usize>, unit: f64) {
        self.load[columns.clone()].iter_mut().flatten().for_each(|entry| *entry *= unit);
        for (of_inputs, ..) in self.outputs.iter_mut().filter_map(sum) {
            let own = of_inputs.iter_mut().skip(columns.start).take(columns.len());
            own.for_each(|factor| *factor *= unit);
        }
        let Ok(form) = &mut self.certificate else { return };
        let entries = columns.start * (columns.start + 1) / 2..columns.end * (columns.end + 1) / 2;
        for factor in std::iter::once(&mut form.factor).chain(&mut form.jump) {
            factor[entries.clone()].iter_mut().for_each(|entry| *entry *= unit);
        }
        form.lost[columns].iter_mut().for_each(|lost| *lost *= unit);
    }

    /// Goes from U = 1 to `unit`.
    fn rescale(&mut self, unit: f64) {
        self.energy_unit = unit;
        self.opening.iter_mut().chain(&mut self.multiplier).for_each(|number| *number *= unit);
        let loads = self.load.iter_mut().chain(&mut self.spans).flatten();
        loads.for_each(|number| *number /= unit);
        for (_, of_contact, of_reaction) in self.outputs.iter_mut().filter_map(sum) {
            of_contact.iter_mut().chain(of_reaction).for_each(|factor| *factor *= unit);
        }
        if let Ok(form) = &mut self.certificate {
            form.rescale(unit, self.inputs);
        }
    }
}

impl Form {
    /// Only what multiplies p changes: e and τ of the other columns are in the unit U already.
    pub(super) fn rescale(&mut self, unit: f64, inputs: usize) {
        let of_inputs = inputs * (inputs + 1) / 2;
        let of_s = self.factor.iter_mut().take(of_inputs);
        let of_jump = self.jump.iter_mut().flat_map(|jump| jump.iter_mut().take(of_inputs));
        let of_corners = self.corners.iter_mut().flat_map(|corner| &mut corner.excess);
        let lost = self.lost.iter_mut().take(inputs);
        let all = of_s.chain(of_jump).chain(of_corners).chain(&mut self.oscillation).chain(lost);
        all.for_each(|number| *number /= unit);
        self.span_excess /= unit;
    }
}

/// max |x|
fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}
