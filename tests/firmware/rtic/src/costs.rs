//! The time of a tick, in counts of the clock: what there is, and what the kernel's steps take of it.

use cortex_m::peripheral::SYST;
use signorini_device::tick::{Deadline, Limits};
use signorini_kernel::Error;

use crate::clock::{count, elapsed};
use crate::log::Times;
use crate::plant::{Answer, CERTIFICATE, LIMITS, PERIOD, Plant, SWEEP};

/// What the kernel may use; the rest is for publishing and for the task that checks.
pub const BUDGET: u32 = PERIOD / 16 * 15;

/// Sweeps until that buys nothing more or the budget does not cover another one.
pub fn answer(plant: &mut Plant) -> Result<(Answer, Times), Error> {
    let mut looked = 0;
    let remaining = || {
        looked = elapsed();
        BUDGET.saturating_sub(looked)
    };
    let mut deadline = Deadline { remaining, sweep: SWEEP, certificate: CERTIFICATE };
    let answer = plant.answer(LIMITS, &mut deadline)?;
    let answered = elapsed();
    Ok((answer, Times { looked, answered, ended: answered }))
}

/// What a sweep costs, as counted.
pub struct Costs {
    pub sweep: u32,
}

impl Costs {
    /// Counts sweeps while there are no ticks yet.
    pub fn measure(systick: &mut SYST, plant: &mut Plant) -> Result<Self, Error> {
        let mut after = |sweeps| {
            let limits = Limits { error: 0.0, share: 0.0, sweeps };
            let (counts, answer) = count(systick, || plant.answer(limits, &mut Deadline::never()));
            answer.map(|_| counts)
        };
        // The first lays out the rows. Nothing asks for a certificate before the end; what one takes hangs a little on the data.
        after(0)?;
        let (few, more) = (after(3)?, after(35)?);
        Ok(Self { sweep: (more - few).div_ceil(32) })
    }

    /// Whether the deadlines were told no less; `unwatched` as the ticks saw it.
    pub fn are_covered(&self, unwatched: u32) -> bool {
        self.sweep <= SWEEP && unwatched <= CERTIFICATE
    }
}
