//! The kernel's exact solver with memory of its own, in any order of elimination.

use signorini_contact::dense::Iterate;
use signorini_contact::dense::blocks::{SIDE, count, padded};
use signorini_device::sparse::elimination::PatternBuffers;
use signorini_device::sparse::factor::FactorBuffers;
use signorini_device::sparse::{Direct, DirectMemory, Factor, Memory, Pattern, SolveSummary};
use signorini_kernel::csr::Csr;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::solver::Settings;
use signorini_kernel::system::System;
use signorini_kernel::{Error, Index, Real};

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
    let [mut place, mut parent, mut scratch] = [(); 3].map(|()| vec![I::FIRST; counts.free]);
    let mut pointers = vec![0; counts.free + 1];
    let (place, parent) = (&mut place, &mut parent);
    let buffers = PatternBuffers { place, parent, visited: &mut scratch, pointers: &mut pointers };
    let pattern = Pattern::new(matrix, counts, order, buffers)?;
    let blocks = vec![[[R::ZERO; SIDE]; SIDE]; count(counts.contact)];
    let (mut schur, mut tableau) = (blocks.clone(), blocks);
    let buffers = FactorBuffers {
        rows: &mut vec![I::FIRST; pattern.entries()],
        values: &mut vec![R::ZERO; pattern.entries()],
        inverse: &mut vec![R::ZERO; counts.free],
        ends: &mut vec![0; counts.free],
        path: &mut vec![I::FIRST; counts.free],
        visited: &mut vec![I::FIRST; counts.free],
        row: &mut vec![R::ZERO; counts.unknowns()],
    };
    let Some(factor) = Factor::new(matrix, pattern, buffers, &mut schur)? else {
        return Ok(None);
    };
    let length = padded(counts.contact);
    let mut numbers = [(); 7].map(|()| vec![R::ZERO; length]);
    let [column, next, scale, load, x, residual, scratch] = &mut numbers;
    let mut flags = [(); 3].map(|()| vec![false; length]);
    let [exchanged, none, open] = &mut flags;
    let contact = Memory {
        tableau: &mut tableau,
        exchanged,
        columns: [column, next],
        load,
        iterate: Iterate { x, residual, scratch, open },
    };
    let places = &mut vec![R::ZERO; counts.unknowns()];
    let memory = DirectMemory { schur: &mut schur, scale, none, contact, places };
    let Some(mut direct) = Direct::new(factor, memory)? else { return Ok(None) };
    let Some(found) = direct.solve(system, diagonal, settings, u, low)? else { return Ok(None) };
    // Again from its own answer: edges that changed sides stay where they are, but for rounding.
    let mut again = u.to_vec();
    let warm = direct.solve(system, diagonal, settings, &mut again, &mut vec![R::ZERO; u.len()])?;
    Ok(warm.map(|warm| [found, warm]))
}
