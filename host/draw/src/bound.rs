//! How wrong an answer can be, and why, for someone who does not know the theory.

use super::ScenePanel;
use super::markup::{enclosed, list};
use super::scale::plain;
use super::svg::escape;

/// The caption of a panel's bound.
pub fn bound(panel: &ScenePanel) -> String {
    let Some(bound) = &panel.bound else {
        let reason = panel.no_bound.as_deref().map_or_else(String::new, escape);
        return format!("<p class=\"caption\">No error bound: {reason}</p>\n");
    };
    let terms = [
        ("total", bound.total, TOTAL),
        ("of u_h", bound.of_u, OF_U),
        ("gap", bound.gap, "of the total, from mesh and solver together"),
        ("algebraic", bound.algebraic, "the part of the total that more sweeps would remove"),
        ("oscillation", bound.oscillation, "loads vary inside cells, the method sees their means"),
        ("rounding", bound.rounding, "the most that the processor’s arithmetic can hide"),
    ];
    let entry = |(name, value, words)| {
        let (value, words) = (plain(value), escape(words));
        format!("<div><dt>{name}</dt><dd>{value}<span>{words}</span></dd></div>")
    };
    let terms = enclosed("<dl class=\"bound\">", terms.into_iter().map(entry), "</dl>");
    terms + &list("notes", &beside(panel, bound.total))
}

/// The guarantees of the bounds.
const TOTAL: &str =
    "guaranteed: the continuous s and the flux τ, in the energy norm, are no further off than this";
const OF_U: &str = "guaranteed: the means over the edges, in the energy norm, cell by cell, are no further off than this";

/// How errors are weighed.
const NORMS: [&str; 3] = [
    "The energy norm of errors of s and u_h weighs the gradient by A: ‖A^½∇(u − s)‖, ‖A^½∇(u − u_h)‖.",
    "The energy norm of errors of τ weighs the flux by A⁻¹: ‖A^−½(σ − τ)‖.",
    "The total counts those of s and τ together, with what Robin edges add.",
];

/// How the terms are weighed, the total as a part of the solution, and the truth.
fn beside(panel: &ScenePanel, total: f64) -> Vec<String> {
    let part = 100.0 * total / panel.energy;
    let size = part
        .is_finite()
        .then(|| format!("The total is {} % of the solution’s energy norm ‖A^½∇u‖.", plain(part)));
    let truth = panel.error.map(|error| format!("In truth s and τ are {} off.", plain(error)));
    NORMS.map(str::to_owned).into_iter().chain(size).chain(truth).collect()
}
