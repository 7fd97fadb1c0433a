//! The kernel's exact solver in memory of the right size: where projected SOR does not get there.

use signorini_device::sparse::Factor;
use signorini_kernel::Error as KernelError;
use signorini_kernel::solver::Outcome;

use super::by_factor::{Scaled, SolveSummary};
use super::ldlt::Ldlt;
use super::{Attempt, Factored};
use signorini_problem::progress::stage;
use signorini_problem::scalar::Scalar;

impl<R: Scalar> Attempt<'_, R> {
    /// Solves by the kernel's factor, by `known` where its matrix is the same; `u` is start and answer, `low` becomes its low part.
    /// Nothing where the matrix is singular in this scalar, has no solution, or would take too much memory: `u` is what it was.
    ///
    /// # Errors
    /// Slices of the wrong length.
    pub fn by_factor(
        &self,
        u: &mut [R],
        low: &mut [R],
        known: Option<&Ldlt<R>>,
    ) -> Result<Option<(Outcome<R>, Factored)>, KernelError> {
        let (system, diagonal) = (self.assembled.system()?, self.assembled.diagonal()?);
        let settings = self.task.options.settings();
        let new = match known {
            Some(_) => None,
            None => {
                stage("a sparse factor");
                Ldlt::new(&system)?
            }
        };
        let Some(ldlt) = known.or(new.as_ref()) else { return Ok(None) };
        let (counts, entries) = (ldlt.counts, ldlt.values.len());
        let Some(mut scaled) = Scaled::new(ldlt.schur.clone(), counts.contact) else {
            return Ok(None);
        };
        let factor: Factor<R, u32> = ldlt.factor();
        let mut by_factor = scaled.by(factor)?;
        stage(&format!(
            "exchanges on {} contact edges, {entries} entries of a factor",
            counts.contact
        ));
        let before = u.to_vec();
        let Some(progress) = by_factor.solve(&system, diagonal, &settings, u, low)? else {
            u.copy_from_slice(&before);
            low.fill(R::ZERO);
            return Ok(None);
        };
        let SolveSummary { status, residual, pivots: exchanges, rounds } = progress;
        let outcome = Outcome { status, sweeps: 0, conjugate: 0, residual, omega: R::ONE };
        Ok(Some((outcome, Factored { entries, exchanges, rounds })))
    }
}
