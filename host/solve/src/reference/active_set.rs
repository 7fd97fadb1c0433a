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
//! A component that only contact holds has Σλ = −Σr > 0 whatever A is, so some active unknown of it
//! has λ_i > 0 and stays: if all leave, the load points away from the obstacle and there is no
//! minimum.

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
        mut active: Vec<bool>,
    ) -> Self {
        for component in floating {
            if !component.iter().any(|&i| active[i]) {
                component.iter().for_each(|&i| active[i] = true);
            }
        }
        Self { schur, floating, free, active, steps: 0, inactive: Vec::new(), factor: None }
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
            self.change_sides(&wrong)?;
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
        let mut rhs: Vec<f64> = self.inactive.iter().map(|&i| load[i] - held[i]).collect();
        if let Some(factor) = &self.factor {
            solve_dense(factor, &mut rhs);
        }
        self.inactive.iter().zip(&rhs).for_each(|(&i, &value)| d[i] = value);
        Ok(d)
    }

    /// The unknowns on the wrong side, in ascending order.
    fn violations(&self, d: &[f64], load: &[f64], lower: &[f64], noise: f64) -> Vec<usize> {
        let mut multiplier: Vec<f64> = load.iter().map(|r| -r).collect();
        multiply_add(self.schur, d, &mut multiplier);
        let largest = d.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
        let noise = noise.max(NOISE * largest);
        (0..d.len())
            .filter(|&i| match self.active[i] {
                true => multiplier[i] < -noise * self.schur[(i, i)].abs(),
                false => d[i] < lower[i] - noise,
            })
            .collect()
    }

    fn change_sides(&mut self, wrong: &[usize]) -> Result<(), ReferenceError> {
        wrong.iter().for_each(|&i| self.active[i] = !self.active[i]);
        self.factor = None;
        match self.floating.iter().find(|component| !component.iter().any(|&i| self.active[i])) {
            Some(component) => Err(ReferenceError::Unbounded { unknown: self.free + component[0] }),
            None => Ok(()),
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
