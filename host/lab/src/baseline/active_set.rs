//! The host's own solver: a sparse Cholesky factorisation by faer, and an active set on its Schur complement.
//!
//! It knows no tolerance and refines to the last digits. Cold, it factors; warm, the factor stands and the
//! contact set of the tick before is the first guess.

use super::failed;
use super::quadratic::Quadratic;
use super::series::{InitialGuess, Run, TimedSolver};
use crate::cycles::counted;
use signorini_reference::Factor;
use signorini_scene::Result;

pub(super) struct ActiveSet<'q> {
    quadratic: &'q Quadratic,
    factor: Option<Factor>,
    keeps: bool,
    active: Vec<bool>,
}

impl<'q> ActiveSet<'q> {
    /// A cold start factors the matrix, or, where the factor is kept, finds that and knows nothing of the contact set.
    pub fn new(quadratic: &'q Quadratic, keeps: bool) -> Result<Self> {
        let factor = keeps.then(|| Factor::new(&quadratic.reference(0)));
        let factor = factor.transpose().map_err(failed)?;
        Ok(Self { quadratic, factor, keeps, active: Vec::new() })
    }
}

impl TimedSolver for ActiveSet<'_> {
    fn run(&mut self, tick: usize, start: InitialGuess, _: f64) -> Result<Run> {
        let (quadratic, data) = (self.quadratic, &self.quadratic.ticks[tick]);
        if start == InitialGuess::Cold && !self.keeps {
            self.factor = None;
        }
        let guess = (start == InitialGuess::Warm).then_some(self.active.as_slice());
        let kept = self.factor.take();
        let (cycles, result) = counted(|| {
            let factor = match kept {
                Some(factor) => factor,
                None => Factor::new(&quadratic.reference(tick))?,
            };
            let solution = factor.solve_between(&data.load, &data.lower, &data.spans, guess)?;
            Ok::<_, signorini_reference::ReferenceError>((factor, solution))
        });
        let (factor, solution) = result.map_err(failed)?;
        self.factor = Some(factor);
        self.active = solution.active;
        Ok(Run { cycles, iterations: solution.steps as u32, u: solution.u })
    }

    fn finest(&self) -> i32 {
        -1
    }
}
