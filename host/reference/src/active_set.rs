//! The dense contact problem on the Schur complement, by a primal–dual active set.
//!
//! ```text
//! minimise ½ dᵀSd − rᵀd  over d ≥ ψ,   λ = Sd − r
//! ```
//!
//! A guess A of the contact set gives d_A = ψ_A, S_II d_I = r_I − S_IA ψ_A on the rest I, and λ_A.
//! Unknowns with d_i < ψ_i or λ_i < 0 change sides, all at once: a semismooth Newton step
//! (Hintermüller, Ito, Kunisch), finite and monotone if S is an M-matrix. For other S the block
//! pivoting of Júdice and Pires makes it finite: when the number of wrong unknowns has not fallen
//! for some steps, only the last of them changes (Murty) until it has.
//!
//! Where λ_i ≤ s_i is asked too, an unknown with λ_i > s_i goes to a third side, λ_i = s_i with d_i ≤ ψ_i, and comes back
//! where d_i > ψ_i: the problem with bounds on both sides of Júdice and Pires. For s_i < 0 it is s_i ≤ λ_i ≤ 0.
//!
//! A component that only contact holds has Σλ = −Σr > 0 whatever A is, so some active unknown of it
//! has λ_i > 0 and stays: if all leave, the load points away from the obstacle and there is no
//! minimum. The same holds where every λ ≤ 0.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{
    LltError, LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::cholesky::llt::solve::solve_in_place;
use faer::sparse::FaerError;
use faer::{Mat, MatMut, MatRef, Par, Spec};

use super::ReferenceError;
use super::condensation::multiply_add;

/// Steps after which the active set is said to cycle.
const MOST_STEPS: usize = 1000;
/// Block steps without progress before single changes begin.
const PATIENCE: usize = 10;
/// Rounding of one step, in multiples of the largest |d_i|.
const NOISE: f64 = 64.0 * f64::EPSILON;

/// S, the present guess of the contact set, and the factor of S_II that belongs to it.
pub(super) struct ActiveSet<'a> {
    schur: MatRef<'a, f64>,
    floating: &'a [Vec<usize>],
    free: usize,
    /// The most that λ may be; empty where all are ∞.
    spans: &'a [f64],
    /// Of the unknowns that are not active, those below ψ.
    pub below: Vec<bool>,
    pub active: Vec<bool>,
    pub steps: usize,
    inactive: Vec<usize>,
    factor: Option<Mat<f64>>,
}

impl<'a> ActiveSet<'a> {
    /// Starts from `active`; a floating component without contact starts with all of it.
    /// `free` is the number of unknowns before the first contact unknown.
    pub fn new(
        schur: MatRef<'a, f64>,
        floating: &'a [Vec<usize>],
        free: usize,
        spans: &'a [f64],
        mut active: Vec<bool>,
    ) -> Self {
        for component in floating {
            if !component.iter().any(|&i| active[i]) {
                component.iter().for_each(|&i| active[i] = true);
            }
        }
        let below = vec![false; active.len()];
        let (inactive, factor) = (Vec::new(), None);
        Self { schur, floating, free, spans, below, active, steps: 0, inactive, factor }
    }

    fn span(&self, i: usize) -> f64 {
        self.spans.get(i).copied().unwrap_or(f64::INFINITY)
    }

    /// The least and the largest λ.
    fn ends(&self, i: usize) -> [f64; 2] {
        let span = self.span(i);
        if span < 0.0 { [span, 0.0] } else { [0.0, span] }
    }

    /// λ of an unknown that is not active.
    pub fn excess(&self, i: usize) -> f64 {
        let [least, most] = self.ends(i);
        let end = if self.below[i] { most } else { least };
        if end.is_finite() { end } else { 0.0 }
    }

    /// The minimiser d. Violations below `noise` or the rounding of d are none.
    pub fn minimise(
        &mut self,
        load: &[f64],
        lower: &[f64],
        noise: f64,
    ) -> Result<Vec<f64>, ReferenceError> {
        let mut fewest = usize::MAX;
        let mut patience = PATIENCE;
        for _ in 0..MOST_STEPS {
            self.steps += 1;
            let d = self.equality_solve(load, lower)?;
            let mut wrong = self.violations(&d, load, lower, noise);
            if wrong.is_empty() {
                return Ok(d);
            }
            if wrong.len() < fewest {
                (fewest, patience) = (wrong.len(), PATIENCE);
            } else if patience > 0 {
                patience -= 1;
            } else {
                wrong.drain(..wrong.len() - 1);
            }
            self.change_sides(&wrong, &d, lower)?;
        }
        Err(ReferenceError::Cycling { steps: self.steps })
    }

    /// d with d_A = ψ_A and λ_I = 0.
    fn equality_solve(&mut self, load: &[f64], lower: &[f64]) -> Result<Vec<f64>, ReferenceError> {
        let mut d: Vec<f64> = self
            .active
            .iter()
            .zip(lower)
            .map(|(&active, &psi)| if active { psi } else { 0.0 })
            .collect();
        let mut held = vec![0.0; d.len()];
        multiply_add(self.schur, &d, &mut held);
        if self.factor.is_none() {
            self.factor = Some(self.factorise_inactive()?);
        }
        let mut rhs: Vec<f64> =
            self.inactive.iter().map(|&i| load[i] + self.excess(i) - held[i]).collect();
        if let Some(factor) = &self.factor {
            solve_dense(factor, &mut rhs);
        }
        self.inactive.iter().zip(&rhs).for_each(|(&i, &value)| d[i] = value);
        Ok(d)
    }

