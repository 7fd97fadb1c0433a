//! The record of a trade study, as `trade.json` holds it.

use serde::{Deserialize, Serialize};

use super::target::Target;
use crate::baseline::Baseline;
use signorini_scene::Setting;

/// The study of one scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Trade {
    /// The scene file's name, without its ending.
    pub scene: String,
    /// Its title.
    pub title: String,
    /// `host`, `m4f` or `m7`: whose cost decides.
    pub target: Target,
    /// The registers that this program was built for, where cycles were counted.
    pub registers: String,
    /// The reference that errors are measured against, in words.
    pub truth: String,
    /// ‖A^½∇u‖ of the solution.
    pub energy: f64,
    /// ∫_C (σ·n − q) of the solution.
    pub force: f64,
    /// Length of the contact set of the solution.
    pub length: f64,
    /// The settings measured.
    pub points: Vec<Point>,
    /// Combinations that were not measured.
    pub skipped: usize,
    /// Why they were not.
    pub skipped_reasons: Vec<Skipped>,
    /// Other solvers on the same problem.
    pub baselines: Vec<Baseline>,
    /// Remarks on these: who could not run and why.
    pub notes: Vec<String>,
    /// The effect of each function of micromath on the solution.
    pub math: Vec<FunctionCost>,
    /// The setting to take; without a point where nothing meets what was asked.
    pub recommendation: Recommendation,
}

/// One setting, measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// In a few words, unique in its study.
    pub name: String,
    /// `f32`, `f64`, `f32+f64`.
    pub scalar: String,
    /// `libm`, `micromath`.
    pub math: String,
    /// `triangles`, `quads`, `mixed`.
    pub cells: String,
    /// Uniform refinements of the scene's mesh.
    pub level: u32,
    pub unknowns: usize,
    /// When a tick ends: `share 0.1`, `12 sweeps`, `exact`, `factor`.
    pub stop: String,
    /// Sweeps of a tick in the median; 0 for the exact method and a factor.
    pub sweeps: u32,
    /// `cold`, `warm`.
    pub start: String,
    /// `auto`, `tuned`, `unit`.
    pub omega: String,
    /// `full`, `condensed`.
    pub model: String,
    pub certificate: bool,
    /// How far the answer for the default inputs is from the truth.
    pub error: PointError,
    /// `error_bound.total` of the same answer; none without certificate.
    pub bound: Option<f64>,
    /// `error_bound.of_u`, which bounds `error.energy`; missing in records from before it was known.
    #[serde(default)]
    pub bound_of_u: Option<f64>,
    /// Cycles of a tick on this machine, the median.
    pub cycles: f64,
    /// (largest − smallest)/median of the repeats.
    pub cycles_spread: f64,
    /// Cycles of a tick for each unknown of the mesh.
    pub cycles_per_unknown: f64,
    /// Instructions of a tick on the target, the median; none on the host.
    pub instructions: Option<u64>,
    /// RAM of the image with its stack.
    pub ram_bytes: Option<u64>,
    /// Code and constants of the image.
    pub flash_bytes: Option<u64>,
    /// No other point is better in both cost and error.
    pub pareto: bool,
    pub setting: Setting,
}

/// Distances to the truth, absolute, in the units of the scene.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PointError {
    /// ‖A^½∇_h(u − u_h)‖
    pub energy: f64,
    /// Distance of s and τ, which the bound bounds; none without certificate.
    pub combined: Option<f64>,
    /// ‖u − u_h‖
    pub l2: f64,
    /// ‖σ − σ_h‖
    pub flux: f64,
    /// |∫_C (σ·n − q) − ∫_C (τ·n − q)|, τ the flux of the answer within the law of contact.
    pub force: f64,
    /// Difference of the lengths of the contact sets.
    pub length: f64,
}

impl Point {
    pub fn is_on_own_mesh(&self) -> bool {
        self.level == 0 && self.setting.cells.is_none() && self.setting.error.is_none()
    }

    /// How the mesh is refined: `level 1`, everywhere so often, or `to 5%`, where the error bound asks for it.
    pub fn refinement(&self) -> String {
        match self.setting.error {
            Some(error) => format!("to {error}"),
            None => format!("level {}", self.level),
        }
    }
}

/// Combinations left out for one reason.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Skipped {
    pub reason: String,
    pub count: usize,
}

/// The setting to take.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Recommendation {
    pub text: String,
    pub point: Option<Point>,
}

/// The effect of one function of micromath where it replaces libm's. Changes are relative; none where the
/// solution is zero there, or where there is no solution with that function.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct FunctionCost {
    /// `sqrt`, `sin`, …; `f32 with libm` for load data in f32 with no function of micromath.
    pub function: String,
    /// Where the scene uses it: keys of its loads, `search for ω`, `lengths of edges`.
    pub used_in: String,
    /// ‖A^½∇_h(u_h − ũ_h)‖ / ‖A^½∇_h u_h‖ of the change.
    pub energy: Option<f64>,
    pub force: Option<f64>,
    pub length: Option<f64>,
    /// Sweeps more (or fewer) of a cold solve in f32; none where it is the loads that change.
    pub sweeps: Option<i64>,
    /// Calls: a tick's, where the loads are evaluated once on each cell or edge; a cold solve's; one for each
    /// active edge.
    pub calls: u64,
    /// Instructions that one call saves on an M4F, from the record of counts.
    pub saved: f64,
    /// A remark, such as why there is no solution.
    pub note: Option<String>,
}
