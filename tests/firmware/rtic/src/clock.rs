//! SysTick, which is both the tick and the clock that the tick looks at.

use cortex_m::peripheral::syst::SystClkSource;
use cortex_m::peripheral::{SCB, SYST};

use crate::plant::PERIOD;

/// Instructions a count: QEMU runs SysTick at 25 MHz, and with `-icount shift=0` a nanosecond passes
/// with each instruction. On a real core, set the period by its clock.
pub const INSTRUCTIONS: u32 = 40;

/// The most that SysTick counts.
const LONGEST: u32 = 0x00ff_ffff;

/// The first tick is due a period from now.
pub fn start(systick: &mut SYST) {
    systick.set_clock_source(SystClkSource::Core);
    systick.set_reload(PERIOD - 1);
    systick.clear_current();
    systick.enable_interrupt();
    systick.enable_counter();
}

/// No more ticks, not even one that is due already.
pub fn stop(systick: &mut SYST) {
    systick.disable_counter();
    SCB::clear_pendst();
}

/// Counts since the running tick was due, right up to two periods: SysTick counts down, and where the
/// tick overruns it starts anew and leaves the next interrupt pending.
pub fn elapsed() -> u32 {
    let counted = PERIOD - 1 - SYST::get_current();
    if SCB::is_pendst_pending() { PERIOD + counted } else { counted }
}

/// How long `work` takes, with what comes of it; there are no ticks meanwhile.
pub fn count<T>(systick: &mut SYST, work: impl FnOnce() -> T) -> (u32, T) {
    systick.set_clock_source(SystClkSource::Core);
    systick.set_reload(LONGEST);
    systick.clear_current();
    systick.enable_counter();
    // It loads with the first count.
    while SYST::get_current() == 0 {}
    let before = SYST::get_current();
    let result = work();
    let after = SYST::get_current();
    systick.disable_counter();
    (before - after, result)
}
