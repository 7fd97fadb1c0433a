//! One point on an axis, or on the grid of a pair of axes.

use super::grid::Shape;
use super::posed::{Hold, Posed, Split};
use super::solution::Solution;
use signorini_solve::ScalarKind;

/// A problem, with the scalar and the effort that it is solved with.
#[derive(Debug, Clone, PartialEq)]
pub struct ExtremeCase {
    pub axis: String,
    pub value: f64,
    /// The axis that it is crossed with, and the place on that.
    pub across: Option<(String, f64)>,
    pub scalar: ScalarKind,
    pub posed: Posed,
    /// Wishes beyond the solver's defaults.
    pub effort: Effort,
}

/// Wishes beyond the solver's defaults.
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

    pub fn name(&self) -> String {
        let across = self.across.as_ref().map(|(axis, value)| format!(", {axis} {value:e}"));
        format!("{} {:e}{}", self.axis, self.value, across.unwrap_or_default())
    }

    pub fn set_contrast(&mut self, k: f64) {
        let solution = &mut self.posed.solution;
        *solution = match *solution {
            Solution::Wall { above, ends, .. } => Solution::Wall { above, ends, contrast: k },
            _ => Solution::Jump(k),
        };
        // The flux of J grows like √k.
        if let Some(ends) = &mut self.posed.ends {
            *ends = ends.map(|end| end * k.sqrt());
        }
    }

    /// Gives the wall another u above it, or other ends of its flux.
    pub fn set_wall(&mut self, to: Option<f64>, between: Option<[f64; 2]>) {
        if let Solution::Wall { above, ends, .. } = &mut self.posed.solution {
            (*above, *ends) = (to.unwrap_or(*above), between.unwrap_or(*ends));
            self.posed.sides = [Hold::Contact, Hold::Neumann, Hold::Dirichlet, Hold::Neumann];
        }
    }

    /// Makes C none of the boundary, one edge next to the free point, the lower side, or all of it.
    pub fn set_contact(&mut self, length: f64) {
        let posed = &mut self.posed;
        let n = posed.grid.n as usize;
        if length == 0.0 {
            posed.sides[0] = Hold::Neumann;
        } else if length < 2.0 {
            posed.split = Some(Split { of: "bottom", edges: [n - 1, n] });
        } else if length > 2.0 {
            posed.sides = [Hold::Pressed; 4];
        }
    }

    /// Makes D none of the boundary, the lowest edge at the right, the right side, or three sides.
    pub fn set_dirichlet(&mut self, length: f64) {
        let posed = &mut self.posed;
        let n = f64::from(posed.grid.n);
        if length > 1.0 {
            return;
        }
        let right = if length > 0.0 { Hold::Dirichlet } else { Hold::Neumann };
        posed.sides = [Hold::Contact, right, Hold::Neumann, Hold::Neumann];
        if length > 0.0 && length < 1.0 {
            posed.grid.shape = Shape::Graded { aspect: 1.0 / (n * length) };
            posed.split = Some(Split { of: "right", edges: [0, 1] });
        }
    }
}
