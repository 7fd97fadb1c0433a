//! Extremes: a map a study, and why whatever is not correct is not.

use std::fmt::Write;

use super::markup::{enclosed, folded, frame, list, unrolled};
use super::outcome_map::{OutcomeMap, key, outcome_map};
use super::svg::escape;
use super::table::Table;

/// Outcomes of scenes whose numbers were pushed.
#[derive(Debug, Clone, Default)]
pub struct Extremes {
    /// How many cases, how they ended.
    pub summary: String,
    /// The outcomes with what they mean, the best first.
    pub legend: Vec<(String, String)>,
    /// The studies.
    pub studies: Vec<ExtremesStudy>,
    /// The cases that are not correct, with the reason.
    pub reasons: Table,
}

/// One axis, or one pair.
#[derive(Debug, Clone, Default)]
pub struct ExtremesStudy {
    /// Names of the numbers that were pushed.
    pub heading: String,
    /// A remark; may be empty.
    pub remark: String,
    /// Its maps, each with a heading that may be empty.
    pub maps: Vec<(String, OutcomeMap)>,
}

/// The body of the section.
pub fn extremes(found: &Extremes) -> String {
    if found.studies.is_empty() {
        return "<p class=\"lead\">No committed record of extremes: run <code>signorini extremes</code></p>\n"
            .to_owned();
    }
    let mut html = format!("<p class=\"lead\">{LEAD}</p>\n{}", list("notes", &SQUARES));
    let _ = writeln!(html, "<div class=\"lead\">{}</div>", unrolled(&found.summary));
    html += "<ul class=\"card series outcomes\">\n";
    for (outcome, means) in &found.legend {
        let (key, outcome, means) = (key(outcome), escape(outcome), escape(means));
        let _ = writeln!(html, "<li>{key}<span><b>{outcome}</b>: {means}</span></li>");
    }
    let (alone, pairs): (Vec<_>, Vec<_>) =
        found.studies.iter().partition(|study| study.maps.len() < 2);
    let heading = format!("Two numbers pushed at once: {} studies", pairs.len());
    let reasons = format!("Why {} cases are not correct", found.reasons.rows.len());
    html + "</ul>\n"
        + &studies(&alone)
        + &folded(&heading, &studies(&pairs))
        + &folded(&reasons, &found.reasons.html(&[]))
}

fn studies(studies: &[&ExtremesStudy]) -> String {
    enclosed("<div class=\"studies\">", studies.iter().map(|of| study(of)), "</div>")
}

const LEAD: &str = "Scenes with exact solutions had their numbers pushed until something gave.";

/// How to read the maps.
const SQUARES: [&str; 3] = [
    "A square is a case, with the sweeps that it took; pointed at, it says more.",
    "Errors are integrated at scale 1, where no number overflows.",
    "They are compared with what a direct solver in f64 reaches on the same grid.",
];

fn study(study: &ExtremesStudy) -> String {
    let mut html = format!("<div class=\"card\">\n<h3>{}</h3>\n", escape(&study.heading));
    if !study.remark.is_empty() {
        html += &list("caption", &study.remark.split("; ").collect::<Vec<_>>());
    }
    html += "<div class=\"maps\">\n";
    for (heading, map) in &study.maps {
        let title = || format!("<h4>{}</h4>\n", escape(heading));
        let heading = if heading.is_empty() { String::new() } else { title() };
        let _ = write!(html, "<figure>\n{heading}{}</figure>\n", outcome_map(map));
    }
    html + "</div>\n</div>\n"
}

/// A page of its own.
pub fn extremes_page(found: &Extremes, made_by: &str) -> String {
    let body = format!(
        "<header>\n<h1>Signorini: extremes</h1>\n</header>\n<main>\n<section>\n{}</section>\n</main>\n\
         <footer>{}</footer>\n",
        extremes(found),
        escape(made_by)
    );
    frame("Signorini: extremes", &body)
}
