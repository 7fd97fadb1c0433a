//! Arithmetic that flushes subnormal numbers to zero, as firmware may set up its floating-point unit for speed.

use core::hint::black_box;

use cortex_m::register::fpscr;

/// Flushes what goes into operations in f32, and f64 where there is a unit for it, and what comes out; NaNs lose
/// their payload. Tells whether the unit does.
pub fn subnormals() -> bool {
    let mut control = fpscr::read();
    control.set_fz(true);
    control.set_dn(true);
    // SAFETY: rounding stays to nearest, and no exception traps on these cores. The compiler may work out a subnormal
    // number itself, which is then not flushed: either is an arithmetic that the kernel must stand.
    unsafe { fpscr::write(control) };
    let half = black_box(f32::MIN_POSITIVE) * black_box(0.5);
    half.to_bits() == 0
}
