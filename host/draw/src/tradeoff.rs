//! Speed for accuracy: one table over all scenes, what it says of the knobs, and a folded block a scene.

use std::fmt::Write;

use super::markup::{enclosed, list, unrolled};
use super::pareto::{ParetoPlot, pareto};
use super::svg::escape;
use super::table::Table;

/// Cost and error of the settings of scenes.
#[derive(Debug, Clone, Default)]
pub struct Tradeoff {
    /// A row a scene.
    pub summary: Table,
    /// Findings over all scenes, a sentence each.
    pub findings: Vec<String>,
    /// A study of problem sizes, as a table in text; empty where there is none.
    pub sizes: String,
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
    let mut html = String::new();
    if found.scenes.is_empty() {
        html +=
            "<p class=\"lead\">No committed trade record: run <code>signorini trade</code></p>\n";
    } else {
        let _ = writeln!(html, "<p class=\"lead\">{LEAD}</p>");
        html += &list("notes", &COLUMNS);
        html += &found.summary.html(&[]);
        html += &findings(&found.findings);
    }
    if !found.sizes.is_empty() {
        let _ = write!(
            html,
            "<h3>From small problems to large ones</h3>\n<pre style=\"overflow-x: auto\">{}</pre>\n",
            lines(&found.sizes)
        );
        html += &findings(&found.of_sizes);
    }
    html.extend(found.scenes.iter().map(panel));
    html
}

const LEAD: &str = "What a user can turn, measured: each scene was solved with many settings.";

/// How to read the tables.
const COLUMNS: [&str; 4] = [
    "Errors are distances to the exact solution, or to a much finer one, in percent of the energy norm ‖A^½∇u‖ \
     of the solution.",
    "The error of u_h is the gradient error, weighed by A (energy norm ‖A^½∇(u − u_h)‖); that of s, τ weighs \
     the gradient of s by A and the flux τ by A⁻¹, together.",
    "Bounds are certified, and are for the error of s, τ.",
    "The last columns of the first table give the cycles of other solvers for the same condensed problem, \
     from the answer of the tick before, over those of the kernel.",
];

fn findings(sentences: &[String]) -> String {
    let entries = sentences.iter().map(|sentence| format!("<li>{}</li>", unrolled(sentence)));
    enclosed("<ul class=\"findings\">", entries, "</ul>")
}

fn panel(scene: &TradePanel) -> String {
    let (name, title) = (escape(&scene.name), escape(&scene.title));
    let studies: String = scene.studies.iter().map(study).collect();
    format!(
        "<details class=\"card\">\n<summary>{name}<small>{title}</small></summary>\n{studies}</details>\n"
    )
}

fn study(study: &TradeStudy) -> String {
    let heading = escape(&study.heading);
    let recommendation = unrolled(&study.recommendation);
    let picture = pareto(&study.picture).map(|picture| format!("<figure>\n{picture}</figure>\n"));
    let mut html = format!(
        "<h3>{heading}</h3>\n<div class=\"taken\">{recommendation}</div>\n{}{}{}",
        picture.unwrap_or_default(),
        study.front.html(&[]),
        findings(&study.notes)
    );
    for (heading, table) in study.further.iter().filter(|(_, table)| !table.rows.is_empty()) {
        let _ = write!(html, "<h4>{}</h4>\n{}", escape(heading), table.html(&[]));
    }
    html
}

/// The text as HTML, line by line.
fn lines(text: &str) -> String {
    text.lines().map(|line| escape(line) + "\n").collect()
}
