//! How an answer came to its end, whatever gave it (the kernel's solver or one of its ticks), and which solver was used in
//! the end: in the words of the terminal and `summary.json`.

use std::sync::LazyLock;

use serde::{Serialize, Serializer};
use signorini_device::codes::{Refusal, refusal};
use signorini_kernel::report::Ended;
use signorini_kernel::solver::Status;

use signorini_scene::error::Error;

use super::{Factored, Multigrid, ScalarKind, Solution};

/// How an answer came to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// A solve to a tolerance.
    Solve(Status),
    /// A tick within its limits.
    Tick(Ended),
    /// A tick that has no answer.
    Refused(Refusal),
    /// No tick: where steps in time begin.
    Start,
}

/// Before any work.
impl Default for Ending {
    fn default() -> Self {
        Self::Tick(Ended::OutOfSweeps)
    }
}

impl Ending {
    /// The end of a tick that was refused with this error, where it was the kernel that did.
    pub fn refused(error: &Error) -> Option<Self> {
        error.cause().map(|cause| Self::Refused(refusal(&cause).0))
    }

    /// The answer is as good as was asked for, or as rounding allows.
    pub fn is_success(self) -> bool {
        went_well(self.of_solve())
    }

    /// The iterate is no answer; one that a budget cut off is.
    pub fn is_breakdown(self) -> bool {
        matches!(self.of_solve(), Status::Stalled | Status::NotFinite)
    }

    /// The status that a solve with this end has.
    pub fn of_solve(self) -> Status {
        match self {
            Self::Solve(status) => status,
            Self::Tick(Ended::Exact | Ended::Accurate | Ended::Settled) | Self::Start => {
                Status::Converged
            }
            Self::Tick(Ended::OutOfSweeps | Ended::OutOfTime) => Status::OutOfSweeps,
            Self::Tick(Ended::NotFinite) | Self::Refused(_) => Status::NotFinite,
        }
    }

    /// The word for it in `summary.json` and `ticks.csv`: of a tick that of its code, `out-of-sweeps` for `OUT_OF_SWEEPS`.
    pub fn name(self) -> &'static str {
        static WORDS: LazyLock<Vec<String>> = LazyLock::new(|| {
            let words = Ended::CODES.iter().map(|code| code.word.to_string_lossy());
            words.map(|word| word.to_lowercase().replace('_', "-")).collect()
        });
        match self {
            Self::Solve(status) => status_name(status),
            // Codes count up from 0.
            Self::Tick(ended) => WORDS.get(ended.code() as usize).map_or("unknown", String::as_str),
            Self::Refused(Refusal::NoSolution) => "no-solution",
            Self::Refused(Refusal::NotUnique) => "not-unique",
            Self::Refused(Refusal::EmptyRange) => "empty-range",
            Self::Refused(Refusal::Excluded) => "excluded",
            Self::Refused(Refusal::ForeignState) => "foreign-state",
            Self::Refused(Refusal::DamagedState) => "damaged-state",
            // What a scene's data or its scalar do not allow for.
            Self::Refused(_) => "not-finite",
            Self::Start => "start",
        }
    }
}

/// Whether the answer of a solve that ended so is as good as was asked for, or as rounding allows.
pub fn went_well(status: Status) -> bool {
    matches!(status, Status::Converged | Status::RoundingLimit)
}

/// The word for the status of a solve.
pub fn status_name(status: Status) -> &'static str {
    match status {
        Status::Converged => "converged",
        Status::RoundingLimit => "rounding-limit",
        Status::OutOfSweeps => "out-of-sweeps",
        Status::Stalled => "stalled",
        Status::NotFinite => "not-finite",
    }
}

/// Which method the answer comes from.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Ran {
    /// The kernel's sweeps.
    #[default]
    Sweeps,
    /// The kernel's factor, or that of a controller.
    Factor,
    /// The host's active set on a factor of its own.
    Direct,
    /// The host's active set by conjugate gradients and multigrid.
    Multigrid,
    /// Exchanges on a condensed model.
    CondensedExact,
    /// Sweeps on a condensed model.
    CondensedSweeps,
    /// A condensed model without contact: nothing was to be solved.
    CondensedLinear,
}

impl Ran {
    /// Scalar of u on the whole mesh, for a solve in `scalar`: f64 where it was recovered from a condensed answer.
    pub fn scalar_of_u(self, scalar: ScalarKind) -> ScalarKind {
        match self {
            Self::CondensedExact | Self::CondensedSweeps | Self::CondensedLinear => ScalarKind::F64,
            Self::Sweeps | Self::Factor | Self::Direct | Self::Multigrid => scalar,
        }
    }

    /// `solver_used` in `summary.json`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sweeps => "kernel sweeps",
            Self::Factor => "kernel factor",
            Self::Direct => "direct",
            Self::Multigrid => "multigrid",
            Self::CondensedExact => "condensed exact",
            Self::CondensedSweeps => "condensed sweeps",
            Self::CondensedLinear => "condensed linear",
        }
    }
}

impl Solution {
    /// How the solve ended and what solved it, in a line.
    pub fn ending(&self) -> String {
        let (status, residual) = (self.status.name(), self.algebraic_residual);
        let Factored { entries, exchanges, .. } =
            self.factored.unwrap_or(Factored { entries: 0, exchanges: 0, rounds: 0 });
        let how = match self.ran {
            Ran::Sweeps => format!("after {} sweeps", self.sweeps),
            Ran::Factor => format!(
                "by elimination, {entries} entries in the factor, {exchanges} changes of the contact set"
            ),
            Ran::Direct => format!("by the direct solver, {exchanges} active-set steps"),
            Ran::Multigrid => self.multigrid_work(),
            Ran::CondensedExact => "by exchanges on the condensed model".to_owned(),
            Ran::CondensedSweeps => format!("after {} sweeps on the condensed model", self.sweeps),
            Ran::CondensedLinear => "on the condensed model, which has no contact".to_owned(),
        };
        let dropped = match (self.ran, self.sweeps) {
            (Ran::Factor, sweeps @ 1..) => format!("; {sweeps} sweeps before it were given up"),
            _ => String::new(),
        };
        format!("{status} {how}, scaled residual {residual:.1e}{dropped}")
    }

    fn multigrid_work(&self) -> String {
        let Multigrid { iterations, sets, .. } = self.multigrid.unwrap_or_default();
        format!("by multigrid, {iterations} iterations on {sets} active sets")
    }
}

impl Serialize for Ran {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Scripts read these words.
    #[test]
    fn words_of_ticks_are_those_of_their_codes() {
        let words = [
            (Ended::Exact, "exact"),
            (Ended::Accurate, "accurate"),
            (Ended::Settled, "settled"),
            (Ended::OutOfSweeps, "out-of-sweeps"),
            (Ended::OutOfTime, "out-of-time"),
            (Ended::NotFinite, "not-finite"),
        ];
        for (ended, word) in words {
            assert_eq!(Ending::Tick(ended).name(), word);
        }
        assert_eq!(words.len(), Ended::CODES.len());
    }
}
