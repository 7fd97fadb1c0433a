//! Speed for accuracy: a picture a target and what to take there; the study of every scene is folded away below.

use super::markup::{enclosed, findings, folded, list, unrolled};
use super::pareto::{ParetoPlot, pareto};
use super::svg::escape;
use super::table::Table;

/// Cost and error of the settings of scenes.
#[derive(Debug, Clone, Default)]
pub struct Tradeoff {
    /// Settings to take on each target: a row of the table is a scene there, and the picture is that of an example.
    pub targets: Vec<TradeStudy>,
    /// Findings over all scenes, a sentence each.
    pub findings: Vec<String>,
    /// A study of problem sizes.
    pub sizes: Table,
    /// Findings of that study, a sentence each.
    pub of_sizes: Vec<String>,
    /// The scenes; the section says what to do where there are none.
    pub scenes: Vec<TradePanel>,
}

/// One scene, on one or more targets.
#[derive(Debug, Clone, Default)]
pub struct TradePanel {
    /// The scene file's name.
    pub name: String,
    /// Its title.
    pub title: String,
    /// The studies, one per target.
    pub studies: Vec<TradeStudy>,
}

/// Settings on one target: those of a scene, or what to take for each.
#[derive(Debug, Clone, Default)]
pub struct TradeStudy {
    /// Whose cost decides.
    pub heading: String,
    /// The recommendation, a sentence.
    pub recommendation: String,
    /// Remarks: what errors are measured against, what was skipped.
    pub notes: Vec<String>,
    /// Error over cost.
    pub picture: ParetoPlot,
    /// The points of the front, or a row a scene.
    pub front: Table,
    /// Further tables, each with its heading; those without rows are left out.
    pub further: Vec<(String, Table)>,
}

/// The body of the section.
pub fn tradeoff(found: &Tradeoff) -> String {
    if found.scenes.is_empty() {
        return "<p class=\"lead\">No committed trade record: run <code>signorini trade</code></p>\n"
            .to_owned();
    }
    let mut html = format!("<p class=\"lead\">{LEAD}</p>\n<div class=\"panels\">\n");
    html.extend(found.targets.iter().map(target));
    html += "</div>\n";
    html += &findings(&found.findings);
    html += &folded("How errors are measured here", &list("notes", &ERRORS));
    if !found.sizes.rows.is_empty() {
        let body = findings(&found.of_sizes) + &found.sizes.html(&[]);
        html += &folded("How other solvers compare, from small problems to large ones", &body);
    }
    let scenes = found.scenes.iter().map(panel);
    html + &enclosed("<h3>Every scene, with all settings that nothing beats</h3>", scenes, "")
}

const LEAD: &str = "Each scene was solved with many settings, and what each costs was measured. A setting is worth \
                    taking where no other is both cheaper and more accurate.";

/// How to read the numbers.
const ERRORS: [&str; 3] = [
    "Errors are distances to the exact solution, or to a much finer one, in percent of the energy norm ‖A^½∇u‖ \
     of the solution.",
    "The error of u_h is the gradient error, weighed by A (energy norm ‖A^½∇(u − u_h)‖); that of s, τ weighs \
     the gradient of s by A and the flux τ by A⁻¹, together.",
    "Bounds are certified, and are for the error of s, τ.",
];

/// The settings to take for all scenes on one target, with one of them for an example.
fn target(found: &TradeStudy) -> String {
    let study = study(found, "<h4>What to take for each scene</h4>\n");
    format!("<article class=\"card\">\n{study}</article>\n")
}

/// The picture of a study, with words beside it.
fn pictured(plot: &ParetoPlot, recommendation: &str, notes: &str) -> String {
    let picture = pareto(plot).map(|picture| format!("<figure>\n{picture}</figure>\n"));
    format!(
        "<div class=\"beside\">\n{}<div>\n<div class=\"taken\">{}</div>\n{notes}</div>\n</div>\n",
        picture.unwrap_or_default(),
        unrolled(recommendation)
    )
}

fn panel(scene: &TradePanel) -> String {
    let (name, title) = (escape(&scene.name), escape(&scene.title));
    let studies: String = scene.studies.iter().map(|of| study(of, "")).collect();
    format!(
        "<details class=\"card\">\n<summary>{title}<small>{name}</small></summary>\n{studies}</details>\n"
    )
}

/// A study, with this heading of its table.
fn study(study: &TradeStudy, of_table: &str) -> String {
    let heading = escape(&study.heading);
    let mut html = format!(
        "<h3>{heading}</h3>\n{}{of_table}{}",
        pictured(&study.picture, &study.recommendation, &findings(&study.notes)),
        study.front.html(&[])
    );
    for (heading, table) in study.further.iter().filter(|(_, table)| !table.rows.is_empty()) {
        html += &folded(&escape(heading), &table.html(&[]));
    }
    html
}
