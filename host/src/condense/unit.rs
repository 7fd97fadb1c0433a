//! The energy unit U: a power of two, so that scaling rounds nothing.

use super::{Condensate, Form, Measure};

impl Condensate {
    /// Chooses U so that x and r̂ at the default inputs, or without contact the bound, are of order 1.
    pub(super) fn choose_unit(&mut self) {
        let size = self.size(&self.defaults);
        let exponent = size.log2().round();
        if exponent.is_finite() {
            self.rescale(exponent.exp2());
        }
    }

    fn size(&self, p: &[f64]) -> f64 {
        let largest = |numbers: &[f64]| numbers.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        match self.solve(p) {
            Ok(x) if self.contact > 0 => largest(&x).max(largest(&self.residual(p, &x))),
            Ok(x) => self.bound(p, &x).unwrap_or(1.0),
            Err(_) => 1.0,
        }
    }

    /// Goes from U = 1 to `unit`.
    fn rescale(&mut self, unit: f64) {
        self.energy_unit = unit;
        self.opening.iter_mut().chain(&mut self.multiplier).for_each(|number| *number *= unit);
        self.load.iter_mut().flatten().for_each(|number| *number /= unit);
        for measure in &mut self.outputs {
            if let Measure::Linear { of_contact, .. } = measure {
                of_contact.iter_mut().for_each(|factor| *factor *= unit);
            }
        }
        if let Ok(form) = &mut self.certificate {
            form.rescale(unit, self.inputs);
        }
    }
}

impl Form {
    /// Only what multiplies p changes: e and τ of the other columns are in the unit U already.
    fn rescale(&mut self, unit: f64, inputs: usize) {
        let of_inputs = self.factor.iter_mut().take(inputs * (inputs + 1) / 2);
        let of_corners = self.corners.iter_mut().flat_map(|corner| &mut corner.excess);
        let all = of_inputs.chain(of_corners).chain(&mut self.oscillation);
        all.for_each(|number| *number /= unit);
    }
}
