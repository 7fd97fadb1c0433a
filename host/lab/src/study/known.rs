//! The findings of the main job on a standard scene.

use serde::Serialize;

use super::bound::Certified;
use super::checks::Check;
use super::cost::Cost;
use super::outputs::KnownOutputs;

/// The findings on a scene.
#[derive(Debug, Clone, Serialize)]
pub struct KnownScene {
    /// The scene file's name.
    pub name: String,
    /// Its title.
    pub title: String,
    /// Triangles and quads.
    pub cells: [usize; 2],
    /// Edges not on the Dirichlet boundary.
    pub unknowns: usize,
    /// Active contact edges, and all of them.
    pub contact: [usize; 2],
    /// ∫_C (σ·n − q)
    pub force: f64,
    /// ‖A^½∇_h u_h‖
    pub energy: f64,
    /// The kernel in f64.
    pub f64: Run,
    /// The kernel in f32.
    pub f32: Run,
    /// The declared outputs.
    pub outputs: KnownOutputs,
    /// The checks.
    pub checks: Vec<Check>,
}

/// The kernel in one scalar.
#[derive(Debug, Clone, Serialize)]
pub struct Run {
    /// Sweeps down to the rounding floor, the error bound there, and distances to the exact solution.
    #[serde(flatten)]
    pub certified: Certified,
    /// The ω it found.
    pub omega: f64,
    /// Largest distance to the reference, relative to the range of u.
    pub distance: f64,
    /// Cycles per unknown for the whole solve.
    pub solve_cycles: f64,
    /// Cycles of a sweep.
    pub cost: Cost,
}
