//! SysTick of the mps2 boards: 25 MHz, or 40 instructions a count; of the mps2-an505 20 MHz, or 50.

use cortex_m::Peripherals;
use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;

pub const UNIT: u32 = if cfg!(board = "mps2-an505") { 50 } else { 40 };
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
