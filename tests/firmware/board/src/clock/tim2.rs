//! TIM2 of the netduinoplus2, which QEMU runs at 1 GHz: a count is an instruction. TIM5 counts thousands, to
//! tell when TIM2 has gone round.

use cortex_m::Peripherals;

pub const UNIT: u32 = 1;
pub const BITS: u32 = u32::MAX;

const TIM2: *mut u32 = 0x4000_0000 as *mut u32;
const TIM5: *mut u32 = 0x4000_0c00 as *mut u32;

// Registers, in words.
const CR1: usize = 0;
const EGR: usize = 5;
const CNT: usize = 9;
const PSC: usize = 10;
const ARR: usize = 11;

const THOUSAND: u32 = 1000;

pub fn start(_: &mut Peripherals) {
    for (timer, counts) in [(TIM2, 1), (TIM5, THOUSAND)] {
        // SAFETY: registers of a timer that is this module's alone.
        unsafe {
            timer.add(PSC).write_volatile(counts - 1);
            timer.add(ARR).write_volatile(u32::MAX);
            timer.add(EGR).write_volatile(1);
            timer.add(CR1).write_volatile(1);
        }
    }
}

pub fn now() -> u32 {
    // SAFETY: reading a counter has no effect.
    unsafe { TIM2.add(CNT).read_volatile() }
}

/// Thousands from 0 again.
pub fn restart() {
    // SAFETY: as in `start`.
    unsafe { TIM5.add(CNT).write_volatile(0) }
}

/// Whether the counter has gone round since `restart`.
pub fn went_round() -> bool {
    // SAFETY: as in `now`.
    unsafe { TIM5.add(CNT).read_volatile() >= u32::MAX / THOUSAND }
}
