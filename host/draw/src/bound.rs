//! How wrong an answer can be, and why, for someone who does not know the theory.

use std::fmt::Write;

use super::ScenePanel;
use super::scale::plain;
use super::svg::escape;

/// The caption of a panel's bound.
pub fn bound(panel: &ScenePanel) -> String {
    let Some(bound) = &panel.bound else {
        let reason = panel.no_bound.as_deref().map_or_else(String::new, escape);
        return format!("<p class=\"caption\">No error bound: {reason}</p>\n");
    };
    let mut html = String::from("<dl class=\"bound\">\n");
    let mut entry = |name: &str, value: f64, words: &str| {
        let (value, words) = (plain(value), escape(words));
        let _ = writeln!(html, "<div><dt>{name}</dt><dd>{value}<span>{words}</span></dd></div>");
    };
    entry("total", bound.total, &total(panel, bound.total));
    entry(
        "of u_h",
        bound.of_u,
        "guaranteed: the means over the edges, cell by cell, are no further off than this",
    );
    entry("gap", bound.gap, "of the total, from mesh and solver together");
    entry("algebraic", bound.algebraic, "the part of the total that more sweeps would remove");
    entry("oscillation", bound.oscillation, "loads vary inside cells, the method sees their means");
    entry("rounding", bound.rounding, "the most that the processor’s arithmetic can hide");
    html + "</dl>\n"
}

/// What the total means, as a part of the solution and beside the truth.
fn total(panel: &ScenePanel, total: f64) -> String {
    let mut words =
        "guaranteed: the continuous s and the flux τ are no further off than this".to_owned();
    let part = 100.0 * total / panel.energy;
    if part.is_finite() {
        let _ = write!(words, ", {} % of the solution’s ‖A^½∇u‖", plain(part));
    }
    if let Some(error) = panel.error {
        let _ = write!(words, "; in truth it is {} off", plain(error));
    }
    words
}
