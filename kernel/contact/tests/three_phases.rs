//! Exchanges in three phases where fluxes have limits: an end from every state, for matrices without a positive entry off the
//! diagonal; and sweeps to the same answer.

use crate::memory::{Dense, Draw};
use signorini_contact::dense::blocks::{Block, Blocks, SIDE, count, padded};
use signorini_contact::dense::ranges::Given;
use signorini_contact::dense::rule::{Phases, Rule as _};
use signorini_contact::method::{Method, Sweeps, TwoPhases};
use signorini_kernel::Error;
use signorini_kernel::flux_range::Spans;
use signorini_kernel::limits::Deadline;
use signorini_kernel::report::Ended;
use signorini_tolerances::kernel::{CONDENSED, THREE_PHASES_SWEPT};

/// A matrix, a load and spans.
struct Plant {
    order: usize,
    rows: Vec<Vec<f64>>,
    blocks: Vec<Block<f64>>,
    load: Vec<f64>,
    spans: Vec<f64>,
}

impl Plant {
    /// Neighbours pull most, and some not at all; spans of either sign, infinite, 0, tiny and as large as loads.
    fn new(order: usize, draw: &mut Draw) -> Self {
        let mut rows = vec![vec![0.0; order]; order];
        let mut blocks = vec![[[0.0; SIDE]; SIDE]; count(order)];
        for (i, j) in (0..order).flat_map(|i| (0..=i).map(move |j| (i, j))) {
            let far = (i - j) as f64;
            let pull = if draw.part() < 0.3 { 0.0 } else { -0.29 * draw.part() };
            let entry = if i == j { 1.0 } else { pull / (far * far) };
            (rows[i][j], rows[j][i]) = (entry, entry);
            for (i, j) in [(i, j), (j, i)].into_iter().filter(|(i, j)| j / SIDE <= i / SIDE) {
                let (row, column) = (i / SIDE, j / SIDE);
                blocks[row * (row + 1) / 2 + column][i % SIDE][j % SIDE] = entry;
            }
        }
        let mut load = vec![0.0; padded(order)];
        load[..order].fill_with(|| 1.6 * draw.part() - 0.8);
        let (kinds, sizes) = ([0.0, 1e-9, 0.2, 0.6, f64::INFINITY], [1.0, 1.0, -1.0]);
        let mut span = || kinds[(draw.part() * 5.0) as usize] * sizes[(draw.part() * 3.0) as usize];
        let spans = (0..order).map(|_| span()).collect();
        Self { order, rows, blocks, load, spans }
    }

    fn ends(&self, at: usize) -> [f64; 2] {
        let span = self.spans[at];
        if span < 0.0 { [span, 0.0] } else { [0.0, span] }
    }

    /// How far x and w = Sx − b are from the law.
    fn defect(&self, x: &[f64]) -> f64 {
        let of = |at: usize| {
            let row = &self.rows[at];
            let w = row.iter().zip(x).map(|(s, x)| s * x).sum::<f64>() - self.load[at];
            let [least, most] = self.ends(at);
            match x[at] {
                0.0 => (least - w).max(w - most).max(0.0),
                x if x > 0.0 => (w - least).abs(),
                _ => (w - most).abs(),
            }
        };
        (0..self.order).map(of).fold(0.0, f64::max)
    }

    /// x by `solve`, what it took, and how it ended; it begins with these sides, above, on and below the gap.
    fn solved(&self, sides: &[i8], sweeps: Option<u32>) -> Result<(Vec<f64>, u32, Ended), Error> {
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
        memory.x.truncate(self.order);
        Ok((memory.x, found.pivots, found.ended))
    }

    /// Sides that the ranges allow, from the digits of a number.
    fn sides(&self, mut state: usize) -> Vec<i8> {
        let side = |at: usize| {
            let side = [0, 1, -1][state % 3];
            state /= 3;
            let [least, most] = self.ends(at);
            match side {
                1 if least.is_infinite() => -1,
                -1 if most.is_infinite() => 1,
                side => side,
            }
        };
        (0..self.order).map(side).collect()
    }
}

#[test]
fn every_state_leads_to_the_solution_within_the_bound() -> Result<(), Error> {
    let (mut draw, mut most, mut seen) = (Draw(7), 0.0_f64, [0; 3]);
    for case in 0..60 {
        let n = 1 + case % 12;
        let plant = Plant::new(n, &mut draw);
        let states = 3_usize.pow(n as u32);
        for state in 0..states.min(81) {
            let state = if states <= 81 { state } else { (draw.part() * states as f64) as usize };
            let (x, pivots, ended) = plant.solved(&plant.sides(state), None)?;
            assert_eq!(ended, Ended::Exact, "{n} {state}");
            let bound = Phases::default().most(n, true);
            assert!(pivots as usize <= bound && bound <= 4 * n, "{pivots} of {bound}");
            CONDENSED.check("law", plant.defect(&x));
            most = most.max(f64::from(pivots) / n as f64);
            for x in x {
                seen[usize::from(x > 0.0) + 2 * usize::from(x < 0.0)] += 1;
            }
        }
    }
    assert!(seen.iter().all(|&count| count > 2000), "{seen:?}");
    assert!(most >= 2.0, "the states are easy: {most} exchanges per edge at most");
    Ok(())
}

#[test]
fn the_bound_is_that_of_the_order() {
    assert_eq!([0, 1, 7].map(|n| Phases::default().most(n, true)), [0, 3, 24]);
}

#[test]
fn sweeps_go_to_the_same_answer() -> Result<(), Error> {
    let mut draw = Draw(11);
    for case in 0..60 {
        let plant = Plant::new(1 + case % 12, &mut draw);
        let from = vec![0; plant.order];
        let (exact, ..) = plant.solved(&from, None)?;
        let (swept, pivots, ended) = plant.solved(&from, Some(2000))?;
        assert_eq!((pivots, ended), (0, Ended::Settled));
        THREE_PHASES_SWEPT.check_each("x", &swept, &exact);
    }
    Ok(())
}
