//! How small the bound is to be.

use super::Level;

/// What the bound is to be at most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Goal {
    /// So much, in the unit of ‖A^½∇u‖.
    Energy(f64),
    /// This part of the energy norm ‖A^½∇s‖.
    Part(f64),
}

impl Goal {
    /// Reads `0.01` or `5%`.
    ///
    /// # Errors
    /// What was expected.
    pub fn parse(text: &str) -> Result<Self, String> {
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

    /// Whether a bound meets it. A part of no energy norm is met by 0 alone.
    pub fn is_met(self, bound: f64, energy_norm: Option<f64>) -> bool {
        match self {
            Self::Energy(most) => bound <= most,
            Self::Part(part) => energy_norm.is_some_and(|norm| bound <= part * norm),
        }
    }

    /// What the bound of this level would have to be.
    pub(super) fn of(self, level: &Level) -> f64 {
        match self {
            Self::Energy(most) => most,
            Self::Part(part) => part * level.energy_norm.unwrap_or(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn goals_are_numbers_or_parts() {
        assert_eq!(Goal::parse("1e-3"), Ok(Goal::Energy(1e-3)));
        assert_eq!(Goal::parse(" 5 % "), Ok(Goal::Part(0.05)));
        for wrong in ["", "%", "0", "-1%", "inf", "NaN", "5 %%", "one"] {
            assert!(Goal::parse(wrong).is_err(), "{wrong}");
        }
        assert!(Goal::Part(0.5).is_met(1.0, Some(2.0)) && !Goal::Part(0.5).is_met(1.0, Some(1.9)));
        assert!(!Goal::Part(0.5).is_met(1.0, None) && Goal::Energy(1.0).is_met(1.0, None));
    }
}
