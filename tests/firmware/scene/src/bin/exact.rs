//! The exact solver of a condensed scene by itself, on random inputs: what `cargo xtask peers` compares.
//!
//! ```text
//!   @ heap 4096                    bytes of its memory
//!   215 3f800000 00000000 ...      40 instructions a count, from the load to x; then the bits of x
//! ```
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use signorini_board::clock::Clock;
use signorini_board::draw::Draw;
use signorini_board::{end, run};
use signorini_contact::dense::blocks::{count, padded};
use signorini_contact::dense::ranges::Given;
use signorini_contact::method::Method as _;
use signorini_contact::storage::{ArrayStorage, ArrayTableauStorage};
use signorini_kernel::Error;
use signorini_kernel::limits::Deadline;
use signorini_scene::scene::{CONTACT, INPUTS, Inputs, SYSTEM};

const PADDED: usize = padded(CONTACT);
const TICKS: u32 = 1000;

/// The peers know of limits that stay alone.
const _: () = assert!(SYSTEM.spans.buffered(PADDED) == 0);

/// x, loads and the tableau.
struct Memory {
    storage: ArrayStorage<f32, PADDED, 0>,
    tableau: ArrayTableauStorage<f32, PADDED, { count(CONTACT) }>,
}

#[entry]
fn main() -> ! {
    static mut MEMORY: Memory =
        Memory { storage: ArrayStorage::zeros(), tableau: ArrayTableauStorage::zeros() };
    run(|journal| {
        let Some(clock) = Clock::start() else { end(false) };
        journal.count("@ heap", size_of::<Memory>() as u32);
        // Not counted: a controller starts once, at its default inputs.
        let mut inputs = Inputs::DEFAULT.to_array();
        let mut draw = Draw::new();
        for tick in 0..=TICKS {
            load(&inputs, MEMORY);
            let mut solved = Ok(());
            let counts = clock.measure(1, || solved = solve(MEMORY));
            if solved.is_err() {
                journal.text("a tick fails");
                return;
            }
            if tick > 0 {
                let x = &*MEMORY.storage.memory(&SYSTEM).iterate.x;
                let x = x.get(..CONTACT).unwrap_or_default();
                // As for the peers, the call is part of it.
                journal.record(counts.unwrap_or(u32::MAX), x.iter().copied());
            }
            inputs.iter_mut().for_each(|input| *input = draw.uniform());
        }
    })
}

/// b = B p, not counted.
fn load(inputs: &[f32; INPUTS], memory: &mut Memory) {
    let load = memory.storage.memory(&SYSTEM).load;
    load.fill(0.0);
    let inputs = core::iter::once(&1.0).chain(inputs);
    for (column, &p) in SYSTEM.load.chunks_exact(PADDED).zip(inputs) {
        load.iter_mut().zip(column).for_each(|(load, &entry)| *load += entry * p);
    }
}

/// From b to x.
#[inline(never)]
fn solve(memory: &mut Memory) -> Result<(), Error> {
    let matrix = SYSTEM.matrix()?;
    let lent = memory.storage.memory(&SYSTEM);
    let given = Given::between(lent.load, SYSTEM.spans.of(PADDED, &lent.spans), &[]);
    let mut method = memory.tableau.two_phases(&SYSTEM)?;
    method.solve(&matrix, given, lent.iterate, &mut Deadline::never()).map(|_| ())
}
