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

    pub fn name(self) -> &'static str {
        match self {
            Self::Correct => "correct",
            Self::CertifiedPoor => "certified-poor",
            Self::TypedError => "typed-error",
            Self::Wrong => "wrong",
        }
    }
}

/// How a case ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Ended {
    Refused(String),
    /// The input was refused after sweeps had been spent on it.
    RefusedLate(String),
    Failed(String),
    Panicked,
    TimedOut,
    Answered {
        success: bool,
        status: &'static str,
        measured: Measured,
    },
}

impl From<RecvTimeoutError> for Ended {
    fn from(lost: RecvTimeoutError) -> Self {
        match lost {
            RecvTimeoutError::Timeout => Self::TimedOut,
            RecvTimeoutError::Disconnected => Self::Panicked,
        }
    }
}

impl From<Error> for Ended {
    fn from(error: Error) -> Self {
        match error {
            Error::Input(error) if error.message().starts_with("not-finite") => {
                Self::RefusedLate(error.message().to_owned())
            }
            Error::Input(error) => Self::Refused(error.message().to_owned()),
            error => Self::Failed(error.to_string()),
        }
    }
}

/// A ratio, 0 of nothing; none where it is not finite.
pub fn ratio(part: f64, whole: f64) -> Option<f64> {
    let ratio = if part == 0.0 { 0.0 } else { part / whole };
    ratio.is_finite().then_some(ratio)
}

/// The outcome and, unless it is correct, why.
pub fn judge(ended: &Ended, scalar: ScalarKind) -> (Outcome, String) {
    match ended {
        Ended::Refused(message) => (Outcome::TypedError, message.clone()),
        Ended::RefusedLate(message) => {
            (Outcome::Wrong, format!("refused after the work was done: {message}"))
        }
        Ended::Failed(message) => (Outcome::Wrong, message.clone()),
        Ended::Panicked => (Outcome::Wrong, "panicked".to_owned()),
        Ended::TimedOut => (Outcome::Wrong, "did not end in time".to_owned()),
        Ended::Answered { measured, .. } if !measured.finite => {
            (Outcome::Wrong, "a number is not finite".to_owned())
        }
        Ended::Answered { success, status, measured } => match measured.bound {
            Some(bound) => certified(*success, status, bound, measured, scalar),
            None => uncertified(*success, status, measured, scalar),
        },
    }
}

fn certified(
    success: bool,
    status: &str,
    bound: f64,
    measured: &Measured,
    scalar: ScalarKind,
) -> (Outcome, String) {
    if measured.error - measured.uncertain > bound * (1.0 + INTEGRATED) {
        let ratio = measured.error / bound;
        return (Outcome::Wrong, format!("the true error is {ratio:.3e} of the bound"));
    }
    let Some(reference) = measured.reference else {
        return (Outcome::CertifiedPoor, "no exact discrete solution to compare with".to_owned());
    };
    if !success {
        return (Outcome::CertifiedPoor, format!("status {status}"));
    }
    let best = reference.bound.unwrap_or(0.0);
    if bound > (USEFUL * best).max(digits(scalar) * reference.energy) {
        let text = format!("the bound is {:.3e} of the exact discrete solution's", bound / best);
        return (Outcome::CertifiedPoor, text);
    }
    if bound > reference.energy {
        let text = format!("the bound is {:.3e} of the solution", bound / reference.energy);
        return (Outcome::CertifiedPoor, text);
    }
    (Outcome::Correct, String::new())
}

fn uncertified(
    success: bool,
    status: &str,
    measured: &Measured,
    scalar: ScalarKind,
) -> (Outcome, String) {
    let far = |reference: Reference| {
        let allowed = (FAR * reference.error).max(digits(scalar) * reference.energy);
        (measured.error > allowed).then(|| measured.error / reference.error)
    };
    match measured.reference.and_then(far) {
        Some(ratio) if success => {
            let text = format!(
                "no bound, status {status}, and {ratio:.3e} times the error of the exact discrete solution"
            );
            (Outcome::Wrong, text)
        }
        _ => (Outcome::CertifiedPoor, format!("no bound, status {status}")),
    }
}

fn digits(scalar: ScalarKind) -> f64 {
    DIGITS[usize::from(scalar == ScalarKind::F32)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answered(success: bool, measured: Measured) -> Ended {
        Ended::Answered { success, status: "converged", measured }
    }

    /// Energy 1; the exact discrete solution has a bound of 0.1.
    fn measured(bound: Option<f64>, error: f64) -> Measured {
        let reference = Reference { bound: Some(0.1), error: 0.08, energy: 1.0 };
        Measured { bound, error, reference: Some(reference), finite: true, ..Measured::default() }
    }

    fn outcome(ended: Ended) -> Outcome {
        judge(&ended, ScalarKind::F64).0
    }

    #[test]
    fn a_sharp_bound_is_correct_and_a_wide_one_poor() {
        assert_eq!(outcome(answered(true, measured(Some(0.11), 0.1))), Outcome::Correct);
        assert_eq!(outcome(answered(true, measured(Some(0.39), 0.1))), Outcome::Correct);
        assert_eq!(outcome(answered(true, measured(Some(0.41), 0.1))), Outcome::CertifiedPoor);
        assert_eq!(outcome(answered(false, measured(Some(0.11), 0.1))), Outcome::CertifiedPoor);
        let mut coarse = measured(Some(1.1), 1.0);
        coarse.reference = Some(Reference { bound: Some(1.0), error: 1.0, energy: 1.0 });
        assert_eq!(outcome(answered(true, coarse)), Outcome::CertifiedPoor);
    }

    #[test]
    fn an_error_above_its_bound_is_wrong_whatever_the_status() {
        for success in [true, false] {
            assert_eq!(outcome(answered(success, measured(Some(0.1), 0.10002))), Outcome::Wrong);
        }
        let broken = Measured { finite: false, ..measured(Some(0.1), f64::NAN) };
        assert_eq!(outcome(answered(true, broken)), Outcome::Wrong);
    }

    #[test]
    fn what_rounds_to_nothing_needs_the_digits_of_its_scalar_only() {
        let mut exact = measured(Some(1e-5), 1e-6);
        exact.reference = Some(Reference { bound: Some(1e-15), error: 1e-15, energy: 1.0 });
        let ended = answered(true, exact);
        assert_eq!(judge(&ended, ScalarKind::F32).0, Outcome::Correct);
        assert_eq!(judge(&ended, ScalarKind::F64).0, Outcome::CertifiedPoor);
    }

    #[test]
    fn without_a_bound_success_must_not_be_claimed_for_nonsense() {
        assert_eq!(outcome(answered(true, measured(None, 0.09))), Outcome::CertifiedPoor);
        assert_eq!(outcome(answered(true, measured(None, 0.9))), Outcome::Wrong);
        assert_eq!(outcome(answered(false, measured(None, 0.9))), Outcome::CertifiedPoor);
    }

    #[test]
    fn refusals_and_accidents() {
        assert_eq!(outcome(Ended::Refused("too thin".to_owned())), Outcome::TypedError);
        assert_eq!(outcome(Ended::RefusedLate("overflow".to_owned())), Outcome::Wrong);
        for ended in [Ended::Failed("disk".to_owned()), Ended::Panicked, Ended::TimedOut] {
            assert_eq!(outcome(ended), Outcome::Wrong);
        }
    }
}
