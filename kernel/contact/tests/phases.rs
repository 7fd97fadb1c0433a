//! Exchanges in phases on matrices without a positive entry off the diagonal: an end from every state, in two phases and, where
//! fluxes have limits, in three; and sweeps to the same answer.

use crate::memory::{Dense, Draw, defect};
use crate::strip::in_blocks;
use signorini_contact::dense::blocks::{Block, Blocks, SIDE, padded};
use signorini_contact::dense::ranges::Given;
use signorini_contact::dense::rule::{Largest, Phases, Rule as _};
use signorini_contact::method::{Method, SolveSummary, Sweeps, TwoPhases};
use signorini_kernel::Error;
use signorini_kernel::flux_range::Spans;
use signorini_kernel::limits::Deadline;
use signorini_kernel::report::Ended;
use signorini_tolerances::kernel::{CONDENSED, THREE_PHASES_SWEPT};

/// A matrix, a load and spans; no spans where fluxes have no limit.
struct Plant {
    order: usize,
    rows: Vec<Vec<f64>>,
    blocks: Vec<Block<f64>>,
    load: Vec<f64>,
    spans: Vec<f64>,
}

impl Plant {
    /// Of these entries, with what `load` draws, and without limits.
    fn of(rows: Vec<Vec<f64>>, load: impl FnMut() -> f64) -> Self {
        let (order, blocks) = (rows.len(), in_blocks(rows.len(), |i, j| rows[i][j]));
        let mut all = vec![0.0; padded(order)];
        all[..order].fill_with(load);
        Self { order, rows, blocks, load: all, spans: Vec::new() }
    }

    /// Neighbours pull most, and some not at all; spans of either sign, infinite, 0, tiny and as large as loads.
    fn new(order: usize, draw: &mut Draw, has_limits: bool) -> Self {
        let mut rows = vec![vec![0.0; order]; order];
        for (i, j) in (0..order).flat_map(|i| (0..=i).map(move |j| (i, j))) {
            let far = (i - j) as f64;
            let pull = if draw.part() < 0.3 { 0.0 } else { -0.29 * draw.part() };
            let entry = if i == j { 1.0 } else { pull / (far * far) };
            (rows[i][j], rows[j][i]) = (entry, entry);
        }
        let mut plant = Self::of(rows, || 1.6 * draw.part() - 0.8);
        let (kinds, sizes) = ([0.0, 1e-9, 0.2, 0.6, f64::INFINITY], [1.0, 1.0, -1.0]);
        let mut span = || kinds[(draw.part() * 5.0) as usize] * sizes[(draw.part() * 3.0) as usize];
        if has_limits {
            plant.spans = (0..order).map(|_| span()).collect();
        }
        plant
    }

    fn ends(&self, at: usize) -> [f64; 2] {
        let span = self.spans.get(at).copied().unwrap_or(f64::INFINITY);
        if span < 0.0 { [span, 0.0] } else { [0.0, span] }
    }

    /// x, and what it took; it begins with these sides, above, on and below the gap.
    fn solved(&self, sides: &[i8], sweeps: Option<u32>) -> Result<(Vec<f64>, SolveSummary), Error> {
        let matrix = Blocks::new(&self.blocks, self.order)?;
        let mut memory = Dense::of(&matrix, self.order)?;
        let given = Given::between(&self.load, Spans::new(&self.spans)?, &[]);
        let (mut tableau, iterate) = memory.parts()?;
        for at in (0..self.order).filter(|&at| sides[at] != 0) {
            assert!(tableau.exchange(at, iterate.scratch)?);
            iterate.x[at] = f64::from(sides[at]);
        }
        let never = &mut Deadline::never();
        let found = match sweeps {
            None => TwoPhases { tableau }.solve(&matrix, given, iterate, never)?,
            Some(most) => Sweeps { omega: 1.2, tolerance: 1e-15, most }
                .solve(&matrix, given, iterate, never)?,
        };
        let Dense { mut x, residual, .. } = memory;
        if self.spans.is_empty() {
            let size = x.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
            let pairs = x.iter().zip(residual).filter(|_| sweeps.is_none());
            pairs.for_each(|(x, r)| CONDENSED.check("complementarity", x.min(r) / size));
        }
        x.truncate(self.order);
        Ok((x, found))
    }

    /// How many exchanges it takes from these sides, after the answer was checked.
    fn exchanges(&self, sides: &[i8], seen: &mut [u32; 3]) -> Result<usize, Error> {
        let (x, found) = self.solved(sides, None)?;
        assert_eq!((found.ended, found.sweeps), (Ended::Exact, 0), "{sides:?}");
        let entry = |i: usize, j: usize| self.rows[i][j];
        let off = defect(self.order, entry, [&self.load, &x], |at| self.ends(at));
        CONDENSED.check("law", off);
        for x in x {
            seen[usize::from(x > 0.0) + 2 * usize::from(x < 0.0)] += 1;
        }
        Ok(found.pivots as usize)
    }

