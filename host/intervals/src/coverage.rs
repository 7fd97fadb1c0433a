//! The meshes on which intervals are worked out.

use signorini_problem::Problem;
use signorini_solve::MOST_FACTORED;

/// The meshes on which intervals are worked out: each takes some solutions of a linear problem.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Coverage {
    /// On meshes of up to [`MOST_FACTORED`] unknowns: one factor serves all outputs.
    #[default]
    Small,
    /// On every mesh.
    All,
    /// On none.
    None,
}

impl Coverage {
    /// Whether this problem is among them.
    pub fn takes(self, problem: &Problem) -> bool {
        match self {
            Self::Small => problem.topology.counts.unknowns() <= MOST_FACTORED,
            Self::All => true,
            Self::None => false,
        }
    }
}

/// Why a large mesh has none.
pub(crate) fn too_many() -> String {
    format!("the mesh has more than {MOST_FACTORED} unknowns; `solve --intervals` works them out")
}
