//! A bound on a deviation with its reason, and the comparisons that use it.

use std::fmt::Display;

use crate::seen;

/// A bound on a deviation, and why it is what it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Its path, `kernel::PATCH`.
    pub path: &'static str,
    /// What is compared.
    pub name: &'static str,
    /// The largest deviation allowed.
    pub value: f64,
    /// The largest deviation of a longer run than `cargo xtask test`; 0 where there was none.
    pub worst: f64,
    /// Where the value comes from.
    pub reason: &'static str,
}

impl Tolerance {
    /// Panics, naming the entry and `what`, unless `deviation` is a number of at most `value`.
    #[track_caller]
    pub fn check(&self, what: impl Display, deviation: impl Into<f64>) {
        let Self { name, value, reason, .. } = self;
        let deviation = deviation.into().abs();
        seen::record(self, deviation);
        assert!(
            deviation <= *value,
            "{what}: {name} is off by {deviation:e}, allowed {value:e} ({reason})"
        );
    }

    /// Checks a difference relative to `size`; where both are 0, nothing is off.
    #[track_caller]
    pub fn check_over(&self, what: impl Display, difference: impl Into<f64>, size: impl Into<f64>) {
        let (difference, size) = (difference.into(), size.into());
        self.check(what, if difference == 0.0 { 0.0 } else { difference / size });
    }

    /// Checks the deviation of `measured` relative to `expected`.
    #[track_caller]
    pub fn check_relative(
        &self,
        what: impl Display,
        measured: impl Into<f64>,
        expected: impl Into<f64>,
    ) {
        let (measured, expected) = (measured.into(), expected.into());
        let what = format!("{what}: {measured:e} instead of {expected:e}");
        self.check_over(what, measured - expected, expected);
    }

    /// Checks how far `measured` lies above `most`, relative to it.
    #[track_caller]
    pub fn check_at_most(
        &self,
        what: impl Display,
        measured: impl Into<f64>,
        most: impl Into<f64>,
    ) {
        let (measured, most) = (measured.into(), most.into());
        let what = format!("{what}: {measured:e}, at most {most:e}");
        self.check(what, if measured <= most { 0.0 } else { (measured - most) / measured });
    }

    /// Checks the largest difference between two rows of numbers.
    #[track_caller]
    pub fn check_each<R: Into<f64> + Copy>(&self, what: impl Display, found: &[R], expected: &[R]) {
        assert_eq!(found.len(), expected.len(), "{what}");
        for (at, (&found, &expected)) in found.iter().zip(expected).enumerate() {
            let (found, expected) = (found.into(), expected.into());
            let what = format_args!("{what}, at {at}: {found:e} instead of {expected:e}");
            self.check(what, found - expected);
        }
    }
}

/// Declares each entry as a constant and lists them all in `TABLE`.
macro_rules! table {
    ($($constant:ident: $name:literal, $value:literal $(worst $worst:literal)?, $reason:literal;)*) => {
        $(
            #[doc = concat!("The bound on ", $name, ": ", $reason, ".")]
            pub const $constant: $crate::Tolerance = $crate::Tolerance {
                path: concat!(module_path!(), "::", stringify!($constant)),
                name: $name,
                value: $value,
                worst: 0.0 $(+ $worst)?,
                reason: $reason,
            };
        )*
        /// Every entry.
        pub const TABLE: &[$crate::Tolerance] = &[$($constant),*];
    };
}

#[cfg(test)]
mod tests {
    use super::Tolerance;

    const TENTH: Tolerance =
        Tolerance { path: "", name: "a number", value: 0.125, worst: 0.0, reason: "an example" };

    #[test]
    fn deviations_up_to_the_value_pass() {
        TENTH.check("above", 0.125);
        TENTH.check("below, in f32", -0.125_f32);
        TENTH.check_over("nothing of nothing", 0.0, 0.0);
        TENTH.check_relative("of a negative number", -9.0, -8.0);
        TENTH.check_at_most("far below", 1.0, 100.0);
        TENTH.check_each("two rows", &[1.0, 2.0], &[1.125, 1.875]);
    }

    #[test]
    #[should_panic(expected = "a row, at 1: 2e0 instead of 3e0: a number is off by 1e0")]
    fn a_deviation_is_told_with_its_place() {
        TENTH.check_each("a row", &[1.0, 2.0], &[1.0, 3.0]);
    }

    #[test]
    #[should_panic(expected = "instead of")]
    fn not_a_number_is_never_within_a_tolerance() {
        TENTH.check_relative("a failed solve", f64::NAN, 1.0);
    }

    #[test]
    #[should_panic(expected = "at most")]
    fn not_a_number_is_never_at_most_another() {
        TENTH.check_at_most("a failed bound", 1.0, f64::NAN);
    }
}
