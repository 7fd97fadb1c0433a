//! Counts what a piece of work costs: instructions in the emulator, cycles on a real board.
//!
//! With `-icount shift=0` QEMU lets a nanosecond pass with each instruction, and runs SysTick of the
//! mps2 boards at 25 MHz: a count is 40 instructions, exactly and every time. The cycle counter of the
//! core (DWT) is not emulated; the feature `dwt` takes it instead, for hardware.

use cortex_m::Peripherals;

/// Instructions (in the emulator) or cycles (with `dwt`) a count.
pub const UNIT: u32 = if cfg!(feature = "dwt") { 1 } else { 40 };

/// A counter that runs.
pub struct Clock(());

#[cfg(not(feature = "dwt"))]
mod counter {
    use cortex_m::peripheral::SYST;
    use cortex_m::peripheral::syst::SystClkSource;

    use super::Peripherals;

    pub const BITS: u32 = 0x00ff_ffff;

    pub fn start(peripherals: &mut Peripherals) {
        let systick = &mut peripherals.SYST;
        systick.set_clock_source(SystClkSource::Core);
        systick.set_reload(BITS);
        systick.clear_current();
        systick.enable_counter();
    }

    pub fn now() -> u32 {
        BITS - SYST::get_current()
    }
}

#[cfg(feature = "dwt")]
mod counter {
    use cortex_m::peripheral::DWT;

    use super::Peripherals;

    pub const BITS: u32 = u32::MAX;

    pub fn start(peripherals: &mut Peripherals) {
        peripherals.DCB.enable_trace();
        DWT::unlock();
        peripherals.DWT.enable_cycle_counter();
    }

    pub fn now() -> u32 {
        DWT::cycle_count()
    }
}

impl Clock {
    /// Starts the counter; the first caller gets it.
    pub fn start() -> Option<Self> {
        let mut peripherals = Peripherals::take()?;
        counter::start(&mut peripherals);
        Some(Self(()))
    }

    /// What `work` costs, done so often that the counter's grain does not matter: counts in all.
    pub fn measure(&self, times: u32, mut work: impl FnMut()) -> u32 {
        let start = counter::now();
        for _ in 0..times {
            work();
        }
        counter::now().wrapping_sub(start) & counter::BITS
    }
}
