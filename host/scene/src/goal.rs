//! How small the guaranteed error bound is to be: the `error` of a setting, `--max-error` of the command line.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// The greatest bound that is wanted.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum Goal {
    /// So much, in the unit of ‖A^½∇u‖.
    Energy(f64),
    /// This part of the energy norm (‖A^½∇s‖² + ∫_R h (s − u_ext)²)^½.
    Part(f64),
}

impl FromStr for Goal {
    type Err = String;

    /// Reads `0.01` or `5%`.
    fn from_str(text: &str) -> Result<Self, String> {
        let (number, is_part) = match text.trim().strip_suffix('%') {
            Some(number) => (number.trim_end(), true),
            None => (text.trim(), false),
        };
        match number.parse::<f64>() {
            Ok(size) if size > 0.0 && size.is_finite() => {
                Ok(if is_part { Self::Part(size / 100.0) } else { Self::Energy(size) })
            }
            _ => Err("expected a number > 0, such as 0.01, or a part such as 5%".to_owned()),
        }
    }
}

impl TryFrom<String> for Goal {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<Goal> for String {
    fn from(goal: Goal) -> Self {
        goal.to_string()
    }
}

impl fmt::Display for Goal {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Energy(most) => write!(to, "{most:?}"),
            Self::Part(part) => {
                // The percentage as it was written: a product of 100 may have other digits.
                let percent = 100.0 * part;
                let short = (1..17).map(|digits| format!("{percent:.digits$e}"));
                let is_same = |text: &String| text.parse::<f64>().is_ok_and(|x| x / 100.0 == *part);
                let text = std::iter::once(format!("{percent:.0e}")).chain(short).find(is_same);
                write!(to, "{}%", text.and_then(|text| text.parse().ok()).unwrap_or(percent))
            }
        }
    }
}

impl Goal {
    /// The bound over what it is to be at most: it meets the goal where this is at most 1. A part of no energy norm is met by 0
    /// alone.
    pub fn ratio(self, bound: f64, energy_norm: Option<f64>) -> f64 {
        let most = self.most(energy_norm);
        if bound == 0.0 && most == 0.0 && energy_norm.is_some() { 0.0 } else { bound / most }
    }

    /// The greatest bound that is wanted where the solution has this energy norm.
    pub fn most(self, energy_norm: Option<f64>) -> f64 {
        match self {
            Self::Energy(most) => most,
            Self::Part(part) => part * energy_norm.unwrap_or(0.0),
        }
    }

    /// Whether a bound meets it.
    pub fn is_met(self, bound: f64, energy_norm: Option<f64>) -> bool {
        self.ratio(bound, energy_norm) <= 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn goals_are_numbers_or_parts() {
        let parse = |text: &str| text.parse::<Goal>();
        assert_eq!(parse("1e-3"), Ok(Goal::Energy(1e-3)));
        assert_eq!(parse(" 5 % "), Ok(Goal::Part(0.05)));
        for wrong in ["", "%", "0", "-1%", "inf", "NaN", "5 %%", "one"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
        assert!(Goal::Part(0.5).is_met(1.0, Some(2.0)) && !Goal::Part(0.5).is_met(1.0, Some(1.9)));
        assert!(!Goal::Part(0.5).is_met(1.0, None) && Goal::Energy(1.0).is_met(1.0, None));
        assert!(Goal::Part(0.5).is_met(0.0, Some(0.0)) && !Goal::Part(0.5).is_met(0.0, None));
        assert!(!Goal::Part(0.5).is_met(f64::NAN, Some(1.0)));
    }

    #[test]
    fn a_goal_survives_its_text() {
        for goal in ["5%", "0.07%", "12.5%", "1e-7%", "0.01", "3", "1e-30"] {
            let read: Goal = goal.parse().expect("a goal");
            assert_eq!(read.to_string().parse(), Ok(read), "{goal}");
        }
        assert_eq!(Goal::Part(0.05).to_string(), "5%");
        assert_eq!(Goal::Part(0.07).to_string(), "7%");
        assert_eq!(Goal::Energy(0.01).to_string(), "0.01");
    }
}
