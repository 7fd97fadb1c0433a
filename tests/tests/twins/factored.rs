//! The kernel's exact solver with memory of its own, in any order of elimination.

use signorini_kernel::boundary::Boundary;
use signorini_kernel::condensed::Iterate;
use signorini_kernel::condensed::blocks::{SIDE, count, padded};
use signorini_kernel::signorini::System;
use signorini_kernel::solver::{Settings, Status};
use signorini_kernel::sparse::elimination::PatternBuffers;
use signorini_kernel::sparse::factor::FactorBuffers;
use signorini_kernel::sparse::{Direct, Factor, Memory, Pattern, Progress};
use signorini_kernel::{Error, Index, Real};
use signorini_tests::random::Random;

/// Solves with the free unknowns eliminated as `order` says; `None` where the kernel finds no answer.
pub fn solve<R: Real, I: Index>(
    system: &System<R, I>,
    boundary: &Boundary<R, I>,
    settings: &Settings<R>,
    order: &[I],
    u: &mut [R],
    low: &mut [R],
) -> Result<Option<Progress<R>>, Error> {
    let counts = system.counts();
    let [mut place, mut parent, mut scratch] = [(); 3].map(|()| vec![I::FIRST; counts.free]);
    let mut pointers = vec![0; counts.free + 1];
    let (place, parent) = (&mut place, &mut parent);
    let buffers = PatternBuffers { place, parent, visited: &mut scratch, pointers: &mut pointers };
    let pattern = Pattern::new(system.matrix(), counts, order, buffers)?;
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
    let Some(factor) = Factor::new(system.matrix(), pattern, buffers, &mut schur)? else {
        return Ok(None);
    };
    let length = padded(counts.contact);
    let mut numbers = [(); 7].map(|()| vec![R::ZERO; length]);
    let [column, next, scale, load, x, residual, scratch] = &mut numbers;
    let mut flags = [(); 3].map(|()| vec![false; length]);
    let [exchanged, none, open] = &mut flags;
    let memory = Memory {
        schur: &mut schur,
        tableau: &mut tableau,
        exchanged,
        none,
        columns: [column, next],
        scale,
        load,
        iterate: Iterate { x, residual, scratch, open },
        places: &mut vec![R::ZERO; counts.unknowns()],
    };
    let Some(mut direct) = Direct::new(factor, memory)? else { return Ok(None) };
    let Some(found) = direct.solve(system, boundary, settings, u, low)? else { return Ok(None) };
    // Again from its own answer: no edge changes sides.
    let mut again = u.to_vec();
    let warm = direct.solve(system, boundary, settings, &mut again, &mut vec![R::ZERO; u.len()])?;
    assert_eq!(warm.map(|warm| warm.pivots), Some(0));
    Ok(Some(found))
}

/// All numbers below n once, in random order.
pub fn order<I: Index>(random: &mut Random, n: usize) -> Vec<I> {
    let mut order: Vec<I> = (0..n).filter_map(I::new).collect();
    for last in (1..n).rev() {
        order.swap(last, random.below(last as u32 + 1) as usize);
    }
    order
}

/// Whether the answer is one.
pub fn ended_well<R>(found: &Option<Progress<R>>) -> bool {
    found
        .as_ref()
        .is_some_and(|found| matches!(found.status, Status::Converged | Status::RoundingLimit))
}
