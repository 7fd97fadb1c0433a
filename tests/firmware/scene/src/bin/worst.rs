//! The worst tick of a condensed scene on a board: from which edges open, and for which inputs, it takes most.
//!
//! ```text
//!   starts 10112          ticks that were tried, each from edges of its own that are open
//!   exchanges 9           the most
//!   instructions 8641     the most, of one tick
//!   unfinished 0          ticks that did not end with the solution
//! ```
//! Where there are few edges every set of them is tried, with inputs after inputs; else random sets and arcs of neighbours,
//! of every size. Where a flux has a limit, each of these edges is above or below its gap, at random.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use signorini_board::clock::{Clock, UNIT};
use signorini_board::draw::Draw;
use signorini_board::run;
use signorini_kernel::device::condensed::storage::{ArrayStorage, ArrayTableauStorage};
use signorini_kernel::device::limits::Deadline;
use signorini_kernel::device::ranges::check;
use signorini_kernel::device::report::{Ended, Report};
use signorini_kernel::solve::dense::blocks::{count, padded};
use signorini_kernel::solve::dense::tableau::InitialTableau;
use signorini_kernel::{Error, Real as _};
use signorini_scene::loads::loads;
use signorini_scene::scene::{CONTACT, INPUTS, Inputs, OUTPUTS, SYSTEM, Scalar};

const PADDED: usize = padded(CONTACT);
const COLUMNS: usize = match &SYSTEM.certificate {
    Some(form) => form.factor.norms.len(),
    None => 0,
};
const SPANS: usize = SYSTEM.spans.buffered(PADDED);
/// At least so many ticks.
const TICKS: u32 = 10_000;
/// With more edges than these not every set is tried.
const FEW: usize = 12;

/// What a controller has.
struct Memory {
    storage: ArrayStorage<Scalar, PADDED, COLUMNS, SPANS>,
    tableau: ArrayTableauStorage<Scalar, PADDED, { count(CONTACT) }>,
}

#[entry]
fn main() -> ! {
    static mut MEMORY: Memory =
        Memory { storage: ArrayStorage::zeros(), tableau: ArrayTableauStorage::zeros() };
    run(|journal| {
        let Some(clock) = Clock::start() else { return };
        let empty = clock.measure(1, || black_box(())).unwrap_or(0);
        let sets = if CONTACT <= FEW { 1 << CONTACT } else { TICKS };
        let (mut draw, mut inputs) = (Draw::new(), loads());
        let [mut tried, mut exchanges, mut instructions, mut unfinished] = [0_u32; 4];
        while tried < TICKS {
            for set in 0..sets {
                let Some(inputs) = inputs.next() else { return };
                let mut open = [false; CONTACT];
                if CONTACT <= FEW {
                    open.iter_mut().enumerate().for_each(|(at, open)| *open = set >> at & 1 == 1);
                } else {
                    draw_open(&mut draw, &mut open);
                }
                let mut report = None;
                let begun = begin(MEMORY, &open, &mut draw);
                let counts = clock.measure(1, || report = tick(MEMORY, inputs).ok());
                let (Ok(()), Some(report), Some(counts)) = (begun, report, counts) else {
                    journal.text("a tick fails");
                    return;
                };
                tried += 1;
                exchanges = exchanges.max(report.exchanges);
                instructions = instructions.max((counts - empty) * UNIT);
                unfinished += u32::from(report.ended != Ended::Exact);
            }
        }
        journal.count("starts", tried);
        journal.count("exchanges", exchanges);
        journal.count("instructions", instructions);
        journal.count("unfinished", unfinished);
    })
}

/// Every second time an arc of neighbours, else each edge with a probability that is drawn too.
fn draw_open(draw: &mut Draw, open: &mut [bool; CONTACT]) {
    let mut part = || (draw.uniform() + 1.0) / 2.0;
    let (is_arc, first, share) = (part() < 0.5, part(), part());
    for (at, open) in (0..).zip(open.iter_mut()) {
        let place = at as f32 / CONTACT as f32;
        *open = if is_arc { (first..=first + share).contains(&place) } else { part() < share };
    }
}

/// The state in which these edges are open.
fn begin(memory: &mut Memory, open: &[bool; CONTACT], draw: &mut Draw) -> Result<(), Error> {
    let matrix = SYSTEM.matrix()?;
    let mut method = memory.tableau.two_phases(&SYSTEM)?;
    method.tableau.reset(&InitialTableau::untouched(&matrix))?;
    let mut answer = [Scalar::ZERO; PADDED];
    for (at, _) in open.iter().enumerate().filter(|(_, open)| **open) {
        method.tableau.exchange(at, &mut answer)?;
    }
    // Between ticks no correction waits.
    let _ = method.tableau.blocks();
    if SYSTEM.spans.are_limited() {
        let x = memory.storage.memory(&SYSTEM).iterate.x;
        for (x, &open) in x.iter_mut().zip(open) {
            let side = if draw.uniform() < 0.0 { -Scalar::ONE } else { Scalar::ONE };
            *x = if open { side } else { Scalar::ZERO };
        }
    }
    Ok(())
}

/// What `Controller::tick` does.
#[inline(never)]
fn tick(memory: &mut Memory, inputs: Inputs) -> Result<Report<Scalar>, Error> {
    let inputs = inputs.to_array();
    check(&inputs, &Inputs::RANGES)?;
    let mut all = [1.0; INPUTS + 1];
    all.iter_mut().skip(1).zip(inputs).for_each(|(all, input)| *all = input);
    let mut method = memory.tableau.two_phases(&SYSTEM)?;
    let mut memory = memory.storage.memory(&SYSTEM);
    let report = SYSTEM.tick(&all, &mut method, &mut Deadline::never(), &mut memory)?;
    let mut outputs = [0.0; OUTPUTS];
    for (number, output) in outputs.iter_mut().enumerate() {
        *output = SYSTEM.output(number, &all, &memory, &report)?;
    }
    black_box(outputs);
    Ok(report)
}
