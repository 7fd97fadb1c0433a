//! Solver that was used in the end, in the words of the terminal and `summary.json`.

use serde::{Serialize, Serializer};

use super::{Factored, ScalarKind, Solution};

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
            Self::Sweeps | Self::Factor | Self::Direct => scalar,
        }
    }

    /// `solver_used` in `summary.json`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sweeps => "kernel sweeps",
            Self::Factor => "kernel factor",
            Self::Direct => "direct",
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
            Ran::Factor => format!("by a factor of {entries} entries, {exchanges} exchanges"),
            Ran::Direct => format!("by the direct solver, {exchanges} active-set steps"),
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
}

impl Serialize for Ran {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}
