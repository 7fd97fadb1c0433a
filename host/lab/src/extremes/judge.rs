//! The worth of an answer.
//!
//! | outcome | means |
//! |---|---|
//! | correct | success is claimed; the true error is at most the bound; and the bound is useful |
//! | certified-poor | the true error is at most the bound, which is not useful, or no success is claimed; or there is no bound, which the answer says, and the error is no reason for a complaint |
//! | typed-error | the input was refused before work began (exit status 2), with a message |
//! | wrong | an error above its bound; a number that is not finite; success claimed for an answer without a bound that is far off; a refusal after work; a panic; no end |
//!
//! Useful: not above [`USEFUL`] times the bound that the exact discrete solution gets (or what the scalar's
//! digits make of the energy norm, where that is more), and not above the energy norm itself.

use std::sync::mpsc::RecvTimeoutError;

use serde::{Deserialize, Serialize};

use super::measure::{Measured, Reference};
use crate::record_file::word;
use signorini_scene::Error;
use signorini_solve::ScalarKind;

/// A bound is useful up to this multiple of what the exact discrete solution gets.
pub const USEFUL: f64 = 4.0;
/// Slack for error ≤ bound: 8 points per edge and 16×16 per cell leave so much of data and gradients that have a kink or
/// are singular inside (2e−5 was the most seen, at κ = 10⁻⁶).
pub const INTEGRATED: f64 = 1e-4;
/// Errors below this part of the energy norm are digits of the scalar, in f64 and f32.
pub const DIGITS: [f64; 2] = [1e-10, 1e-4];
/// Success may be claimed without a bound up to this multiple of the exact discrete solution's error.
pub const FAR: f64 = 4.0;

/// The worth of an answer.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// Within [`USEFUL`] of the best that the grid allows, and certified.
    Correct,
    /// Guaranteed, or without a bound and saying so, but not as good as it could be.
    CertifiedPoor,
    TypedError,
    #[default]
    Wrong,
}

impl Outcome {
    /// All, the best first.
    pub const ALL: [Self; 4] = [Self::Correct, Self::CertifiedPoor, Self::TypedError, Self::Wrong];
}

/// How many cases ended in which way, in words.
pub fn counts(count: impl Fn(Outcome) -> usize) -> String {
    Outcome::ALL.map(|of| format!("{} {}", count(of), word(&of))).join(", ")
}

/// The outcome and, unless it is correct, why.
pub type Verdict = (Outcome, String);

/// An attempt that panicked or never ended.
pub fn lost(lost: RecvTimeoutError) -> Verdict {
    let why = match lost {
        RecvTimeoutError::Timeout => "did not end in time",
        RecvTimeoutError::Disconnected => "panicked",
    };
    (Outcome::Wrong, why.to_owned())
}

/// An attempt that ended with an error.
pub fn failed(error: Error) -> Verdict {
    match error {
        // Sweeps had been spent on it.
        Error::Input(error) if error.message().starts_with("not-finite") => {
            (Outcome::Wrong, format!("refused after the work was done: {}", error.message()))
        }
        Error::Input(error) => (Outcome::TypedError, error.message().to_owned()),
        error => (Outcome::Wrong, error.to_string()),
    }
}

/// A ratio, 0 of nothing; none where it is not finite.
pub fn ratio(part: f64, whole: f64) -> Option<f64> {
    let ratio = if part == 0.0 { 0.0 } else { part / whole };
    ratio.is_finite().then_some(ratio)
}

/// An answer, how it ended, and how wrong it is.
#[derive(Debug, Clone, Copy)]
pub struct Answered {
    /// Whether success is claimed.
    pub success: bool,
    pub status: &'static str,
    pub scalar: ScalarKind,
    pub measured: Measured,
}

impl Answered {
    pub fn verdict(&self) -> Verdict {
        match self.measured.bound {
            _ if !self.measured.finite => (Outcome::Wrong, "a number is not finite".to_owned()),
            Some(bound) => self.certified(bound),
            None => self.uncertified(),
        }
    }

