//! The meshes on which intervals are worked out.

use signorini_problem::Problem;
use signorini_solve::MOST_FACTORED;

/// Unknowns up to which a solution has intervals where nobody says whether.
pub const MOST_BY_DEFAULT: usize = 2_500_000;

/// The meshes on which intervals are worked out: each takes some solutions of a linear problem.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Coverage {
    /// On meshes of up to [`MOST_BY_DEFAULT`] unknowns, as for one solution.
    #[default]
    Usual,
    /// On meshes of up to [`MOST_FACTORED`] unknowns, as for one solution after another: one factor serves them all.
    Factored,
    /// On every mesh.
    All,
    /// On none.
    None,
}

impl Coverage {
    /// Whether this problem is among them.
    pub fn takes(self, problem: &Problem) -> bool {
        let unknowns = problem.topology.counts.unknowns();
        match self {
            Self::Usual => unknowns <= MOST_BY_DEFAULT,
            Self::Factored => unknowns <= MOST_FACTORED,
            Self::All => true,
            Self::None => false,
        }
    }
}

/// Why a problem without a solver has none.
pub(crate) fn reason(problem: &Problem) -> String {
    if Coverage::Factored.takes(problem) {
        "its linear problem has no factor".to_owned()
    } else if Coverage::Usual.takes(problem) {
        format!(
            "the mesh has more than {MOST_FACTORED} unknowns, too many for each tick; `solve` works them out"
        )
    } else {
        format!(
            "the mesh has more than {MOST_BY_DEFAULT} unknowns; `solve --intervals` works them out"
        )
    }
}
