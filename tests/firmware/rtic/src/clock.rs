//! SysTick, which is both the tick and the clock that the tick looks at.

use cortex_m::peripheral::syst::SystClkSource;
use cortex_m::peripheral::{SCB, SYST};

/// Counts from one tick to the next. QEMU runs SysTick at 25 MHz, and `-icount shift=0` makes a count
/// of 40 instructions: on a real core, set the period by its clock.
pub const PERIOD: u32 = 40_000;

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
