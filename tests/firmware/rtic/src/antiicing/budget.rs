//! The time of a tick, in counts of the clock: what there is, and what the kernel's steps take of it.

use cortex_m::peripheral::SYST;
use signorini_device::tick::{Deadline, Limits};
use signorini_kernel::Error;

use crate::clock::count;
use crate::scene::{Controller, Inputs};

/// A sweep of this scene: 14 080 instructions on a Cortex-M4F are 352 counts, and a few for the clock. Every run counts it
/// before the first tick ([`Costs::measure`]), and fails where it is more.
pub const SWEEP: u32 = 360;

/// A certificate of this scene, the outputs and the report: 197 840 instructions are 4946 counts. Every tick counts it, from the
/// last look at the clock to the answer.
pub const CERTIFICATE: u32 = 5020;

/// From one tick to the next, 8 million instructions: so short that the deadline ends some ticks.
pub const PERIOD: u32 = 200_000;

/// What the kernel may use; the rest is for publishing and for the task that checks.
pub const BUDGET: u32 = PERIOD / 16 * 15;

/// What a sweep costs, as counted.
pub struct Costs {
    pub sweep: u32,
}

impl Costs {
    /// Counts sweeps while there are no ticks yet.
    pub fn measure(systick: &mut SYST, controller: &mut Controller) -> Result<Self, Error> {
        let mut after = |sweeps| {
            let limits = Limits { error: 0.0, share: 0.0, sweeps };
            let tick = || controller.tick_within(Inputs::DEFAULT, limits, &mut Deadline::never());
            let (counts, answer) = count(systick, tick);
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
