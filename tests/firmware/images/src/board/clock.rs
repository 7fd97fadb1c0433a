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

    /// Starts at 0 again, with nothing to tell.
    pub fn restart() {
        // SAFETY: the counter is this module's alone; any write sets it to 0.
        unsafe { (*SYST::PTR).cvr.write(0) };
        // The write takes effect with the next count.
        while SYST::get_current() == 0 {}
        let _ = went_round();
    }

    /// Whether the counter has gone round since it was asked last.
    pub fn went_round() -> bool {
        // SAFETY: reading the status has no effect but on this flag, which nobody else asks for.
        unsafe { (*SYST::PTR).csr.read() & 1 << 16 != 0 }
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

    /// 32 bits go round seldom enough.
    pub fn restart() {}

    /// The counter does not tell; at 168 MHz it goes round in 25 s.
    pub fn went_round() -> bool {
        false
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
