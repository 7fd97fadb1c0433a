//! Why levels end, promises of a mesh, and the bounds that hold on it.

use std::fmt;

use super::Level;
use super::dominant::{Dominant, Term};
use crate::Solution;
use signorini_scene::error::Result;
use signorini_scene::goal::Goal;
use signorini_scene::mesh::Mesh;

/// Why the last level is the last.
#[derive(Debug, Clone, PartialEq)]
pub enum Stop {
    /// The bound is below the goal.
    Reached,
    /// A part of the energy norm was asked for, which is rounding.
    Constant,
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
        /// Its largest term.
        term: Term,
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
        let Dominant { term, at, .. } = Dominant::of(&level.problem, &level.solution)?;
        Ok(Self::Stalled { term, at })
    }

    /// Whether no finer mesh is needed.
    pub fn is_success(&self) -> bool {
        matches!(self, Self::Reached | Self::Constant)
    }

    /// Reason in words why the levels ended with this solution; `None` where that is the goal.
    pub fn why(&self, solution: &Solution) -> Option<String> {
        const ABOVE: &str = "the error bound is above what was asked for";
        Some(match self {
            Self::Reached => return None,
            Self::Constant => "the solution is constant up to rounding: its error bound has no part of the energy norm".to_owned(),
            Self::TooLarge { unknowns, most } => {
                format!(
                    "{ABOVE}: the next mesh has {unknowns} unknowns, more than the {most} that are allowed"
                )
            }
            Self::Finest(why) => format!("{ABOVE}: there is no finer mesh, {why}"),
            Self::Stalled { term, at: [x, y] } => {
                let inside = if *term == Term::Gap { ", as where data jump inside cells" } else { "" };
                let words = term.words();
                format!("{ABOVE}, and no longer falls: most of it is {words}{inside}, near ({x:.6}, {y:.6})")
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
            0 => {
                write!(to, "the solution is constant up to rounding, and no part of it is promised")
            }
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
