//! How much of a campaign runs each time: a test draws an eighth of its cases, and all of them in `cargo xtask test --all`.

/// The variable that asks for all of them.
const WHOLE: &str = "SIGNORINI_WHOLE";

/// Whether all cases are asked for.
pub fn is_whole() -> bool {
    std::env::var_os(WHOLE).is_some_and(|word| !word.is_empty())
}

/// How many of `all` cases to try: an eighth, rounded up, but where all are asked for.
pub fn cases(all: u64) -> u64 {
    if is_whole() { all } else { all.div_ceil(8) }
}

/// Some of `all`: from the first on one in `step`, or all of them where they are asked for.
pub fn some<T>(step: usize, all: impl IntoIterator<Item = T>) -> impl Iterator<Item = T> {
    all.into_iter().step_by(if is_whole() { 1 } else { step })
}
