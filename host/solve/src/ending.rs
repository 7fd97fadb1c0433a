//! How an answer came to its end, whatever gave it: the kernel's solver or one of its ticks.

use signorini_kernel::report::Ended;
use signorini_kernel::solver::Status;

/// How an answer came to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// A solve to a tolerance.
    Solve(Status),
    /// A tick within its limits.
    Tick(Ended),
}

/// Before any work.
impl Default for Ending {
    fn default() -> Self {
        Self::Tick(Ended::OutOfSweeps)
    }
}

impl Ending {
    /// The answer is as good as was asked for, or as rounding allows.
    pub fn is_success(self) -> bool {
        matches!(self.of_solve(), Status::Converged | Status::RoundingLimit)
    }

    /// The iterate is no answer; one that a budget cut off is.
    pub fn is_breakdown(self) -> bool {
        matches!(self.of_solve(), Status::Stalled | Status::NotFinite)
    }

    /// The status that a solve with this end has.
    pub fn of_solve(self) -> Status {
        match self {
            Self::Solve(status) => status,
            Self::Tick(Ended::Exact | Ended::Accurate | Ended::Settled) => Status::Converged,
            Self::Tick(Ended::OutOfSweeps | Ended::OutOfTime) => Status::OutOfSweeps,
            Self::Tick(Ended::NotFinite) => Status::NotFinite,
        }
    }

    /// The word for it in `summary.json` and `ticks.csv`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solve(status) => status_name(status),
            Self::Tick(Ended::Exact) => "exact",
            Self::Tick(Ended::Accurate) => "accurate",
            Self::Tick(Ended::Settled) => "settled",
            Self::Tick(Ended::OutOfSweeps) => "out-of-sweeps",
            Self::Tick(Ended::OutOfTime) => "out-of-time",
            Self::Tick(Ended::NotFinite) => "not-finite",
        }
    }
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
