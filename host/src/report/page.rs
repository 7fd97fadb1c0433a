//! The page around the pictures. Every tag is closed, so the page is well-formed XML as well.

use std::fmt::Write;

use super::contact::contact;
use super::convergence::{LOOKS, convergence, legend_marker, measured_rate, rate_label};
use super::field::{class, field};
use super::svg::escape;
use super::{BoundaryKind, Check, ConvergencePlot, Report, ScenePanel, Table};

pub(super) const STYLE: &str = include_str!("style.css");

/// The whole page as one file, complete in itself.
pub fn html(report: &Report) -> String {
    let title = escape(&report.title);
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n"
    );
    header(&mut page, report);
    page.push_str("<main>\n");
    if !report.table.rows.is_empty() {
        section(&mut page, "Every run", &table(&report.table, &report.scenes));
    }
    if !report.checks.is_empty() {
        section(&mut page, "Further checks", &checks(&report.checks));
    }
    let plots: String = report.convergence.iter().filter_map(convergence_figure).collect();
    if !plots.is_empty() {
        section(&mut page, "Convergence", &format!("<div class=\"plots\">\n{plots}</div>\n"));
    }
    if !report.scenes.is_empty() {
        let panels: String = report.scenes.iter().enumerate().map(panel).collect();
        section(&mut page, "Solutions", &format!("<div class=\"panels\">\n{panels}</div>\n"));
    }
    let made_by = escape(&report.generated_by);
    let _ = write!(page, "</main>\n<footer>{made_by}</footer>\n</body>\n</html>\n");
    page
}

fn section(page: &mut String, heading: &str, body: &str) {
    let _ = write!(page, "<section>\n<h2>{heading}</h2>\n{body}</section>\n");
}

fn header(page: &mut String, report: &Report) {
    let runs = failures("run", report.table.rows.iter().map(|row| row.passed));
    let checks = failures("check", report.checks.iter().map(|check| check.passed));
    let scenes = failures("scene", report.scenes.iter().map(|scene| scene.passed));
    let failed: Vec<String> = [runs, checks, scenes].into_iter().flatten().collect();
    let verdict = if failed.is_empty() {
        format!("<p class=\"verdict\">{} Every check holds</p>", mark(true))
    } else {
        format!("<p class=\"verdict failed\">{} Failed: {}</p>", mark(false), failed.join(", "))
    };
    let _ = write!(
        page,
        "<header>\n<h1>{}</h1>\n<p class=\"lead\">The scalar Signorini problem: u solves \
         −∇·(A∇u) = f, and on the contact boundary C it stays above the gap ψ; it is pushed back \
         by λ ≥ 0, and only where it touches. Each picture shows u as colour, the flux σ = A∇u as \
         arrows and the part of C in contact as a thick red line.</p>\n{verdict}\n</header>\n",
        escape(&report.title)
    );
}

/// `2 of 9 runs`, or nothing when all passed.
fn failures(noun: &str, passed: impl ExactSizeIterator<Item = bool>) -> Option<String> {
    let total = passed.len();
    let failed = passed.filter(|passed| !passed).count();
    let plural = if total == 1 { "" } else { "s" };
    (failed > 0).then(|| format!("{failed} of {total} {noun}{plural}"))
}

fn mark(passed: bool) -> &'static str {
    if passed {
        "<span class=\"mark pass\" role=\"img\" aria-label=\"pass\">✓</span>"
    } else {
        "<span class=\"mark fail\" role=\"img\" aria-label=\"FAIL\">✗</span>"
    }
}

fn table(table: &Table, scenes: &[ScenePanel]) -> String {
    let numeric: Vec<bool> = (0..table.header.len())
        .map(|column| table.rows.iter().all(|row| is_number(row.cells.get(column))))
        .collect();
    let align = |column: usize| match numeric.get(column) {
        Some(true) => " class=\"number\"",
        _ => "",
    };
    let mut html = String::from("<div class=\"scroll\">\n<table>\n<thead><tr><th></th>");
    for (column, name) in table.header.iter().enumerate() {
        let _ = write!(html, "<th{}>{}</th>", align(column), escape(name));
    }
    html.push_str("</tr></thead>\n<tbody>\n");
    for row in &table.rows {
        let class = if row.passed { "" } else { " class=\"failed\"" };
        let _ = write!(html, "<tr{class}><td>{}</td>", mark(row.passed));
        for (column, cell) in row.cells.iter().enumerate() {
            let scene = scenes.iter().position(|scene| column == 0 && scene.name == *cell);
            let text = match scene {
                Some(scene) => format!("<a href=\"#scene-{scene}\">{}</a>", escape(cell)),
                None => escape(cell),
            };
            let _ = write!(html, "<td{}>{text}</td>", align(column));
        }
        html.push_str("</tr>\n");
    }
    html + "</tbody>\n</table>\n</div>\n"
}

