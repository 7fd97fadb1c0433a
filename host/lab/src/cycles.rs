//! Cycles on the host: the processor's own time-stamp counter.
//!
//! On x86-64 this is RDTSC, which counts at the processor's nominal frequency whatever the current
//! clock is; on AArch64 the generic timer CNTVCT, at a lower frequency. Figures are the smallest of
//! several repeats: what the work costs when nothing else disturbs it.

/// The unit that [`counted`] counts, for the report.
pub const METHOD: &str = if cfg!(target_arch = "x86_64") {
    "x86-64 time-stamp counter (RDTSC), smallest of 7 repeats"
} else if cfg!(target_arch = "aarch64") {
    "AArch64 generic timer (CNTVCT_EL0), smallest of 7 repeats"
} else {
    "nanoseconds of the monotonic clock, smallest of 7 repeats"
};

/// Whether this program is built for registers of four f64 on x86-64, which RUSTFLAGS ask for.
pub const IS_WIDE: bool = cfg!(all(target_feature = "avx2", target_feature = "fma"));

/// The registers that this program is built for, for records of cycles.
pub const REGISTERS: &str = if IS_WIDE {
    "x86-64 with avx2 and fma"
} else if cfg!(target_arch = "x86_64") {
    "any x86-64"
} else if cfg!(target_arch = "aarch64") {
    "any AArch64"
} else {
    "the target's own"
};

/// A remark on cycles that a wider build would have less of.
pub const NARROW: Option<&str> = if cfg!(target_arch = "x86_64") && !IS_WIDE {
    Some(
        "cycles of a build for any x86-64; where there is AVX2, a build with RUSTFLAGS=\"-C target-feature=+avx2,+fma\" measures with it",
    )
} else {
    None
};

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
pub fn now() -> u64 {
    // SAFETY: RDTSC reads a register and exists on every x86-64 processor.
    unsafe { core::arch::x86_64::_rdtsc() }
}

#[cfg(target_arch = "aarch64")]
#[allow(unsafe_code)]
pub fn now() -> u64 {
    let ticks: u64;
    // SAFETY: reading the virtual counter has no side effect and is allowed in user mode.
    unsafe { core::arch::asm!("mrs {}, cntvct_el0", out(reg) ticks) };
    ticks
}

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
pub fn now() -> u64 {
    static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    START.get_or_init(std::time::Instant::now).elapsed().as_nanos() as u64
}

const REPEATS: usize = 7;

/// The cycles of `work` and what it returns.
pub fn counted<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let start = now();
    let result = work();
    (now().saturating_sub(start) as f64, result)
}

/// The smallest number of cycles that `work` took.
pub fn smallest(mut work: impl FnMut()) -> f64 {
    [(); REPEATS].map(|()| counted(&mut work).0).into_iter().fold(f64::INFINITY, f64::min)
}

/// The median, and (largest − smallest)/median; 0 of nothing.
pub fn median_and_spread(numbers: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let mut sorted: Vec<f64> = numbers.into_iter().collect();
    sorted.sort_unstable_by(f64::total_cmp);
    let Some(&median) = sorted.get(sorted.len() / 2) else { return (0.0, 0.0) };
    (median, (sorted[sorted.len() - 1] - sorted[0]) / median.max(1.0))
}
