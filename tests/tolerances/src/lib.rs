//! The one tolerance table: every comparison of the tests takes its bound from here by name.
//!
//! ```text
//! tolerance: a bound, its reason, and the comparisons ─► seen: the largest deviation of each, for `cargo xtask test`
//! kernel, scene, draw, solve, bake, lab, command: entries of the crate whose tests use them
//! twins: entries of the crate `tests`
//! ```
//!
//! A tolerance that is far looser than what is seen hides errors. So each comparison says how far it was off, and
//! `cargo xtask test` fails for an entry whose value is more than a hundred times that, or that nothing uses. Where
//! two numbers agree exactly, compare them with `assert_eq!`.
//!
//! This crate depends on nothing, so that the kernel's tests can use it like all others.

#[macro_use]
mod tolerance;
mod draws;
mod seen;

pub mod bake;
pub mod command;
pub mod draw;
pub mod kernel;
pub mod lab;
pub mod scene;
pub mod solve;
pub mod twins;

pub use draws::{cases, is_whole, some};
pub use tolerance::Tolerance;

/// The entries of all crates.
pub const TABLES: [&[Tolerance]; 8] = [
    kernel::TABLE,
    scene::TABLE,
    draw::TABLE,
    solve::TABLE,
    bake::TABLE,
    lab::TABLE,
    command::TABLE,
    twins::TABLE,
];

#[cfg(test)]
mod tests {
    use super::{TABLES, seen};

    /// Every entry is announced as well, so that one without a comparison is found.
    #[test]
    fn entries_have_distinct_names_positive_values_and_reasons() {
        let all = TABLES.concat();
        let mut names: Vec<_> = all.iter().map(|entry| entry.name).collect();
        names.sort_unstable();
        let twice = names.windows(2).find(|pair| pair[0] == pair[1]);
        assert_eq!(twice, None);
        for entry in &all {
            assert!(entry.value > 0.0 && entry.worst <= entry.value, "{entry:?}");
            assert!(!entry.name.is_empty() && !entry.reason.is_empty(), "{entry:?}");
            seen::record(entry, 0.0);
        }
    }
}
