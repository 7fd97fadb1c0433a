//! The state that a session carries from tick to tick, as numbers in f64: those of a narrow scalar are exact in it.

use serde::{Deserialize, Serialize};
use signorini_problem::scalar::Scalar;
use signorini_scene::error::{InputError, Result};

/// The state of a session after a tick, by its kind.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub enum SavedSession {
    /// Of the kernel's tick.
    Tick {
        /// Means of u, one per edge.
        u: Vec<f64>,
        /// Whether a contact edge was active.
        active: Vec<bool>,
        /// ω of the next sweep.
        omega: f64,
        /// The best ω of the search and its factor; an ω of 0 is none.
        best: [f64; 2],
        /// How often ω has moved.
        moves: u32,
        /// The phase of the search.
        phase: u32,
    },
    /// Of a solve per tick.
    Solve {
        /// Means of u, one per edge; none where the next solve starts anew.
        u: Vec<f64>,
        /// Whether a contact edge was at its gap; none before the first answer, and in files of before 0.9.
        #[serde(default)]
        active: Vec<bool>,
        /// The ω that the last solve has found.
        omega: Option<f64>,
    },
    /// Of a controller that steps in time.
    Controller {
        /// The bytes of its state, as firmware has them, in hexadecimal digits.
        state: String,
    },
}

impl SavedSession {
    /// The state of a controller with these bytes.
    pub(crate) fn of_controller(bytes: &[u8]) -> Self {
        Self::Controller { state: bytes.iter().map(|byte| format!("{byte:02x}")).collect() }
    }

    /// The bytes of a controller's state.
    ///
    /// # Errors
    /// The state of another kind of session, digits that are none.
    pub(crate) fn bytes(&self) -> Result<Vec<u8>> {
        let Self::Controller { state } = self else { return self.foreign() };
        let broken = || InputError::new("session.state: expected pairs of hexadecimal digits");
        let digits: Option<Vec<u32>> = state.chars().map(|digit| digit.to_digit(16)).collect();
        let pairs = digits.filter(|digits| digits.len().is_multiple_of(2)).ok_or_else(broken)?;
        Ok(pairs.chunks_exact(2).map(|pair| (16 * pair[0] + pair[1]) as u8).collect())
    }

    /// Whether JSON has all its numbers.
    pub(crate) fn is_finite(&self) -> bool {
        match self {
            Self::Tick { u, .. } | Self::Solve { u, .. } => u.iter().all(|u| u.is_finite()),
            Self::Controller { .. } => true,
        }
    }

    /// The refusal of this state by a session of another kind.
    pub(crate) fn foreign<T>(&self) -> Result<T> {
        let own = match self {
            Self::Tick { .. } => "certified sweeps",
            Self::Solve { .. } => "solves to a tolerance",
            Self::Controller { .. } => "the controller that `bake` writes",
        };
        let message = format!("session: the state is one of {own}, and these ticks are not");
        let hint = "give --tolerance and --baked, or leave them out, as in the run before";
        Err(InputError::new(message).hint(hint).into())
    }
}

/// The numbers of a state, `length` of them, in the scalar that they were widened from.
///
/// # Errors
/// More or less of them, or one that is none of this scalar; with the `name` in the state.
pub(crate) fn narrowed<R: Scalar>(name: &str, numbers: &[f64], length: usize) -> Result<Vec<R>> {
    check_length(name, numbers.len(), length)?;
    let narrow = |&wide: &f64| match R::narrow(wide) {
        number if number.wide() == wide => Ok(number),
        _ => Err(InputError::new(format!("{name}: {wide} is no number of {}", R::NAME)).into()),
    };
    numbers.iter().map(narrow).collect()
}

/// Refuses a part of a state that has another length than the mesh asks for.
pub(crate) fn check_length(name: &str, found: usize, expected: usize) -> Result<()> {
    if found == expected {
        return Ok(());
    }
    let message = format!("{name}: {found} numbers, expected {expected}");
    Err(InputError::new(message).into())
}
