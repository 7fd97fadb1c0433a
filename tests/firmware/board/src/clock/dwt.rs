//! The core's cycle counter, which the emulator does not have.

use cortex_m::Peripherals;
use cortex_m::peripheral::DWT;

pub const UNIT: u32 = 1;
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
