//! Promises of a mesh, and the bounds that hold on it.

use std::fmt;

use signorini_scene::goal::Goal;
use signorini_scene::mesh::Mesh;

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
