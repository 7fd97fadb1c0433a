//! The exact solver in any order of elimination, and by the factor of another matrix.

use crate::ldlt::Ldlt;
use signorini_kernel::csr::Csr;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::solver::Settings;
use signorini_kernel::system::System;
use signorini_kernel::{Error, Index, Real};
use signorini_solve::by_factor::{Scaled, SolveSummary};

/// Solves by the factor of `matrix`, its free unknowns eliminated as `order` says, twice; `None` where the kernel finds
/// no answer.
pub fn solve<R: Real, I: Index>(
    matrix: &Csr<R, I>,
    system: &System<R, I>,
    diagonal: DiagonalTerms<R, I>,
    settings: &Settings<R>,
    order: &[I],
    u: &mut [R],
    low: &mut [R],
) -> Result<Option<[SolveSummary<R>; 2]>, Error> {
    let counts = system.counts();
    let Some(ldlt) = Ldlt::new(matrix, counts, order)? else { return Ok(None) };
    let Some(mut scaled) = Scaled::new(ldlt.schur.clone(), counts.contact) else {
        return Ok(None);
    };
    let mut solver = scaled.by(ldlt.factor())?;
    let Some(found) = solver.solve(system, diagonal, settings, u, low)? else { return Ok(None) };
    // Again from its own answer: edges that changed sides stay where they are, but for rounding.
    let mut again = u.to_vec();
    let warm = solver.solve(system, diagonal, settings, &mut again, &mut vec![R::ZERO; u.len()])?;
    Ok(warm.map(|warm| [found, warm]))
}
