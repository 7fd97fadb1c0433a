//! `summary.json`: what a solve found, in one object.

use std::collections::BTreeMap;

use serde::Serialize;

use super::answer::Answer;
use signorini_certify::{ErrorBound, NoBound};
use signorini_intervals::OutputBound;
use signorini_scene::scene::units::Units;
use signorini_solve::norms::Errors;
use signorini_solve::{Factored, Multigrid, Ran, ScalarKind, Seconds, SolverKind};

/// The object, keys in the order of the file.
#[derive(Debug, Clone, Serialize)]
pub struct Summary {
    title: String,
    scalar: ScalarKind,
    /// The solver that was asked for.
    solver: SolverKind,
    /// The solver that found the solution in the end.
    solver_used: Ran,
    status: &'static str,
    /// Edges not on the Dirichlet boundary.
    unknowns: usize,
    contact_edges: usize,
    contact_active: usize,
    /// Sweeps; those that a factor followed are not in the answer.
    sweeps: u32,
    /// Of these, iterations of conjugate gradients: projected SOR alone would not have ended.
    conjugate_iterations: u32,
    /// Work of the factor, where one solved it; else null.
    factor: Option<Factored>,
    /// Work of multigrid, where that solved it.
    #[serde(skip_serializing_if = "Option::is_none")]
    multigrid: Option<Multigrid>,
    /// Units of the solve, each a power of two: 1 and 1 unless numbers were far from that.
    scales: Units,
    relaxation: f64,
    converged: bool,
    algebraic_residual: f64,
    conservation_defect: f64,
    contact_force: f64,
    contact_length: f64,
    /// Connected parts: held by Dirichlet or Robin edges, by contact alone, by nothing.
    parts: PartNames,
    /// How wrong the answer can be in the energy norm: `total` for s and τ, `of_u` for the u of `edges.csv`; null where
    /// there is no bound.
    error_bound: Option<ErrorBound>,
    /// Why there is none.
    error_bound_reason: Option<String>,
    /// (‖A^½∇s‖² + ∫_R h (s − u_ext)²)^½, where there is a bound.
    energy_norm: Option<f64>,
    /// `error_bound.total` over `energy_norm`; null where either is missing or the norm is not above
    /// `error_bound.rounding`: the solution is constant up to rounding.
    relative_error_bound: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    errors: Option<Errors>,
    outputs: BTreeMap<String, Option<f64>>,
    /// Where the exact value of each output lies; null where there is no interval.
    output_bounds: BTreeMap<String, Option<OutputBound>>,
    /// Why there is none.
    output_bounds_reasons: BTreeMap<String, String>,
    /// Warnings on input that may not be meant: a sentence each.
    warnings: Vec<String>,
    seconds: Seconds,
}

#[derive(Debug, Clone, Copy, Serialize)]
struct PartNames {
    held: u32,
    contact_only: u32,
    up_to_a_constant: u32,
}

impl Answer {
    /// The contents of `summary.json`.
    pub fn summary(&self) -> Summary {
        let Self { problem, solution, energy_norm, outputs, intervals, .. } = self;
        let counts = problem.topology.counts;
        let parts = solution.parts;
        Summary {
            title: problem.scene.title.clone(),
            scalar: solution.scalar,
            solver: self.asked,
            solver_used: solution.ran,
            status: solution.status.name(),
            unknowns: counts.unknowns(),
            contact_edges: counts.contact,
            contact_active: solution.contact_active,
            sweeps: solution.sweeps,
            conjugate_iterations: solution.conjugate,
            factor: solution.factored,
            multigrid: solution.multigrid,
            scales: solution.units,
            relaxation: solution.omega,
            converged: solution.converged(),
            algebraic_residual: solution.algebraic_residual,
            conservation_defect: solution.conservation_defect(problem),
            contact_force: solution.contact_force,
            contact_length: solution.contact_length,
            parts: PartNames {
                held: parts.held,
                contact_only: parts.contact,
                up_to_a_constant: parts.floating,
            },
            error_bound: solution.bound,
            error_bound_reason: solution.no_bound.as_ref().map(NoBound::to_string),
            energy_norm: *energy_norm,
            relative_error_bound: solution.relative_bound(*energy_norm),
            errors: self.errors,
            outputs: outputs.clone(),
            output_bounds: intervals
                .iter()
                .map(|(name, found)| (name.clone(), found.clone().ok()))
                .collect(),
            output_bounds_reasons: intervals
                .iter()
                .filter_map(|(name, found)| Some((name.clone(), found.clone().err()?)))
                .collect(),
            warnings: problem.warnings.clone(),
            seconds: solution.seconds,
        }
    }
}

impl Summary {
    /// The text of the file. Numbers that are not finite become null.
    pub fn json(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }
}
