//! Counts what a piece of work costs: instructions in the emulator, cycles on a real board.
//!
//! With `-icount shift=0` QEMU lets a nanosecond pass with each instruction, and runs SysTick of the
//! mps2 boards at 25 or 20 MHz: a count is 40 or 50 instructions, exactly and every time. The netduinoplus2 has a timer
//! with a count an instruction. The cycle counter of the core (DWT) is not emulated; the feature `dwt` takes
//! it instead, for hardware.

use cortex_m::Peripherals;

#[cfg_attr(feature = "dwt", path = "clock/dwt.rs")]
#[cfg_attr(all(not(feature = "dwt"), board = "netduinoplus2"), path = "clock/tim2.rs")]
#[cfg_attr(all(not(feature = "dwt"), not(board = "netduinoplus2")), path = "clock/systick.rs")]
mod counter;

/// Instructions (in the emulator) or cycles (with `dwt`) a count.
pub const UNIT: u32 = counter::UNIT;

/// A counter that runs.
pub struct Clock(());

impl Clock {
    /// Starts the counter; the first caller gets it.
    pub fn start() -> Option<Self> {
        let mut peripherals = Peripherals::take()?;
        counter::start(&mut peripherals);
        Some(Self(()))
    }

    /// What `work` costs, done so often that the counter's grain does not matter: counts in all.
    /// `None` where that is more than the counter holds.
    pub fn measure(&self, times: u32, mut work: impl FnMut()) -> Option<u32> {
        counter::restart();
        let start = counter::now();
        for _ in 0..times {
            work();
        }
        let end = counter::now();
        (!counter::went_round()).then(|| end.wrapping_sub(start) & counter::BITS)
    }
}
