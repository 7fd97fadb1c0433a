//! The worst tick of a condensed scene on a board: from which sides of its edges, and for which inputs, it takes most.
//!
//! ```text
//!   starts 10112          ticks that were tried, each from sides of its own
//!   exchanges 9           the most
//!   instructions 8641     the most, of one tick
//!   unfinished 0          ticks that did not end with the solution
//! ```
//! Where there are few edges every set of open ones is tried, with inputs after inputs; else random sets and arcs of
//! neighbours, of every size. Where a flux has a limit, edges of the set are above their gaps, or below, or of both kinds.

use core::hint::black_box;

use signorini_board::clock::{Clock, UNIT};
use signorini_board::draw::Draw;
use signorini_board::journal::Journal;
use signorini_contact::Condensed;
use signorini_contact::dense::blocks::padded;
use signorini_contact::dense::tableau::InitialTableau;
use signorini_contact::method::TwoPhases;
use signorini_kernel::report::Ended;
use signorini_kernel::{Error, Real as _};

use crate::loads::loads;
use crate::scene::{CONTACT, Controller, Inputs, Scalar};
use crate::tick;

/// At least so many ticks.
const TICKS: u32 = 10_000;
/// With more edges than these not every set is tried.
const FEW: usize = 12;

/// Tries ticks from starts of every kind, and tells what the worst took. `begin` makes the state before a tick with these inputs:
/// an edge is above its gap, on it or below it by the sign of its side; below where a flux has a limit alone.
pub fn search(
    journal: &mut Journal,
    controller: &mut Controller,
    is_limited: bool,
    mut begin: impl FnMut(&mut Controller, Inputs, &[Scalar; CONTACT]) -> Result<(), Error>,
) {
    let Some(clock) = Clock::start() else { return };
    let empty = clock.measure(1, || black_box(())).unwrap_or(0);
    let sets = if CONTACT <= FEW { 1 << CONTACT } else { TICKS };
    let (mut draw, mut inputs) = (Draw::new(), loads());
    let [mut tried, mut exchanges, mut instructions, mut unfinished] = [0_u32; 4];
    while tried < TICKS {
        for set in 0..sets {
            let Some(inputs) = inputs.next() else { return };
            let mut answer = None;
            let begun = begin(controller, inputs, &sides(&mut draw, set, is_limited));
            let counts = clock.measure(1, || answer = tick(controller, inputs).ok());
            let (Ok(()), Some(answer), Some(counts)) = (begun, answer, counts) else {
                journal.text("a tick fails");
                return;
            };
            let report = black_box(answer).report;
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
}

/// Sides of all edges: those of set `set` are open where there are few, of one that is drawn elsewhere.
fn sides(draw: &mut Draw, set: u32, is_limited: bool) -> [Scalar; CONTACT] {
    let mut open = [false; CONTACT];
    if CONTACT <= FEW {
        open.iter_mut().enumerate().for_each(|(at, open)| *open = set >> at & 1 == 1);
    } else {
        draw_open(draw, &mut open);
    }
    // One in three is all above, one in three all below.
    let balance = 3.0 * draw.uniform();
    open.map(|open| match open {
        false => Scalar::ZERO,
        true if is_limited && draw.uniform() < balance => -Scalar::ONE,
        true => Scalar::ONE,
    })
}

/// Every second time an arc of neighbours, else each edge with a probability that is drawn too.
fn draw_open(draw: &mut Draw, open: &mut [bool; CONTACT]) {
    let (is_arc, first, share) = (draw.part() < 0.5, draw.part(), draw.part());
    for (at, open) in (0..).zip(open.iter_mut()) {
        let place = at as f32 / CONTACT as f32;
        *open = if is_arc { (first..=first + share).contains(&place) } else { draw.part() < share };
    }
}

/// The tableau of these sides.
///
/// # Errors
/// A model of another size.
pub fn exchange(
    model: &Condensed<Scalar>,
    mut method: TwoPhases<Scalar>,
    sides: &[Scalar; CONTACT],
) -> Result<(), Error> {
    let matrix = model.matrix()?;
    method.tableau.reset(&InitialTableau::untouched(&matrix))?;
    let mut answer = [Scalar::ZERO; padded(CONTACT)];
    for (at, _) in sides.iter().enumerate().filter(|(_, side)| **side != Scalar::ZERO) {
        method.tableau.exchange(at, &mut answer)?;
    }
    // Between ticks no correction waits.
    let _ = method.tableau.blocks();
    Ok(())
}
