//! Records of another solver, and of an error.

use serde::{Deserialize, Serialize};

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

/// A solver on the matrices of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Baseline {
    /// `kernel PSOR`, `Clarabel`, …
    pub solver: String,
    /// `full`, `condensed`.
    pub problem: String,
    /// Unknowns of that problem.
    pub unknowns: usize,
    /// `cold`, `warm`.
    pub start: String,
    /// Cycles of a solve on this machine, the median; setup that a loop does once is not in it.
    pub cycles: f64,
    /// (largest − smallest)/median of the repeats.
    pub cycles_spread: f64,
    /// Cycles of the slowest tick, the median over the repeats.
    pub worst: f64,
    /// The loosest tolerance, in powers of ten, at which `algebraic_error` comes to lie within `target`.
    pub tolerance: f64,
    /// Cycles over those of the kernel's best answer in f64 for the same problem and start.
    pub ratio: f64,
    /// Cycles over those of the kernel's condensed model in f64, same start.
    pub to_condensed: Option<f64>,
    /// Energy distance to the solution of the discrete problem, the largest of all ticks.
    pub algebraic_error: f64,
    /// Largest `algebraic_error` that will do: 1 % of the discretisation error.
    pub target: f64,
    /// Sweeps or iterations.
    pub iterations: u32,
}