    /// Sides that the ranges allow, from the digits of a number.
    fn sides(&self, mut state: usize) -> Vec<i8> {
        let side = |at: usize| {
            let side = [0, 1, -1][state % self.sides_of_each()];
            state /= self.sides_of_each();
            let [least, most] = self.ends(at);
            match side {
                1 if least.is_infinite() => -1,
                -1 if most.is_infinite() => 1,
                side => side,
            }
        };
        (0..self.order).map(side).collect()
    }

    fn sides_of_each(&self) -> usize {
        if self.spans.is_empty() { 2 } else { 3 }
    }
}

/// All states of small matrices, some of larger ones; how often x is on each side, and the most exchanges per edge.
fn from_every_state(has_limits: bool) -> Result<([u32; 3], f64), Error> {
    let (mut draw, mut most, mut seen) = (Draw(7), 0.0_f64, [0; 3]);
    for case in 0..60 {
        let n = 1 + case % 12;
        let plant = Plant::new(n, &mut draw, has_limits);
        let states = plant.sides_of_each().pow(n as u32);
        for state in 0..states.min(81) {
            let state = if states <= 81 { state } else { (draw.part() * states as f64) as usize };
            let sides = plant.sides(state);
            let taken = plant.exchanges(&sides, &mut seen)?;
            let bound = Phases::default().most(n, has_limits);
            // Half of the open edges leave at most before it starts anew, or one.
            let open = sides.iter().filter(|side| **side != 0).count();
            let limit = match has_limits {
                true => 4 * n,
                false if n == 1 => 1,
                false => n + (open / 2).max(open.min(1)),
            };
            assert!(taken <= limit.min(bound), "{taken} of {limit}");
            assert!(if has_limits { bound <= limit } else { limit <= bound });
            most = most.max(taken as f64 / n as f64);
        }
    }
    Ok((seen, most))
}

#[test]
fn every_state_leads_to_the_solution_within_the_bound() -> Result<(), Error> {
    let (seen, most) = from_every_state(false)?;
    assert!(seen[2] == 0 && most >= 1.0, "the states are easy: {most} exchanges per edge at most");
    let (seen, most) = from_every_state(true)?;
    assert!(seen.iter().all(|&count| count > 2000), "{seen:?}");
    assert!(most >= 2.0, "the states are easy: {most} exchanges per edge at most");
    Ok(())
}

/// Every edge pulls at every other, and the ground hardly holds them: openings of b/κ.
#[test]
fn openings_may_be_much_larger_than_loads() -> Result<(), Error> {
    let mut draw = Draw(5);
    for n in [2, 7, 12, 30] {
        for held in [1e-2, 1e-4, 1e-6, 1e-9] {
            let pull = -(1.0 - held) / (n as f64 - 1.0);
            let row = |i: usize| (0..n).map(|j| if i == j { 1.0 } else { pull }).collect();
            let plant = Plant::of((0..n).map(row).collect(), || 0.8 + 0.2 * draw.part());
            for (side, taken) in [(0, n), (1, 0)] {
                let (_, found) = plant.solved(&vec![side; n], None)?;
                assert_eq!((found.ended, found.sweeps), (Ended::Exact, 0));
                assert_eq!(found.pivots as usize, taken, "{held:e}");
            }
        }
    }
    Ok(())
}

#[test]
fn the_bound_is_that_of_the_order() {
    assert_eq!([0, 1, 7].map(|n| Phases::default().most(n, false)), [0, 1, 10]);
    assert_eq!([0, 1, 7].map(|n| Phases::default().most(n, true)), [0, 3, 24]);
    assert_eq!([0, 1, 8, 9].map(|n| Largest.most(n, false)), [0, 8, 8, 16]);
}

#[test]
fn sweeps_go_to_the_same_answer() -> Result<(), Error> {
    let mut draw = Draw(11);
    for case in 0..60 {
        let plant = Plant::new(1 + case % 12, &mut draw, true);
        let from = vec![0; plant.order];
        let (exact, _) = plant.solved(&from, None)?;
        let (swept, found) = plant.solved(&from, Some(2000))?;
        assert_eq!((found.pivots, found.ended), (0, Ended::Settled));
        THREE_PHASES_SWEPT.check_each("x", &swept, &exact);
    }
    Ok(())
}

/// Without time no edge changes: the answer of the state is clipped, and the next tick goes on from it.
#[test]
fn a_deadline_ends_a_tick_between_exchanges() -> Result<(), Error> {
    let plant = Plant::new(6, &mut Draw(3), false);
    let load = [0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.0, 0.0];
    let matrix = Blocks::new(&plant.blocks, 6)?;
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
    let blocks = in_blocks(2, |i, j| if i == j { 1.0 } else { -2.0 });
    let load = [1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
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