/// Numbers, and what stands for a missing one, are aligned to the right.
fn is_number(cell: Option<&String>) -> bool {
    let text = cell.map_or("", |cell| cell.trim_start_matches(['+', '-', '−', '–', '<', '≤', ' ']));
    text.is_empty() || text.starts_with(|first: char| first.is_ascii_digit())
}

fn checks(checks: &[Check]) -> String {
    let mut html = String::from("<ul class=\"checks\">\n");
    for check in checks {
        let (claim, found) = (escape(&check.claim), escape(&check.found));
        let mark = mark(check.passed);
        let _ = writeln!(html, "<li>{mark}<span>{claim}</span><em>{found}</em></li>");
    }
    html + "</ul>\n"
}

fn convergence_figure(plot: &ConvergencePlot) -> Option<String> {
    let picture = convergence(plot)?;
    let mut legend = String::new();
    for (index, series) in plot.series.iter().enumerate() {
        let rate = measured_rate(series).map_or("–".to_owned(), |rate| format!("{rate:.2}"));
        let _ = writeln!(
            legend,
            "<li>{}<span>{}</span><em>rate {rate}, expected {}</em></li>",
            legend_marker(index % LOOKS),
            escape(&series.label),
            rate_label(series.expected_rate)
        );
    }
    let title = escape(&plot.title);
    Some(format!(
        "<figure class=\"card\">\n<h3>{title}</h3>\n{picture}<ul class=\"series\">\n{legend}</ul>\n\
         </figure>\n"
    ))
}

fn panel((index, scene): (usize, &ScenePanel)) -> String {
    let mut html = format!(
        "<article class=\"card\" id=\"scene-{index}\">\n<h3>{} {}<small>{}</small></h3>\n",
        mark(scene.passed),
        escape(&scene.title),
        escape(&scene.name)
    );
    if let Some(field) = field(scene) {
        let notes: String =
            field.notes.iter().map(|note| format!("<li>{}</li>", escape(note))).collect();
        let _ = write!(
            html,
            "<figure>\n{}<ul class=\"legend\">{}{notes}</ul>\n</figure>\n",
            field.svg,
            legend(scene)
        );
    }
    if let Some(picture) = contact(scene) {
        let exact = scene.contact.iter().any(|edge| !edge.exact_multiplier.is_empty());
        let exact = if exact { entry("exact-key", "exact λ") } else { String::new() };
        let discrete = entry("multiplier-key", "discrete λ");
        let zone = entry("zone-key", "in contact");
        let _ = write!(
            html,
            "<figure>\n{picture}<ul class=\"legend\">{discrete}{exact}{zone}</ul>\n</figure>\n"
        );
    }
    if !scene.facts.is_empty() {
        html.push_str("<dl>\n");
        for (name, value) in &scene.facts {
            let (name, value) = (escape(name), escape(value));
            let _ = writeln!(html, "<div><dt>{name}</dt><dd>{value}</dd></div>");
        }
        html.push_str("</dl>\n");
    }
    html + "</article>\n"
}

/// The kinds of boundary that the scene has.
fn legend(scene: &ScenePanel) -> String {
    let mut html = String::new();
    if scene.contact.iter().any(|edge| edge.active) {
        html += &entry("active-key", "in contact");
    }
    if scene.contact.iter().any(|edge| !edge.active) {
        html += &entry("open-key", "open");
    }
    for (kind, text) in [
        (BoundaryKind::Dirichlet, "Dirichlet"),
        (BoundaryKind::Neumann, "Neumann"),
        (BoundaryKind::Robin, "Robin"),
    ] {
        if scene.boundary.iter().any(|edge| edge.kind == kind) {
            html += &entry(&format!("{}-key", class(kind)), text);
        }
    }
    html
}

fn entry(key: &str, text: &str) -> String {
    format!("<li><i class=\"{key}\"></i>{text}</li>")
}
