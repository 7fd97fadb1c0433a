//! How deep the stack gets: painted before, scanned after.

use cortex_m::register::msp;

const PAINT: u32 = 0xc0de_57ac;

/// Bytes below the present frame that are left alone: this function's own.
const MARGIN: u32 = 64;

/// Bytes of stack that `work` uses, of the `depth` bytes that are watched (a multiple of 4 below the
/// present stack pointer, all of them free).
#[inline(never)]
pub fn depth(depth: u32, work: impl FnOnce()) -> u32 {
    let top = msp::read() - MARGIN;
    let bottom = top - depth;
    for at in (bottom..top).step_by(4) {
        // SAFETY: memory between the stack pointer and the statics, used by nobody else.
        unsafe { (at as *mut u32).write_volatile(PAINT) };
    }
    work();
    let used = (bottom..top).step_by(4).find(|&at| {
        // SAFETY: as above.
        unsafe { (at as *const u32).read_volatile() != PAINT }
    });
    used.map_or(0, |at| top - at) + MARGIN
}

/// Bytes below the present frame down to the statics: what [`depth`] may watch.
pub fn free() -> u32 {
    unsafe extern "C" {
        /// Where cortex-m-rt's linker script lets a heap begin: the end of the statics.
        static __sheap: u32;
    }
    // The caller of `depth` may have a larger frame than ours.
    const FRAMES: u32 = 1024;
    (msp::read() - FRAMES).saturating_sub(&raw const __sheap as u32) & !3
}
