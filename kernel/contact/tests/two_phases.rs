//! Exchanges in two phases on matrices without a positive entry off the diagonal: an end from every state.

use crate::memory::{Dense, Draw};
use signorini_contact::dense::blocks::{Block, Blocks, SIDE, count, padded};
use signorini_contact::dense::ranges::Given;
use signorini_contact::dense::rule::{Largest, Phases, Rule as _};
use signorini_contact::method::{Method as _, TwoPhases};
use signorini_kernel::Error;
use signorini_kernel::limits::Deadline;
use signorini_kernel::report::Ended;
use signorini_tolerances::kernel::CONDENSED;

/// Rows of a symmetric matrix with a diagonal of 1 and row sums above 0: neighbours pull most.
fn matrix(n: usize, draw: &mut Draw) -> Vec<Block<f64>> {
    let mut blocks = vec![[[0.0; SIDE]; SIDE]; count(n)];
    let mut set = |i: usize, j: usize, value: f64| {
        let (row, column) = (i / SIDE, j / SIDE);
        blocks[row * (row + 1) / 2 + column][i % SIDE][j % SIDE] = value;
        if row == column {
            blocks[row * (row + 1) / 2 + column][j % SIDE][i % SIDE] = value;
        }
    };
    for i in 0..n {
        set(i, i, 1.0);
        for j in 0..i {
            let far = (i - j) as f64;
            set(i, j, -0.29 * draw.part() / (far * far));
        }
    }
    blocks
}

/// The exchanges of a solve from the edges `open`, after its answer was checked.
fn exchanges(n: usize, blocks: &[Block<f64>], load: &[f64], open: &[bool]) -> Result<u32, Error> {
    let matrix = Blocks::new(blocks, n)?;
    let mut memory = Dense::of(&matrix, n)?;
    let (mut tableau, iterate) = memory.parts()?;
    for at in (0..n).filter(|&at| open[at]) {
        assert!(tableau.exchange(at, iterate.scratch)?);
    }
    let given = Given::above(load);
    let found = TwoPhases { tableau }.solve(&matrix, given, iterate, &mut Deadline::never())?;
    let Dense { x, residual, .. } = &memory;
    assert_eq!((found.ended, found.sweeps), (Ended::Exact, 0));
    let size = x.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
    for (x, r) in x.iter().zip(residual) {
        CONDENSED.check("complementarity", x.min(*r) / size);
    }
    Ok(found.pivots)
}

#[test]
fn every_state_leads_to_the_solution_within_the_bound() -> Result<(), Error> {
    let mut draw = Draw(7);
    let mut most = 0.0_f64;
    for case in 0..40 {
        let n = 1 + case % 12;
        let blocks = matrix(n, &mut draw);
        let mut load = vec![0.0; padded(n)];
        load[..n].fill_with(|| draw.part() - 0.4);
        // All states of small matrices, some of larger ones.
        for state in 0..(1_usize << n).min(64) {
            let open: Vec<bool> = (0..n)
                .map(|at| if n <= 6 { state >> at & 1 == 1 } else { draw.part() < 0.5 })
                .collect();
            let taken = exchanges(n, &blocks, &load, &open)? as usize;
            // Half of the open edges leave at most before it starts anew, or one.
            let open = open.iter().filter(|open| **open).count();
            let limit = if n == 1 { 1 } else { n + (open / 2).max(open.min(1)) };
            assert!(
                taken <= limit && limit <= Phases::default().most(n, false),
                "{taken} of {limit}"
            );
            most = most.max(taken as f64 / n as f64);
        }
    }
    assert!(most >= 1.0, "the states are easy: {most} exchanges per edge at most");
    Ok(())
}

/// Every edge pulls at every other, and the ground hardly holds them: openings of b/κ.
#[test]
fn openings_may_be_much_larger_than_loads() -> Result<(), Error> {
    let mut draw = Draw(5);
    for n in [2, 7, 12, 30] {
        for held in [1e-2, 1e-4, 1e-6, 1e-9] {
            let mut blocks = vec![[[0.0; SIDE]; SIDE]; count(n)];
            let pull = -(1.0 - held) / (n as f64 - 1.0);
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let (row, column) = (i / SIDE, j / SIDE);
                if column <= row {
                    let entry = if i == j { 1.0 } else { pull };
                    blocks[row * (row + 1) / 2 + column][i % SIDE][j % SIDE] = entry;
                }
            }
            let mut load = vec![0.0; padded(n)];
            load[..n].fill_with(|| 0.8 + 0.2 * draw.part());
            let taken = exchanges(n, &blocks, &load, &vec![false; n])?;
            assert_eq!(taken as usize, n, "{held:e}");
            let taken = exchanges(n, &blocks, &load, &vec![true; n])?;
            assert_eq!(taken, 0, "{held:e}");
        }
    }
    Ok(())
}

#[test]
fn the_bound_is_that_of_the_order() {
    assert_eq!([0, 1, 7].map(|n| Phases::default().most(n, false)), [0, 1, 10]);
    assert_eq!([0, 1, 8, 9].map(|n| Largest.most(n, false)), [0, 8, 8, 16]);
}

/// Without time no edge changes: the answer of the state is clipped, and the next tick goes on from it.
#[test]
fn a_deadline_ends_a_tick_between_exchanges() -> Result<(), Error> {
    let blocks = matrix(6, &mut Draw(3));
    let load = [0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.0, 0.0];
    let matrix = Blocks::new(&blocks, 6)?;
    let mut memory = Dense::of(&matrix, 6)?;
    let mut ended = Vec::new();
    for _ in 0..8 {
        // One exchange a tick: the second asks a clock that has run out.
        let mut left = 1;
        let remaining = || {
            let now = left;
            left = 0;
            now
        };
        let mut deadline = Deadline { remaining, sweep: 1, certificate: 0 };
        let (tableau, iterate) = memory.parts()?;
        let given = Given::above(&load);
        let found = TwoPhases { tableau }.solve(&matrix, given, iterate, &mut deadline)?;
        assert!(found.pivots <= 1 && memory.x.iter().all(|x| *x >= 0.0), "{found:?}");
        ended.push(found.ended);
    }
    assert_eq!((ended[0], ended[7]), (Ended::OutOfTime, Ended::Exact));
    Ok(())
}

/// Of no matrix that is positive definite: an exchange has no pivot.
#[test]
fn a_matrix_that_is_none_ends_with_zeros() -> Result<(), Error> {
    let mut block = [[0.0; SIDE]; SIDE];
    block[0][..2].copy_from_slice(&[1.0, -2.0]);
    block[1][..2].copy_from_slice(&[-2.0, 1.0]);
    let load = [1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let blocks = [block];
    let matrix = Blocks::new(&blocks, 2)?;
    let mut memory = Dense::of(&matrix, 2)?;
    let (tableau, iterate) = memory.parts()?;
    let given = Given::above(&load);
    let found = TwoPhases { tableau }.solve(&matrix, given, iterate, &mut Deadline::never())?;
    assert_eq!((found.ended, &memory.x[..]), (Ended::OutOfSweeps, &[0.0; SIDE][..]));
    assert_eq!(memory.open, [false; SIDE]);
    assert_eq!(memory.residual, load.map(|load: f64| -load));
    Ok(())
}
