//! Arithmetic that flushes subnormal numbers to zero, as many a microcontroller is set up to do.
//!
//! Both what goes into an operation and what comes out: MXCSR's DAZ and FTZ, FPCR's FZ.

/// Whether this machine can be told to.
pub const SUPPORTED: bool = cfg!(any(target_arch = "x86_64", target_arch = "aarch64"));

#[cfg(target_arch = "x86_64")]
const FLUSH: u64 = 1 << 15 | 1 << 6;
#[cfg(target_arch = "aarch64")]
const FLUSH: u64 = 1 << 24;
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
const FLUSH: u64 = 0;

/// Runs `work` with subnormal numbers flushed on this thread, and puts the mode back, panic or not.
pub fn flushed<T>(work: impl FnOnce() -> T) -> T {
    struct Restored(u64);
    impl Drop for Restored {
        fn drop(&mut self) {
            set_control(self.0);
        }
    }
    let restored = Restored(control());
    set_control(restored.0 | FLUSH);
    work()
}

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
fn control() -> u64 {
    let mut word = 0_u32;
    // SAFETY: stores four bytes to a place of four bytes.
    unsafe { core::arch::asm!("stmxcsr [{}]", in(reg) &raw mut word, options(nostack)) };
    u64::from(word)
}

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
fn set_control(word: u64) {
    let word = word as u32;
    // SAFETY: the word is that of this thread with FTZ and DAZ set or as they were, so that no exception is unmasked.
    // The compiler assumes the default mode: a subnormal number that it works out itself is not flushed, and
    // nothing but this study, which judges the result in the default mode, depends on either.
    unsafe { core::arch::asm!("ldmxcsr [{}]", in(reg) &raw const word, options(nostack)) };
}

#[cfg(target_arch = "aarch64")]
#[allow(unsafe_code)]
fn control() -> u64 {
    let word: u64;
    // SAFETY: reads a register that user mode may read.
    unsafe { core::arch::asm!("mrs {}, fpcr", out(reg) word) };
    word
}

#[cfg(target_arch = "aarch64")]
#[allow(unsafe_code)]
fn set_control(word: u64) {
    // SAFETY: the word is that of this thread with FZ set or as it was; see the other architecture.
    unsafe { core::arch::asm!("msr fpcr, {}", in(reg) word) };
}

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
fn control() -> u64 {
    0
}

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
fn set_control(_: u64) {}

#[cfg(test)]
mod tests {
    use std::hint::black_box;

    use super::*;

    #[test]
    fn subnormal_numbers_vanish_inside_and_only_there() {
        let halves = || {
            let (single, double) = (black_box(f32::MIN_POSITIVE), black_box(f64::MIN_POSITIVE));
            (black_box(single * black_box(0.5)), black_box(double * black_box(0.5)))
        };
        assert_ne!(halves(), (0.0, 0.0));
        if SUPPORTED {
            assert_eq!(flushed(halves), (0.0, 0.0));
        }
        assert_ne!(halves(), (0.0, 0.0));
        let panicked = std::panic::catch_unwind(|| flushed(|| panic!("asked for by a test")));
        let why = panicked.expect_err("a panic");
        assert_eq!(why.downcast_ref(), Some(&"asked for by a test"));
        assert_ne!(halves(), (0.0, 0.0));
    }
}
