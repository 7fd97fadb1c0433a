//! A baked scene on a board: every tick's bits, what it costs, and how deep the stack gets.
//!
//! ```text
//!   @ instructions 51234      of a tick, the call included
//!   @ stack 1096 65536        the deepest of all ticks, and how deep it was watched
//! ```
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use signorini_board::clock::{Clock, UNIT};
use signorini_board::{run, stack};
use signorini_scene::play::play;
use signorini_scene::scene::Controller;
use signorini_scene::tick;

/// Bytes of stack that are watched, where there are as many.
const WATCHED: u32 = 1 << 16;

#[entry]
fn main() -> ! {
    // Of cortex-m-rt: the entry gets a reference to it. Initialised by its type, not by code that would
    // build it on the stack first.
    static mut CONTROLLER: Controller = Controller::new();
    run(|journal| {
        let Some(clock) = Clock::start() else { return };
        let empty = clock.measure(1, || black_box(())).unwrap_or(0);
        let watched = stack::free().min(WATCHED);
        let mut deepest = 0;
        play(CONTROLLER, journal, |controller, inputs, journal| {
            let (mut answer, mut counts) = (None, None);
            let depth = stack::depth(watched, || {
                counts = clock.measure(1, || answer = tick(controller, inputs).ok());
            });
            deepest = deepest.max(depth);
            match counts {
                Some(counts) => journal.count("@ instructions", (counts - empty) * UNIT),
                None => journal.text("@ instructions beyond-the-counter"),
            }
            answer
        });
        journal.row(&["@ stack"], &[deepest, watched]);
    })
}
