//! What exchanges in three phases cost, where fluxes have limits, for 8, 16, 32 and 64 contact edges; and a matrix that follows
//! a transfer coefficient.
//!
//! ```text
//!   nothing open ─► all open                    as without limits, with the ranges looked at
//!   nothing open ─► all at their limits         each by a way of its own, with an exchange
//!   all at their limits, nothing changes
//!   S(t) of no mode and of eight
//! ```
//! In f32 alone: soft floats take more or less with their operands.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use signorini_contact::dense::blocks::{self, Blocks, SIDE};
use signorini_contact::dense::outer::{add_outer, without_positive};
use signorini_contact::dense::ranges::Given;
use signorini_contact::dense::rule::Phases;
use signorini_contact::dense::tableau::{InitialTableau, Tableau};
use signorini_contact::dense::{Iterate, pivoting};
use signorini_firmware::meter::{Meter, run};
use signorini_firmware::plate::fill;
use signorini_firmware::stages::cut;
use signorini_kernel::Error;
use signorini_kernel::flux_range::Spans;

const MOST: usize = 64;
const BLOCKS: usize = blocks::count(MOST);
/// Modes of a coefficient.
const MODES: usize = 8;

#[entry]
fn main() -> ! {
    run(|meter| {
        stages(meter.kind("limits, n = 8"), 8)?;
        stages(meter.kind("limits, n = 16"), 16)?;
        stages(meter.kind("limits, n = 32"), 32)?;
        stages(meter.kind("limits, n = 64"), 64)
    })
}

#[inline(never)]
fn stages(meter: &mut Meter, n: usize) -> Result<(), Error> {
    let mut own = [[[0.0_f32; SIDE]; SIDE]; BLOCKS];
    let own = cut(&mut own, blocks::count(n))?;
    fill(own);
    let matrix = Blocks::new(&*own, n)?;
    let (mut room, mut exchanged) = ([[[0.0; SIDE]; SIDE]; BLOCKS], [false; MOST]);
    let mut numbers = [[0.0; MOST]; 6];
    let [x, residual, scratch, column, next, load] = &mut numbers;
    let (room, exchanged) = (cut(&mut room, blocks::count(n))?, cut(&mut exchanged, n)?);
    let mut tableau = Tableau::new(n, room, exchanged, [cut(column, n)?, cut(next, n)?])?;
    let (x, residual, scratch, load) =
        (cut(x, n)?, cut(residual, n)?, cut(scratch, n)?, cut(load, n)?);
    let (mut open, spans) = ([false; MOST], [1.0; MOST]);
    let (open, spans) = (cut(&mut open, n)?, Spans::new(spans.get(..n).unwrap_or_default())?);
    let start = InitialTableau::untouched(&matrix);
    let mut solve = |load: &[f32], anew: bool| {
        if anew {
            tableau.reset(&start)?;
        }
        let iterate = Iterate {
            x: &mut *x,
            residual: &mut *residual,
            scratch: &mut *scratch,
            open: &mut *open,
        };
        let given = Given::between(load, spans, &[]);
        let rule = &mut Phases::default();
        pivoting::find(&matrix, given, &mut tableau, &start, rule, |_| true, iterate).map(|_| ())
    };
    load.fill(1.0);
    meter.count("three phases, all edges come in", "n²", n * n, || solve(load, true))?;
    load.fill(-9.0);
    meter.count("three phases, all to their limits", "n²", n * n, || solve(load, true))?;
    meter.count("three phases, all stay there", "n²", n * n, || solve(load, false))?;
    let alphas = [0.01; MODES * MOST];
    let mut follow = |modes: usize| {
        room.iter_mut().zip(own.iter()).for_each(|(room, own)| *room = *own);
        add_outer(room, n, alphas.get(..modes * n).unwrap_or_default(), |k| {
            1.0 / (1.0 + k as f32)
        })?;
        without_positive(room);
        Ok(())
    };
    meter.count("modes, a matrix of none", "n²", n * n, || follow(0))?;
    meter.count("modes, a matrix of eight", "n²", n * n, || follow(MODES))
}
