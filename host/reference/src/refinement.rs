//! Iterative refinement of the whole contact problem.
//!
//! With a first u, the correction d = u* − u solves a contact problem of the same matrix:
//!
//! ```text
//! minimise ½ dᵀKd − rᵀd  over d_C ≥ ψ − u_C,   r = b − Ku.
//! ```
//!
//! The residual is summed in twice the working precision and the same factor serves, so each pass
//! shortens the error by about cond(K) × 2⁻⁵³ until u is right to rounding, and decides the contact
//! of doubtful unknowns by residuals of their own size. The first pass, u = 0, is the problem itself.

use super::active_set::ActiveSet;
use super::problem::{Matrix, check_finite};
use super::{Factor, ReferenceError};

/// Passes at most: each shortens the correction or is the last, unless the contact set changes.
const MOST_PASSES: usize = 30;
/// A pass shortens the correction to this share of the last one, or it has stalled.
const CONTRACTION: f64 = 0.1;
/// A correction that falls no further must be this small, relative to u.
const ACCEPTED: f64 = 1e-12;

/// The minimiser and how it was reached.
#[derive(Debug, Clone)]
pub struct Solution {
    /// u, free unknowns first.
    pub u: Vec<f64>,
    /// For each contact unknown: u_i = ψ_i is imposed.
    pub active: Vec<bool>,
    /// λ = Ku − b on the active unknowns, 0 or the most it may be on the other contact unknowns; length n_c.
    pub multiplier: Vec<f64>,
    /// Active sets tried.
    pub steps: usize,
    /// Passes of refinement, two solves with the sparse factor each.
    pub passes: usize,
}

impl Factor {
    /// Minimises for the load b, the obstacle ψ = `lower` and the most that λ may be, `spans` as in [`super::Problem`],
    /// starting from the contact set `guess` (default: all in contact).
    pub fn solve_between(
        &self,
        load: &[f64],
        lower: &[f64],
        spans: &[f64],
        guess: Option<&[bool]>,
    ) -> Result<Solution, ReferenceError> {
        let matrix = &self.matrix;
        let (n, contact) = (matrix.unknowns(), matrix.contact());
        if load.len() != n
            || lower.len() != contact
            || guess.is_some_and(|g| g.len() != contact)
            || !(spans.is_empty() || spans.len() == contact)
        {
            return Err(ReferenceError::Malformed("load, lower or guess do not match the factor"));
        }
        check_finite("load", load)?;
        check_finite("lower", lower)?;

        let guess = guess.map_or_else(|| vec![true; contact], <[bool]>::to_vec);
        let mut set = ActiveSet::new(self.schur(), &self.floating, matrix.free, spans, guess);
        let mut u = vec![0.0; n];
        let (residual, passes) = self.refine(&mut u, load, lower, &mut set)?;
        let multiplier = residual[matrix.free..].iter().enumerate();
        let multiplier = multiplier.map(|(i, r)| if set.active[i] { -r } else { set.excess(i) });
        let multiplier = multiplier.collect();
        Ok(Solution { u, multiplier, steps: set.steps, active: set.active, passes })
    }

    /// Repeats the pass until d is the rounding of u; returns b − Ku and the number of passes.
    fn refine(
        &self,
        u: &mut [f64],
        load: &[f64],
        lower: &[f64],
        set: &mut ActiveSet,
    ) -> Result<(Vec<f64>, usize), ReferenceError> {
        let mut residual = load.to_vec();
        let mut last = f64::INFINITY;
        for pass in 1..=MOST_PASSES {
            let before = set.active.clone();
            let change = self.correct(u, &residual, lower, set)?;
            check_finite("solution", u)?;
            residual = self.matrix.residual(load, u);
            let size = largest(u).max(f64::MIN_POSITIVE);
            let stalled = change > CONTRACTION * last && before == set.active;
            if change <= f64::EPSILON * size || (stalled && change <= ACCEPTED * size) {
                return Ok((residual, pass));
            }
            if stalled {
                return Err(ReferenceError::Singular { correction: change / size });
            }
            last = change;
        }
        Err(ReferenceError::Cycling { steps: set.steps })
    }

    /// One pass: adds the correction d to u and returns max |d_i|.
    fn correct(
        &self,
        u: &mut [f64],
        residual: &[f64],
        lower: &[f64],
        set: &mut ActiveSet,
    ) -> Result<f64, ReferenceError> {
        let free = self.matrix.free;
        let condensed = self.condensation.condense(residual)?;
        let distance: Vec<f64> = lower.iter().zip(&u[free..]).map(|(psi, u)| psi - u).collect();
        let noise = f64::EPSILON * largest(&condensed.response[free..]);
        let contact = set.minimise(&condensed.load, &distance, noise)?;
        let d = self.condensation.extend(condensed, &contact)?;
        u.iter_mut().zip(&d).for_each(|(u, d)| *u += d);
        for (i, _) in set.active.iter().enumerate().filter(|&(_, &active)| active) {
            u[free + i] = lower[i];
        }
        Ok(largest(&d))
    }
}

impl Matrix {
    /// b − Ku, each entry summed in twice the working precision (Ogita, Rump, Oishi).
    pub(super) fn residual(&self, load: &[f64], u: &[f64]) -> Vec<f64> {
        let row_sum = |(row, &b): (usize, &f64)| {
            let (mut sum, mut error) = (b, 0.0);
            for entry in self.row(row) {
                let (a, u) = (-self.values[entry], u[self.col_idx[entry] as usize]);
                let product = a * u;
                let next = sum + product;
                let taken = next - sum;
                error += (sum - (next - taken)) + (product - taken) + a.mul_add(u, -product);
                sum = next;
            }
            sum + error
        };
        load.iter().enumerate().map(row_sum).collect()
    }
}

/// max |x_i|.
fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |largest, entry| largest.max(entry.abs()))
}
