//! The kernel's exact solver in memory of the right size: where projected SOR does not get there.

use serde::Serialize;
use signorini_device::sparse::Factor;
use signorini_kernel::Error as KernelError;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::solver::{Outcome, Settings};
use signorini_kernel::system::System;

use super::by_factor::{Scaled, SolveSummary};
use super::ldlt::Ldlt;
use signorini_problem::progress::stage;
use signorini_problem::scalar::Scalar;

/// Work of the factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Factored {
    /// Entries of L.
    pub entries: usize,
    /// Contact edges that changed sides; of the direct solver, active-set steps.
    pub exchanges: u32,
    /// Substitutions, corrections among them; of the direct solver, passes of refinement.
    pub rounds: u32,
}

/// Solves `system` by the kernel's factor, by `known` where its matrix is the same; `u` is start and answer, `low` becomes its low part. Nothing where
/// the matrix is singular in this scalar, has no solution, or would take too much memory: `u` is what it was.
///
/// # Errors
/// Slices of the wrong length.
pub(super) fn solve<R: Scalar>(
    system: &System<R, u32>,
    diagonal: DiagonalTerms<R, u32>,
    settings: &Settings<R>,
    u: &mut [R],
    low: &mut [R],
    known: Option<&Ldlt<R>>,
) -> Result<Option<(Outcome<R>, Factored)>, KernelError> {
    let new = match known {
        Some(_) => None,
        None => {
            stage("a sparse factor");
            Ldlt::new(system)?
        }
    };
    let Some(ldlt) = known.or(new.as_ref()) else { return Ok(None) };
    let (counts, entries) = (ldlt.counts, ldlt.values.len());
    let Some(mut scaled) = Scaled::new(ldlt.schur.clone(), counts.contact) else {
        return Ok(None);
    };
    let factor: Factor<R, u32> = ldlt.factor();
    let mut by_factor = scaled.by(factor)?;
    stage(&format!("exchanges on {} contact edges, {entries} entries of a factor", counts.contact));
    let before = u.to_vec();
    let Some(progress) = by_factor.solve(system, diagonal, settings, u, low)? else {
        u.copy_from_slice(&before);
        low.fill(R::ZERO);
        return Ok(None);
    };
    let SolveSummary { status, residual, pivots: exchanges, rounds } = progress;
    let outcome = Outcome { status, sweeps: 0, conjugate: 0, residual, omega: R::ONE };
    Ok(Some((outcome, Factored { entries, exchanges, rounds })))
}