    fn certified(&self, bound: f64) -> Verdict {
        let Measured { error, uncertain, reference, .. } = self.measured;
        if error - uncertain > bound * (1.0 + INTEGRATED) {
            let ratio = error / bound;
            return (Outcome::Wrong, format!("the true error is {ratio:.3e} of the bound"));
        }
        let Some(reference) = reference else {
            let why = "no exact discrete solution to compare with";
            return (Outcome::CertifiedPoor, why.to_owned());
        };
        let best = reference.bound.unwrap_or(0.0);
        let useful = (USEFUL * best).max(self.digits() * reference.energy);
        let why = match self.status {
            status if !self.success => format!("status {status}"),
            _ if bound > useful => {
                format!("the bound is {:.3e} of the exact discrete solution's", bound / best)
            }
            _ if bound > reference.energy => {
                format!("the bound is {:.3e} of the solution", bound / reference.energy)
            }
            _ => return (Outcome::Correct, String::new()),
        };
        (Outcome::CertifiedPoor, why)
    }

    fn uncertified(&self) -> Verdict {
        let Self { success, status, measured, .. } = self;
        let far = |reference: Reference| {
            let allowed = (FAR * reference.error).max(self.digits() * reference.energy);
            (measured.error > allowed).then(|| measured.error / reference.error)
        };
        match measured.reference.and_then(far) {
            Some(ratio) if *success => {
                let text = format!(
                    "no bound, status {status}, and {ratio:.3e} times the error of the exact discrete solution"
                );
                (Outcome::Wrong, text)
            }
            _ => (Outcome::CertifiedPoor, format!("no bound, status {status}")),
        }
    }

    fn digits(&self) -> f64 {
        DIGITS[usize::from(self.scalar == ScalarKind::F32)]
    }
}

#[cfg(test)]
mod tests {
    use super::Outcome::{CertifiedPoor, Correct, TypedError, Wrong};
    use super::*;
    use signorini_scene::InputError;

    /// The outcome of such an answer in f64; of energy 1, and of the bound and the error of the exact discrete solution.
    fn outcome(success: bool, bound: Option<f64>, error: f64, best: [f64; 2]) -> Outcome {
        judged(success, bound, error, best, ScalarKind::F64)
    }

    fn judged(
        success: bool,
        bound: Option<f64>,
        error: f64,
        [best, least]: [f64; 2],
        scalar: ScalarKind,
    ) -> Outcome {
        let reference = Some(Reference { bound: Some(best), error: least, energy: 1.0 });
        let finite = error.is_finite();
        let measured = Measured { bound, error, reference, finite, ..Measured::default() };
        Answered { success, status: "converged", scalar, measured }.verdict().0
    }

    const BEST: [f64; 2] = [0.1, 0.08];

    #[test]
    fn a_sharp_bound_is_correct_and_a_wide_one_poor() {
        assert_eq!(outcome(true, Some(0.11), 0.1, BEST), Correct);
        assert_eq!(outcome(true, Some(0.39), 0.1, BEST), Correct);
        assert_eq!(outcome(true, Some(0.41), 0.1, BEST), CertifiedPoor);
        assert_eq!(outcome(false, Some(0.11), 0.1, BEST), CertifiedPoor);
        assert_eq!(outcome(true, Some(1.1), 1.0, [1.0; 2]), CertifiedPoor, "a coarse grid");
    }

    #[test]
    fn an_error_above_its_bound_is_wrong_whatever_the_status() {
        for success in [true, false] {
            assert_eq!(outcome(success, Some(0.1), 0.10002, BEST), Wrong);
        }
        assert_eq!(outcome(true, Some(0.1), f64::NAN, BEST), Wrong);
    }

    #[test]
    fn what_rounds_to_nothing_needs_the_digits_of_its_scalar_only() {
        for (scalar, expected) in [(ScalarKind::F32, Correct), (ScalarKind::F64, CertifiedPoor)] {
            assert_eq!(judged(true, Some(1e-5), 1e-6, [1e-15; 2], scalar), expected);
        }
    }

    #[test]
    fn without_a_bound_success_must_not_be_claimed_for_nonsense() {
        assert_eq!(outcome(true, None, 0.09, BEST), CertifiedPoor);
        assert_eq!(outcome(true, None, 0.9, BEST), Wrong);
        assert_eq!(outcome(false, None, 0.9, BEST), CertifiedPoor);
    }

    #[test]
    fn refusals_and_accidents() {
        let refused = |message: &str| failed(InputError::new(message).into()).0;
        assert_eq!(refused("too thin"), TypedError);
        assert_eq!(refused("not-finite: overflow"), Wrong);
        assert_eq!(failed(Error::Check("disk".to_owned())).0, Wrong);
        for why in [RecvTimeoutError::Timeout, RecvTimeoutError::Disconnected] {
            assert_eq!(lost(why).0, Wrong);
        }
    }
}