    /// The unknowns on the wrong side, in ascending order, and whether each belongs below ψ.
    fn violations(&self, d: &[f64], load: &[f64], lower: &[f64], noise: f64) -> Vec<(usize, bool)> {
        let mut multiplier: Vec<f64> = load.iter().map(|r| -r).collect();
        multiply_add(self.schur, d, &mut multiplier);
        let largest = d.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
        let noise = noise.max(NOISE * largest);
        let wrong = |i: usize| {
            let torn = self.torn(i, multiplier[i], noise);
            let is_wrong = match (self.active[i], self.below[i]) {
                (true, _) => torn.is_some(),
                (false, false) => d[i] < lower[i] - noise,
                (false, true) => d[i] > lower[i] + noise,
            };
            is_wrong.then_some((i, torn == Some(true)))
        };
        (0..d.len()).filter_map(wrong).collect()
    }

    /// Whether an active unknown with this λ goes below ψ, if it leaves.
    fn torn(&self, i: usize, multiplier: f64, noise: f64) -> Option<bool> {
        let noise = noise * self.schur[(i, i)].abs();
        let [least, most] = self.ends(i);
        if multiplier < least - noise {
            return Some(false);
        }
        (multiplier > most + noise).then_some(true)
    }

    /// Each of `wrong`, with whether it is to be below ψ if it leaves, goes to another side.
    fn change_sides(
        &mut self,
        wrong: &[(usize, bool)],
        d: &[f64],
        lower: &[f64],
    ) -> Result<(), ReferenceError> {
        for &(i, to_below) in wrong {
            self.active[i] = !self.active[i];
            self.below[i] = !self.active[i] && to_below;
        }
        self.factor = None;
        self.hold(wrong);
        self.stop(wrong, |i| d[i] - lower[i]);
        match self.floating.iter().find(|component| !component.iter().any(|&i| self.active[i])) {
            Some(component) => Err(ReferenceError::Unbounded { unknown: self.free + component[0] }),
            None => Ok(()),
        }
    }

    /// Where some λ ≥ 0 and others ≤ 0, a component that nothing active holds any more moves until one of those that it moves towards ψ
    /// is there.
    fn stop(&mut self, wrong: &[(usize, bool)], opening: impl Fn(usize) -> f64) {
        for component in self.floating {
            let left = wrong.iter().find(|(i, _)| component.contains(i));
            let (Some(&(_, falls)), false) = (left, component.iter().any(|&i| self.active[i]))
            else {
                continue;
            };
            let nears = |&&i: &&usize| self.below[i] != falls;
            let first = component.iter().filter(nears);
            let first = first.min_by(|&&a, &&b| opening(a).abs().total_cmp(&opening(b).abs()));
            if let Some(&i) = first {
                (self.active[i], self.below[i]) = (true, false);
            }
        }
    }

    /// Where λ has two ends loads may be in balance with no unknown active: one stays, to keep S_II regular.
    fn hold(&mut self, wrong: &[(usize, bool)]) {
        for component in self.floating {
            let has_limit = component.iter().any(|&i| self.span(i).is_finite());
            if has_limit && !component.iter().any(|&i| self.active[i]) {
                let left = wrong.iter().map(|&(i, _)| i).find(|i| component.contains(i));
                if let Some(i) = left {
                    (self.active[i], self.below[i]) = (true, false);
                }
            }
        }
    }

    /// The Cholesky factor of S_II.
    fn factorise_inactive(&mut self) -> Result<Mat<f64>, ReferenceError> {
        self.inactive = (0..self.active.len()).filter(|&i| !self.active[i]).collect();
        let (schur, inactive) = (self.schur, &self.inactive);
        let m = inactive.len();
        let mut factor = Mat::from_fn(m, m, |i, j| schur[(inactive[i], inactive[j])]);
        let scratch = cholesky_in_place_scratch::<f64>(m, Par::Seq, Spec::default());
        let mut memory = MemBuffer::try_new(scratch).map_err(|_| FaerError::OutOfMemory)?;
        let outcome = cholesky_in_place(
            factor.as_mut(),
            LltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut memory),
            Spec::default(),
        );
        match outcome {
            Ok(_) => Ok(factor),
            Err(LltError::NonPositivePivot { index }) => {
                Err(ReferenceError::NotPositiveDefinite { unknown: self.free + inactive[index] })
            }
        }
    }
}

/// (L Lᵀ)⁻¹ applied to `rhs`.
fn solve_dense(factor: &Mat<f64>, rhs: &mut [f64]) {
    let m = rhs.len();
    let rhs = MatMut::from_column_major_slice_mut(rhs, m, 1);
    solve_in_place(factor.as_ref(), rhs, Par::Seq, MemStack::new(&mut []));
}
