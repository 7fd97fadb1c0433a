//! What cells remember of the changes of inputs and openings, state by state.

/// States that follow y = ω∘y⁻ − C_x (x − x⁻) − C_p (p − p⁻) and load contact by C_xᵀ y⁻.
#[derive(Debug, Clone, PartialEq)]
pub struct Memory {
    /// ω, the largest first.
    pub fading: Vec<f64>,
    /// C_x, a row for each state.
    pub of_contact: Vec<Vec<f64>>,
    /// C_p, a row for each state.
    pub of_inputs: Vec<Vec<f64>>,
    /// y at the start; zeros where that is a steady state.
    pub begin: Vec<f64>,
}

impl Memory {
    /// States of these ω in any order, with their rows of C_x and C_p and what they begin with.
    pub(super) fn new(
        fading: &[f64],
        [of_contact, of_inputs]: [&[Vec<f64>]; 2],
        begin: &[f64],
    ) -> Self {
        let order = by_fading(fading);
        let rows = |of: &[Vec<f64>]| order.iter().map(|&at| of[at].clone()).collect();
        let numbers = |of: &[f64]| order.iter().map(|&at| of[at]).collect();
        Self {
            fading: numbers(fading),
            of_contact: rows(of_contact),
            of_inputs: rows(of_inputs),
            begin: numbers(begin),
        }
    }

    /// The size that rounding of each state may add up to, over the part of its terms that it is in a step, where openings and inputs
    /// change by so much at most.
    pub(crate) fn drift(&self, [of_contact, of_inputs]: [&[f64]; 2]) -> Vec<f64> {
        let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a.abs() * b).sum::<f64>();
        let rows = self.of_contact.iter().zip(&self.of_inputs).zip(&self.begin).zip(&self.fading);
        let states = rows.map(|(((x, p), begin), omega)| {
            let size = begin.abs() + sum(x, of_contact) + sum(p, of_inputs);
            size + 2.0 * size / (1.0 - omega)
        });
        states.collect()
    }
}

/// The numbers of states, the slowest first.
pub(super) fn by_fading(fading: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..fading.len()).collect();
    order.sort_by(|&a, &b| fading[b].total_cmp(&fading[a]));
    order
}
