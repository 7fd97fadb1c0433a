//! Speed for accuracy: a picture a target and what to take there; the study of every scene is folded away below.

use super::markup::{enclosed, findings, folded, list, unrolled};
use super::pareto::{ParetoPlot, pareto};
use super::svg::escape;
use super::table::Table;

/// Cost and error of the settings of scenes.
#[derive(Debug, Clone, Default)]
pub struct Tradeoff {
    /// What is found on each target.
    pub targets: Vec<TradeTarget>,
    /// Findings over all scenes, a sentence each.
    pub findings: Vec<String>,
    /// A study of problem sizes.
    pub sizes: Table,
    /// Findings of that study, a sentence each.
    pub of_sizes: Vec<String>,
    /// The scenes; the section says what to do where there are none.
    pub scenes: Vec<TradePanel>,
}

/// What all scenes say of one target.
#[derive(Debug, Clone, Default)]
pub struct TradeTarget {
    /// Whose cost decides.
    pub heading: String,
    /// The study of one scene, as an example.
    pub example: ParetoPlot,
    /// What to take for that scene, a sentence.
    pub recommendation: String,
    /// What to take, a row a scene.
    pub taken: Table,
    /// How often each value of a setting is on a front.
    pub knobs: Table,
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

/// One scene on one target.
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
    /// The points of the front.
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

fn target(found: &TradeTarget) -> String {
    let heading = escape(&found.heading);
    let pictured = pictured(&found.example, &found.recommendation, "");
    let knobs = if found.knobs.rows.is_empty() { String::new() } else { found.knobs.html(&[]) };
    format!(
        "<article class=\"card\">\n<h3>{heading}</h3>\n{pictured}<h4>What to take for each scene</h4>\n{}{}\
         </article>\n",
        found.taken.html(&[]),
        folded("Which choices pay, counted over all scenes", &knobs)
    )
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
    let studies: String = scene.studies.iter().map(study).collect();
    format!(
        "<details class=\"card\">\n<summary>{title}<small>{name}</small></summary>\n{studies}</details>\n"
    )
}

fn study(study: &TradeStudy) -> String {
    let heading = escape(&study.heading);
    let mut html = format!(
        "<h3>{heading}</h3>\n{}{}",
        pictured(&study.picture, &study.recommendation, &findings(&study.notes)),
        study.front.html(&[])
    );
    for (heading, table) in study.further.iter().filter(|(_, table)| !table.rows.is_empty()) {
        html += &folded(&escape(heading), &table.html(&[]));
    }
    html
}
