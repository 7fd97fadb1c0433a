//! One point on an axis, or on the grid of a pair of axes.

use super::posed::Posed;
use signorini_solve::ScalarKind;

/// What is solved, in which scalar, and with what effort.
#[derive(Debug, Clone, PartialEq)]
pub struct ExtremeCase {
    /// The axis.
    pub axis: String,
    /// The place on it.
    pub value: f64,
    /// The axis that it is crossed with, and the place on that.
    pub across: Option<(String, f64)>,
    /// Scalar type of the kernel.
    pub scalar: ScalarKind,
    /// The problem.
    pub posed: Posed,
    /// What the solver is asked for beyond its defaults.
    pub effort: Effort,
}

/// What the solver is asked for beyond its defaults.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Effort {
    /// A fixed relaxation factor; `None`: the kernel finds it.
    pub omega: Option<f64>,
    /// Most sweeps; `None`: as many as [`ExtremeCase::most_sweeps`] leaves.
    pub sweeps: Option<u32>,
    /// Subnormal numbers are flushed to zero while the scene is read and solved.
    pub flush: bool,
    /// Ticks instead of one solve; 0: one solve.
    pub ticks: u32,
}

/// Updates of unknowns that a solve may take, and that one on more than [`LARGE`] cells may take.
const UPDATES: [f64; 2] = [3e9, 3e8];
const LARGE: u32 = 100_000;

impl ExtremeCase {
    /// 10⁶ sweeps, the default, or fewer on meshes where they would take minutes: a cut-off solve is what
    /// the bound is for.
    pub fn most_sweeps(&self) -> u32 {
        let cells = 2 * self.posed.grid.n.pow(2);
        // Three unknowns to two triangles, two to a quad: at most six to a square of the grid.
        let updates = UPDATES[usize::from(2 * cells > LARGE)];
        let budget = (updates / (3.0 * f64::from(cells))).clamp(1.0, 1e6) as u32;
        self.effort.sweeps.unwrap_or(budget)
    }

    /// Its name on the terminal.
    pub fn name(&self) -> String {
        let across = self.across.as_ref().map(|(axis, value)| format!(", {axis} {value:e}"));
        format!("{} {:e}{}", self.axis, self.value, across.unwrap_or_default())
    }
}
