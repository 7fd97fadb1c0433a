//! Why levels end, promises of a mesh, and the bounds that hold on it.

use std::fmt;

use super::Level;
use super::indicators::{oscillations, squares};
use crate::Solution;
use signorini_certify::cell::Cell;
use signorini_scene::error::Result;
use signorini_scene::goal::Goal;
use signorini_scene::mesh::Mesh;

/// Words for the part of f, g and q that their means leave out.
const OSCILLATION: &str = "the oscillation of data that the mesh does not resolve";

/// Why the last level is the last.
#[derive(Debug, Clone, PartialEq)]
pub enum Stop {
    /// The bound is below the goal.
    Reached,
    /// The next mesh has more unknowns than are allowed.
    TooLarge {
        /// So many.
        unknowns: usize,
        /// Number that is allowed.
        most: usize,
    },
    /// There is no finer mesh: it would have too many cells, or ones so small that rounding hides their shape.
    Finest(String),
    /// The bound no longer falls.
    Stalled {
        /// Words for its largest term.
        term: &'static str,
        /// The middle of the cell in which that is largest.
        at: [f64; 2],
    },
    /// There is no bound to go by.
    NoBound,
    /// The solver stopped before its tolerance.
    Unsolved,
    /// Whoever looks at each level asked for it.
    Interrupted,
}

impl Stop {
    /// That the bound of a level no longer falls, for most of it is its largest term, in the cell that has most of that.
    pub(super) fn stalled(level: &Level) -> Result<Self> {
        let Level { problem, solution, .. } = level;
        let bound = solution.bound.unwrap_or_default();
        let gap = (bound.duality_gap.powi(2) - bound.algebraic.powi(2)).max(0.0).sqrt();
        let terms = [
            ("the gap between s and τ, as where data jump inside cells", gap),
            (OSCILLATION, 2.0 * bound.oscillation),
            ("rounding", bound.rounding),
            ("what the solver left unfinished", bound.algebraic),
        ];
        let (term, _) = terms.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or(terms[0]);
        let of_cells = match term == OSCILLATION {
            true => oscillations(problem)?,
            false => squares(problem, solution)?,
        };
        let largest = (0..of_cells.len()).max_by(|&a, &b| of_cells[a].total_cmp(&of_cells[b]));
        let at = Cell::of(problem, largest.unwrap_or(0)).middle();
        Ok(Self::Stalled { term, at })
    }

    /// Reason in words why the levels ended with this solution; `None` where that is the goal.
    pub fn why(&self, solution: &Solution) -> Option<String> {
        const ABOVE: &str = "the error bound is above what was asked for";
        Some(match self {
            Self::Reached => return None,
            Self::TooLarge { unknowns, most } => {
                format!(
                    "{ABOVE}: the next mesh has {unknowns} unknowns, more than the {most} that are allowed"
                )
            }
            Self::Finest(why) => format!("{ABOVE}: there is no finer mesh, {why}"),
            Self::Stalled { term, at: [x, y] } => {
                format!("{ABOVE}, and no longer falls: most of it is {term}, near ({x:.6}, {y:.6})")
            }
            Self::NoBound => {
                let reason =
                    solution.no_bound.as_ref().map_or_else(String::new, ToString::to_string);
                format!("nothing says where to refine: {reason}")
            }
            Self::Unsolved => "the solver stopped before its tolerance".to_owned(),
            Self::Interrupted => {
                format!("{ABOVE}: interrupted, and these are the files of the last level")
            }
        })
    }
}

/// Which cells of a mesh are refined while its bound is too large.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refining {
    /// Cells that hold most of it; all where that brings little.
    Marked,
    /// All.
    Everywhere,
}

/// Promise that a mesh is to keep for all inputs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Promised {
    /// Largest bound that is allowed.
    pub goal: Goal,
    /// How it is to get there.
    pub refining: Refining,
    /// No refined mesh with more unknowns is tried.
    pub most_unknowns: usize,
}

/// The mesh that a setting asks for.
#[derive(Debug)]
pub struct MeshOfScene {
    /// The mesh.
    pub mesh: Mesh,
    /// Promise that holds on it, where the setting has an `error`.
    pub promise: Option<Promise>,
}

/// That the bound is small enough for all inputs tried.
#[derive(Debug, Clone, PartialEq)]
pub struct Promise {
    /// Largest bound that it states.
    pub goal: Goal,
    /// The largest bound over what it was to be.
    pub largest: f64,
    /// Unknowns of the mesh.
    pub unknowns: usize,
    /// For all inputs tried, what the bound may be; the inputs are empty where the scene has none.
    pub allowed: Vec<Allowed>,
}

/// Bound that is allowed for some inputs.
#[derive(Debug, Clone, PartialEq)]
pub struct Allowed {
    /// Values of the inputs.
    pub inputs: Vec<f64>,
    /// In the unit of ‖A^½∇u‖.
    pub bound: f64,
}

impl fmt::Display for Promise {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let Self { goal, largest, unknowns, allowed } = self;
        let part = 100.0 * largest;
        write!(to, "the mesh was refined to {unknowns} unknowns: ")?;
        match allowed.len() {
            1 => {
                write!(to, "the error bound is {part:.0} % of the {goal} that setting.error allows")
            }
            inputs => write!(
                to,
                "for all {inputs} inputs tried, corners of the ranges among them, the error bound is at most {part:.0} % of the \
                 {goal} that setting.error allows"
            ),
        }
    }
}
