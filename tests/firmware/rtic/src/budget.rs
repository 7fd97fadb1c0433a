//! The time of a tick, in counts of the clock: what there is, and what the kernel's steps take of it.

use cortex_m::peripheral::SYST;
use signorini_device::tick::{Deadline, Limits};
use signorini_kernel::Error;

use crate::clock::count;
use crate::mesh::COLUMNS;
use crate::plant::Plant;

/// A sweep of this mesh: 8 600 instructions on a Cortex-M4F are 215 counts, and a few for the clock.
/// Every run counts it before the first tick ([`Costs::measure`]), and fails where it is more.
pub const SWEEP: u32 = 220;

/// A certificate of this mesh and the report after it: 107 900 instructions are 2 698 counts. Every tick
/// counts it, from the last look at the clock to the answer.
pub const CERTIFICATE: u32 = 2720;

/// From one tick to the next: so short that the deadline ends one tick in five. An overloaded tick
/// has no time for a certificate, let alone a sweep.
pub const PERIOD: u32 = if cfg!(feature = "overload") { CERTIFICATE / 2 } else { 13_100 };

/// What the kernel may use; the rest is for publishing and for the task that checks.
pub const BUDGET: u32 = PERIOD / 16 * 15;

/// What a sweep costs, as counted.
pub struct Costs {
    pub sweep: u32,
}

impl Costs {
    /// Counts sweeps while there are no ticks yet.
    pub fn measure(systick: &mut SYST, plant: &mut Plant) -> Result<Self, Error> {
        plant.set(&[0.0; COLUMNS])?;
        let mut after = |sweeps| {
            let limits = Limits { error: 0.0, share: 0.0, sweeps };
            let (counts, answer) = count(systick, || plant.answer(limits, &mut Deadline::never()));
            answer.map(|_| counts)
        };
        // The first lays out the rows; those after it are few enough for a single certificate each.
        after(0)?;
        let (none, three) = (after(0)?, after(3)?);
        Ok(Self { sweep: (three - none).div_ceil(3) })
    }

    /// Whether the deadlines were told no less; `unwatched` as the ticks saw it.
    pub fn are_covered(&self, unwatched: u32) -> bool {
        self.sweep <= SWEEP && unwatched <= CERTIFICATE
    }
}
